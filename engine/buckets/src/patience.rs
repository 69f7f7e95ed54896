//! How long a store that does not answer may delay a run: no longer than was given, all its waits together.

use std::time::Duration;

/// The given time, shared out among the waits there are: questions before results are known, uploads at the end, and
/// the answer to the last of these.
#[derive(Debug, Clone, Copy)]
pub struct Patience(Duration);

impl Default for Patience {
    fn default() -> Patience {
        Patience(Duration::from_secs(60))
    }
}

/// No answer is waited for longer, from one byte to the next.
const LONGEST_ANSWER: Duration = Duration::from_secs(20);

/// Nobody answers faster than this over any network, so no less is waited for, as long as three such waits fit.
const SHORTEST_ANSWER: Duration = Duration::from_secs(1);

impl Patience {
    /// So long, all in all.
    pub fn of(all: Duration) -> Patience {
        Patience(all)
    }

    /// For one answer, from one byte to the next.
    pub fn of_an_answer(self) -> Duration {
        let share = (self.0 / 8).max(SHORTEST_ANSWER).min(self.0 / 3);
        share.clamp(Duration::from_millis(100), LONGEST_ANSWER)
    }

    /// For the answer to what was sent, however large.
    pub fn of_a_large_answer(self) -> Duration {
        LONGEST_ANSWER
    }

    /// For one question: after that it is not asked again at once.
    pub fn of_a_question(self) -> Duration {
        self.0 / 4
    }

    /// Whether a place that delayed a run for so long is not asked again by who waits.
    pub fn is_over(self, stalled: Duration) -> bool {
        !stalled.is_zero() && stalled >= self.of_a_question()
    }
}
