//! Plain lines while a run goes on; on a terminal also what runs now, and for how long still. A program may report
//! steps in place of nodes (`telling.rs`).

use super::telling::Steps;
use super::text::short;
use engine::walk::{Done, Status, Watch};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::collections::{BTreeMap, BTreeSet};
use std::io::IsTerminal;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Speaks on standard error; on a terminal the last line shows what runs now.
pub(crate) struct Progress {
    quiet: bool,
    terminal: bool,
    state: Arc<Mutex<State>>,
    /// The last line of the screen; hidden where there is no terminal.
    bar: ProgressBar,
}

struct State {
    of: usize,
    done: BTreeSet<String>,
    found: usize,
    skipped: usize,
    running: Vec<Running>,
    /// What each node took the last time. \[s\]
    expected: BTreeMap<String, f64>,
    /// What is shown in place of nodes.
    steps: Option<Steps>,
}

struct Running {
    node: String,
    /// The progress that it reports.
    at: String,
    since: Instant,
}

/// The last line of the screen, of whatever runs.
static LAST: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Prints lines above the last line of the screen, if there is one.
pub fn above(lines: impl FnOnce()) {
    let last = LAST.lock().expect("bug: poisoned").clone();
    match last {
        Some(bar) => bar.suspend(lines),
        None => lines(),
    }
}

/// How often the last line is drawn.
const TICK: Duration = Duration::from_millis(250);

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
    fn line(&self) -> String {
        if let Some(steps) = &self.steps {
            let running = self.running.iter().map(|r| r.node.as_str());
            return steps.line(running, Some(self.left()).filter(|left| *left >= 1.0));
        }
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
        format!("[{done}/{of}]{left} {}", running.join(", "))
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
    /// For a walk of so many nodes, printed by node or by steps.
    pub(crate) fn new(quiet: bool, of: usize, steps: Option<Steps>) -> Self {
        let state = State {
            of,
            done: BTreeSet::new(),
            found: 0,
            skipped: 0,
            running: vec![],
            expected: BTreeMap::new(),
            steps,
        };
        let terminal = std::io::stderr().is_terminal();
        let state = Arc::new(Mutex::new(state));
        let bar = ProgressBar::new_spinner();
        if terminal && !quiet {
            let state = Arc::clone(&state);
            let line = move |_: &indicatif::ProgressState, to: &mut dyn std::fmt::Write| {
                let _ = to.write_str(&state.lock().expect("bug: poisoned").line());
            };
            let style = ProgressStyle::with_template("{line}").expect("bug: a template");
            bar.set_style(style.with_key("line", line));
            bar.enable_steady_tick(TICK);
        } else {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        *LAST.lock().expect("bug: poisoned") = Some(bar.clone());
        Progress {
            quiet,
            terminal,
            state,
            bar,
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

    /// Prints lines above the last one.
    fn above(&self, lines: impl FnOnce()) {
        self.bar.suspend(lines);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        LAST.lock().expect("bug: poisoned").take();
        self.bar.finish_and_clear();
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
    }

    fn waits(&self, node: &str) {
        let mut state = self.state.lock().expect("bug: poisoned");
        if !state.running.iter().any(|r| r.node == node) {
            if !self.terminal && !self.quiet && state.steps.is_none() {
                crate::errln!("{node}: another process makes it; waiting for that");
            }
            state.running.push(Running {
                node: node.into(),
                at: " (made by another process)".into(),
                since: Instant::now(),
            });
        }
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        let mut state = self.state.lock().expect("bug: poisoned");
        if let Some(entry) = state.running.iter_mut().find(|r| r.node == node) {
            entry.at = format!(" ({label} {done}/{of})");
        }
    }

    fn done(&self, node: &str, done: &Done) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.running.retain(|r| r.node != node);
        state.done.insert(node.into());
        if self.quiet {
            return;
        }
        if let Some(steps) = &mut state.steps {
            let [above, plain] = steps.done(node, done);
            // The line below is drawn from the same state.
            drop(state);
            let plain = plain.iter().filter(|_| !self.terminal);
            let lines: Vec<&String> = above.iter().chain(plain).collect();
            if !lines.is_empty() {
                self.above(|| lines.iter().for_each(|line| crate::errln!("{line}")));
            }
            return;
        }
        let (so_far, of) = (state.done.len(), state.of);
        if done.status == Status::Hit && of > MANY {
            state.found += 1;
            let found = state.found;
            drop(state);
            if so_far == of {
                self.above(|| crate::errln!("{found} of {of} found"));
            }
            return;
        }
        // The reason is printed once, for the node that failed.
        let skipped = done.status == Status::Skipped;
        state.skipped += usize::from(skipped);
        let lost = state.skipped;
        // The line below is drawn from the same state.
        drop(state);
        if skipped {
            if so_far == of {
                self.above(|| crate::errln!("{lost} that need it skipped"));
            }
            return;
        }
        self.above(|| {
            crate::errln!("[{so_far:>2}/{of}] {node:<12} {}", became(done));
            for warning in &done.warnings {
                crate::errln!("        warning: {warning}");
            }
        });
    }
}

/// What became of a node, with its metrics.
fn became(done: &Done) -> String {
    let status = match &done.status {
        Status::Hit => "found".into(),
        Status::Executed => format!("made in {:.1} s", done.seconds),
        Status::Failed(_) => "FAILED".into(),
        Status::Skipped => "skipped".into(),
        Status::Cancelled => "stopped".into(),
    };
    let number = |m: &stage::Metric| format!("{} {} {}", m.name, short(m.value), m.unit);
    let numbers: Vec<String> = done
        .metrics
        .iter()
        .map(|m| number(m).trim_end().to_owned())
        .collect();
    match numbers.is_empty() {
        true => status,
        false => format!("{status}  ({})", numbers.join(", ")),
    }
}
