//! How long a stage ran, without the stages that its thread ran meanwhile: a thread of the pool that
//! waits for the rest of a loop may take up another stage's whole run.

use std::cell::Cell;
use std::time::{Duration, Instant};
use system::clock;

thread_local! {
    /// What runs inside the present one took on this thread.
    static INSIDE: Cell<Duration> = const { Cell::new(Duration::ZERO) };
}

/// Ends a run when it goes, by a panic too: the time counts as inside of what ran around it.
struct Running {
    start: Instant,
    around: Duration,
}

impl Running {
    fn begin() -> Running {
        Running {
            start: clock::instant(),
            around: INSIDE.replace(Duration::ZERO),
        }
    }

    /// Without what ran inside.
    fn own(&self) -> Duration {
        clock::since(self.start).saturating_sub(INSIDE.get())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        INSIDE.set(self.around + clock::since(self.start));
    }
}

/// Runs it and returns how long it took, without what was timed inside of it on the same thread.
pub(crate) fn timed<T>(run: impl FnOnce() -> T) -> (T, Duration) {
    let running = Running::begin();
    let result = run();
    let own = running.own();
    (result, own)
}

#[cfg(test)]
mod tests {
    use super::timed;
    use std::time::{Duration, Instant};

    fn busy(ms: u64) {
        let start = Instant::now();
        while start.elapsed() < Duration::from_millis(ms) {}
    }

    #[test]
    fn a_run_inside_of_another_counts_once() {
        let start = Instant::now();
        let ((inner, second), outer) = timed(|| {
            busy(10);
            let ((), inner) = timed(|| busy(40));
            let broken = std::panic::catch_unwind(|| timed(|| panic!("{}", 1)));
            assert!(broken.is_err());
            let ((), second) = timed(|| busy(20));
            (inner, second)
        });
        let whole = start.elapsed();
        assert!(inner >= Duration::from_millis(40) && second >= Duration::from_millis(20));
        assert!(outer >= Duration::from_millis(10));
        assert!(
            outer + inner + second <= whole,
            "{outer:?} {inner:?} {second:?} {whole:?}"
        );
    }
}
