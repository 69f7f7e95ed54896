//! How long a store that does not answer may delay a run: no longer than was given, all its waits together.

use std::thread::{Builder, JoinHandle};
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
    #[cfg(feature = "remote")]
    pub(super) fn of_a_large_answer(self) -> Duration {
        LONGEST_ANSWER
    }

    /// For one question: after that it is not asked again at once.
    pub(super) fn of_a_question(self) -> Duration {
        self.0 / 4
    }

    /// Whether a place that delayed a run for so long is not asked again by who waits.
    pub(super) fn is_over(self, stalled: Duration) -> bool {
        !stalled.is_zero() && stalled >= self.of_a_question()
    }
}

thread_local! {
    /// Whether this thread uploads beside the work: nobody waits for it.
    static BESIDE: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// Marks this thread: it uploads beside the work.
pub(super) fn beside() {
    BESIDE.set(true);
}

/// So many threads that work. Where the system gives fewer, those that there are do it all.
///
/// # Errors
///
/// It gives none.
pub(super) fn threads(
    many: usize,
    work: impl FnOnce() + Clone + Send + 'static,
) -> std::io::Result<Vec<JoinHandle<()>>> {
    let mut all = Vec::new();
    while all.len() < many {
        match Builder::new().spawn(work.clone()) {
            Ok(thread) => all.push(thread),
            Err(why) if all.is_empty() => return Err(why),
            Err(_) => break,
        }
    }
    Ok(all)
}

/// As long as something is done, this thread uploads beside the work.
#[cfg(test)]
pub(crate) fn working_beside<T>(work: impl FnOnce() -> T) -> T {
    let before = BESIDE.replace(true);
    let done = work();
    BESIDE.set(before);
    done
}

/// Whether this thread does.
pub(super) fn is_beside() -> bool {
    BESIDE.get()
}
