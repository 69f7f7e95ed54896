//! Plain lines while a run goes on; on a terminal also what runs now, and for how long still.

use super::text::short;
use crate::walk::{Done, Status, Watch};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{IsTerminal, Write};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Speaks on standard error; on a terminal the last line shows what runs now.
pub(crate) struct Progress {
    quiet: bool,
    terminal: bool,
    state: Arc<Mutex<State>>,
    /// Draws while no stage says anything; ends when this is dropped.
    _clock: Option<Sender<()>>,
}

struct State {
    of: usize,
    done: BTreeSet<String>,
    found: usize,
    running: Vec<Running>,
    drawn: Instant,
    /// What each node took the last time. \[s\]
    expected: BTreeMap<String, f64>,
}

struct Running {
    node: String,
    /// How far it says it is.
    at: String,
    since: Instant,
}

/// How often the last line is drawn while nothing is said.
const TICK: Duration = Duration::from_millis(500);

/// From so many nodes on, what was found is counted but not shown one by one.
const MANY: usize = 60;

impl State {
    /// How long it may still take by what things took the last time. \[s\]
    fn left(&self) -> f64 {
        let open = self
            .expected
            .iter()
            .filter(|(node, _)| !self.done.contains(*node));
        let left = |(node, seconds): (&String, &f64)| {
            let running = self.running.iter().find(|r| r.node == *node);
            let spent = running.map_or(0.0, |r| r.since.elapsed().as_secs_f64());
            (seconds - spent).max(0.0)
        };
        open.map(left).sum()
    }

    /// The last line of the screen: what runs now, and for how long still.
    fn draw(&mut self) {
        let one = |r: &Running| {
            let spent = r.since.elapsed().as_secs_f64();
            let spent = if spent < 2.0 {
                String::new()
            } else {
                format!(" {}", duration(spent))
            };
            format!("{}{spent}{}", r.node, r.at)
        };
        let running: Vec<String> = self.running.iter().map(one).collect();
        let left = match self.left() {
            left if left >= 1.0 => format!(" about {} left", duration(left)),
            _ => String::new(),
        };
        let (done, of) = (self.done.len(), self.of);
        let line = format!("[{done}/{of}]{left} {}", running.join(", "));
        // A longer line would break, and its first half stay on the screen.
        let columns = std::env::var("COLUMNS").ok().and_then(|c| c.parse().ok());
        let line: String = line
            .chars()
            .take(columns.unwrap_or(80usize).max(21) - 1)
            .collect();
        let _ = write!(std::io::stderr(), "\r\x1b[K{line}");
        self.drawn = Instant::now();
    }
}

/// `75` as `1 min 15 s`.
fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m} min {s} s"),
        (h, m, _) => format!("{h} h {m} min"),
    }
}

impl Progress {
    /// For a walk of so many nodes.
    pub(crate) fn new(quiet: bool, of: usize) -> Self {
        let state = State {
            of,
            done: BTreeSet::new(),
            found: 0,
            running: vec![],
            drawn: Instant::now(),
            expected: BTreeMap::new(),
        };
        let terminal = std::io::stderr().is_terminal();
        let state = Arc::new(Mutex::new(state));
        let clock = (terminal && !quiet).then(|| {
            let (clock, ended) = channel();
            let state = Arc::clone(&state);
            std::thread::spawn(move || {
                while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                    let mut state = state.lock().expect("bug: poisoned");
                    if !state.running.is_empty() && state.drawn.elapsed() >= TICK {
                        state.draw();
                    }
                }
            });
            clock
        });
        Progress {
            quiet,
            terminal,
            state,
            _clock: clock,
        }
    }

    /// Whether it matters to know what nodes took the last time.
    pub(crate) fn asks_for_time(&self) -> bool {
        self.terminal && !self.quiet
    }

    /// Tells what nodes took the last time. \[s\]
    pub(crate) fn expect(&self, expected: BTreeMap<String, f64>) {
        self.state.lock().expect("bug: poisoned").expected = expected;
    }

    fn draw(&self, state: &mut State) {
        if self.terminal && !self.quiet {
            state.draw();
        }
    }
}

impl Watch for Progress {
    fn started(&self, node: &str) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.running.retain(|r| r.node != node);
        state.running.push(Running {
            node: node.into(),
            at: String::new(),
            since: Instant::now(),
        });
        self.draw(&mut state);
    }

    fn waits(&self, node: &str) {
        let mut state = self.state.lock().expect("bug: poisoned");
        if !state.running.iter().any(|r| r.node == node) {
            if !self.terminal && !self.quiet {
                let _ = writeln!(
                    std::io::stderr(),
                    "{node}: another process makes it; waiting for that"
                );
            }
            state.running.push(Running {
                node: node.into(),
                at: " (made by another process)".into(),
                since: Instant::now(),
            });
            self.draw(&mut state);
        }
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        let mut state = self.state.lock().expect("bug: poisoned");
        if let Some(entry) = state.running.iter_mut().find(|r| r.node == node) {
            entry.at = format!(" ({label} {done}/{of})");
        }
        if state.drawn.elapsed().as_millis() > 100 {
            self.draw(&mut state);
        }
    }

    fn done(&self, node: &str, done: &Done) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.running.retain(|r| r.node != node);
        state.done.insert(node.into());
        let last = state.done.len() == state.of;
        if self.quiet {
            return;
        }
        if done.status == Status::Hit && state.of > MANY {
            state.found += 1;
            if last {
                let _ = writeln!(std::io::stderr(), "{} of {} found", state.found, state.of);
            }
            return;
        }
        let status = match &done.status {
            Status::Hit => "found".into(),
            Status::Executed => format!("made in {:.1} s", done.seconds),
            Status::Failed(_) => "FAILED".into(),
            Status::Skipped => "skipped".into(),
            Status::Cancelled => "stopped".into(),
        };
        if self.terminal {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
        let number = |m: &stage::Metric| format!("{} {} {}", m.name, short(m.value), m.unit);
        let numbers: Vec<String> = done
            .metrics
            .iter()
            .map(|m| number(m).trim_end().to_owned())
            .collect();
        let numbers = if numbers.is_empty() {
            String::new()
        } else {
            format!("  ({})", numbers.join(", "))
        };
        crate::errln!(
            "[{:>2}/{}] {node:<12} {status}{numbers}",
            state.done.len(),
            state.of
        );
        for warning in &done.warnings {
            crate::errln!("        warning: {warning}");
        }
        self.draw(&mut state);
        if self.terminal && last {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}
