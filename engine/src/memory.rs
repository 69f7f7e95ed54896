//! Memory that stages share: those that need more than is left run one after the other.

use std::sync::{Condvar, Mutex, OnceLock};
use std::time::Duration;
use system::free_memory;

/// What stages declare that they need, against what was free before the first of them.
#[derive(Default)]
pub(crate) struct Memory {
    free: OnceLock<u64>,
    taken: Mutex<u64>,
    bell: Condvar,
}

/// Taken while a stage runs. \[bytes\]
pub(crate) struct Share<'a>(&'a Memory, u64);

impl Drop for Share<'_> {
    fn drop(&mut self) {
        *self.0.taken.lock().expect("bug: poisoned") -= self.1;
        self.0.bell.notify_all();
    }
}

/// How often it is asked whether to stop waiting.
const ASK: Duration = Duration::from_millis(50);

impl Memory {
    /// Takes so many bytes; waits while other stages have what is wanted. Who wants more than there is
    /// runs alone. Whoever asks to stop need not wait.
    pub(crate) fn take(&self, bytes: u64, stop: &dyn Fn() -> bool) -> Share<'_> {
        let mut taken = self.taken.lock().expect("bug: poisoned");
        if bytes > 0 {
            let free = *self.free.get_or_init(|| free_memory().unwrap_or(u64::MAX));
            while *taken > 0 && taken.saturating_add(bytes) > free && !stop() {
                let waited = self.bell.wait_timeout(taken, ASK);
                taken = waited.expect("bug: poisoned").0;
            }
        }
        // Nobody has more than everything.
        let bytes = bytes.min(u64::MAX / 4);
        *taken = taken.saturating_add(bytes);
        Share(self, bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_much_waits_and_what_fits_does_not() {
        let memory = Memory::default();
        memory.free.set(100).unwrap();
        let never = || false;
        let first = memory.take(60, &never);
        let _second = memory.take(40, &never);
        let nothing = memory.take(0, &never);
        let count = std::sync::atomic::AtomicUsize::new(0);
        let third = memory.take(1, &|| {
            count.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == 2
        });
        assert_eq!(count.into_inner(), 3, "waited until it was asked to stop");
        drop((first, third, nothing));
        let _fits = memory.take(60, &never);
        assert_eq!(*memory.taken.lock().unwrap(), 100);
    }
}
