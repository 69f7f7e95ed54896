//! Plain lines while a run goes on.

use crate::walk::{Done, Fate, Watch};
use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::time::Instant;

/// Speaks on standard error; on a terminal the last line shows what runs now.
pub(crate) struct Speaker {
    quiet: bool,
    terminal: bool,
    of: usize,
    state: Mutex<State>,
}

struct State {
    done: usize,
    running: Vec<(String, String)>,
    drawn: Instant,
}

impl Speaker {
    /// For a walk of so many nodes.
    pub(crate) fn new(quiet: bool, of: usize) -> Self {
        let state = State {
            done: 0,
            running: vec![],
            drawn: Instant::now(),
        };
        let terminal = std::io::stderr().is_terminal();
        Speaker {
            quiet,
            terminal,
            of,
            state: Mutex::new(state),
        }
    }

    fn draw(&self, state: &mut State) {
        if self.terminal && !self.quiet {
            let running: Vec<String> = state
                .running
                .iter()
                .map(|(node, at)| format!("{node}{at}"))
                .collect();
            let line = format!("[{}/{}] {}", state.done, self.of, running.join(", "));
            let line: String = line.chars().take(110).collect();
            let _ = write!(std::io::stderr(), "\r\x1b[K{line}");
            state.drawn = Instant::now();
        }
    }
}

impl Watch for Speaker {
    fn started(&self, node: &str) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.running.push((node.into(), String::new()));
        self.draw(&mut state);
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        let mut state = self.state.lock().expect("bug: poisoned");
        if let Some(entry) = state.running.iter_mut().find(|(name, _)| name == node) {
            entry.1 = format!(" ({label} {done}/{of})");
        }
        if state.drawn.elapsed().as_millis() > 100 {
            self.draw(&mut state);
        }
    }

    fn done(&self, node: &str, done: &Done) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.running.retain(|(name, _)| name != node);
        state.done += 1;
        if self.quiet {
            return;
        }
        let fate = match &done.fate {
            Fate::Found => "found".into(),
            Fate::Made => format!("made in {:.1} s", done.seconds),
            Fate::Failed(_) => "FAILED".into(),
            Fate::Skipped => "skipped".into(),
            Fate::Cancelled => "stopped".into(),
        };
        if self.terminal {
            eprint!("\r\x1b[K");
        }
        let number = |m: &stage::Metric| format!("{} {:.4} {}", m.name, m.value, m.unit);
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
        eprintln!("[{:>2}/{}] {node:<12} {fate}{numbers}", state.done, self.of);
        for warning in &done.warnings {
            eprintln!("        warning: {warning}");
        }
        self.draw(&mut state);
        if self.terminal && state.done == self.of {
            eprint!("\r\x1b[K");
        }
    }
}
