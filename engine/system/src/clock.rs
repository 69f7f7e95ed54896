//! The one clock: for names, stamps and durations, never for a key or a result.

use std::time::{Duration, Instant};

/// Nanoseconds since 1970.
pub fn now_ns() -> i128 {
    if let Some(time) = simulated::time() {
        return time.wall_ns;
    }
    #[expect(
        clippy::disallowed_methods,
        reason = "the one clock, outside of keys and results"
    )]
    let now = std::time::SystemTime::now();
    now.duration_since(std::time::UNIX_EPOCH)
        .map_or(0, |d| d.as_nanos() as i128)
}

/// A moment, to be compared with later ones of this process.
pub fn instant() -> Instant {
    if let Some(time) = simulated::time() {
        return simulated::begin() + time.passed;
    }
    Instant::now()
}

/// How long ago a moment was.
pub fn since(moment: Instant) -> Duration {
    instant().saturating_duration_since(moment)
}

/// Waits for so long.
pub fn pause(time: Duration) {
    if simulated::pass(time) {
        return;
    }
    std::thread::sleep(time);
}

/// Whether this thread lives in a simulation: then nothing is left to other threads.
pub fn is_simulated() -> bool {
    simulated::time().is_some()
}

/// The clock of a simulation, which tests set: of one thread, and standing still until it is set again.
pub mod simulated {
    use std::cell::Cell;
    use std::sync::OnceLock;
    use std::time::{Duration, Instant};

    /// The time on a machine's clocks.
    #[derive(Debug, Clone, Copy)]
    pub struct Time {
        /// Nanoseconds since 1970, right or not.
        pub wall_ns: i128,
        /// Since the simulation began.
        pub passed: Duration,
    }

    thread_local! {
        static COUNT: Cell<u64> = const { Cell::new(0) };
        static TIME: Cell<Option<Time>> = const { Cell::new(None) };
    }

    pub(super) fn begin() -> Instant {
        static BEGIN: OnceLock<Instant> = OnceLock::new();
        *BEGIN.get_or_init(Instant::now)
    }

    /// The time in this thread's simulation, if there is one.
    pub fn time() -> Option<Time> {
        TIME.get()
    }

    /// A number that this simulation has not had before, if there is one.
    pub fn count() -> Option<u64> {
        TIME.get().map(|_| COUNT.replace(COUNT.get() + 1))
    }

    /// Sets it, or ends the simulation.
    pub fn set(time: Option<Time>) {
        if time.is_none() {
            COUNT.set(0);
        }
        TIME.set(time);
    }

    /// Lets time pass, if there is a simulation.
    pub fn pass(by: Duration) -> bool {
        let Some(time) = TIME.get() else { return false };
        let wall_ns = time.wall_ns + by.as_nanos() as i128;
        let passed = time.passed + by;
        TIME.set(Some(Time { wall_ns, passed }));
        true
    }
}
