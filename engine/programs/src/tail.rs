//! The last lines of a program.

use std::collections::VecDeque;
use system::text::escaped;

/// The last lines that a program printed, for messages.
#[derive(Default)]
pub(crate) struct Tail(VecDeque<String>);

const TAIL_LINES: usize = 20;
const SHOWN_OF_LINE: usize = 300;

impl Tail {
    pub(crate) fn push(&mut self, line: &str) {
        let shown: String = line.chars().take(SHOWN_OF_LINE).collect();
        self.0.push_back(escaped(&shown, &['\t']));
        if self.0.len() > TAIL_LINES {
            self.0.pop_front();
        }
    }

    /// Behind a message: nothing, or the last lines.
    pub(crate) fn text(&self) -> String {
        let lines: String = self.0.iter().map(|l| format!("\n  | {l}")).collect();
        match lines.is_empty() {
            true => String::new(),
            false => format!("; its last lines:{lines}"),
        }
    }
}
