//! The process, looked at every few milliseconds: what each of its threads had of the processor, and its memory.

use crate::system::{resident_bytes, thread_times};
use std::sync::{Condvar, Mutex};
use std::thread::Builder;
use std::time::{Duration, Instant};

/// How often. \[ms\]
const EVERY_MS: u64 = 20;

/// The process at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    /// Since the run began. \[s\]
    pub(crate) t: f64,
    /// What each thread had of the processor since it began, by its number, which grows. \[s\]
    pub(crate) threads: Vec<(u64, f64)>,
    /// Memory that it has now. \[bytes\]
    pub(crate) resident: u64,
}

/// Looks at the process until the run is over.
#[derive(Default)]
pub(crate) struct Sampler {
    over: Mutex<bool>,
    reported: Condvar,
}

/// Tells the sampler that the run is over, by a panic too.
struct Over<'a>(&'a Sampler);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        if let Ok(mut over) = self.0.over.lock() {
            *over = true;
        }
        self.0.reported.notify_all();
    }
}

impl Sampler {
    /// Runs it, and what was seen meanwhile.
    pub(crate) fn around<T>(start: Instant, run: impl FnOnce() -> T) -> (T, Vec<Sample>) {
        let sampler = Sampler::default();
        std::thread::scope(|scope| {
            // Where the system gives no more threads, nothing is seen meanwhile.
            let looks = Builder::new().spawn_scoped(scope, || sampler.look(start));
            let over = Over(&sampler);
            let made = run();
            drop(over);
            (
                made,
                looks
                    .ok()
                    .and_then(|looks| looks.join().ok())
                    .unwrap_or_default(),
            )
        })
    }

    fn look(&self, start: Instant) -> Vec<Sample> {
        let mut samples = Vec::new();
        let mut over = self.over.lock().expect("bug: poisoned");
        loop {
            let now = thread_times().zip(resident_bytes("self"));
            // A system that does not report it now will not do so later.
            let Some((threads, resident)) = now else {
                return samples;
            };
            let t = start.elapsed().as_secs_f64();
            samples.push(Sample {
                t,
                threads,
                resident,
            });
            if *over {
                return samples;
            }
            let wait = Duration::from_millis(EVERY_MS);
            over = self
                .reported
                .wait_timeout(over, wait)
                .expect("bug: poisoned")
                .0;
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn a_busy_thread_is_seen_and_no_time_runs_back() {
        let busy = || {
            let start = Instant::now();
            let mut x = 0u64;
            while start.elapsed() < Duration::from_millis(200) {
                x = std::hint::black_box(x + 1);
            }
        };
        let ((), samples) = Sampler::around(Instant::now(), busy);
        assert!(samples.len() > 2);
        let whole = |s: &Sample| s.threads.iter().map(|(_, t)| t).sum::<f64>();
        let (first, last) = (&samples[0], &samples[samples.len() - 1]);
        // How much of it the machine gave depends on its load.
        assert!(whole(last) > whole(first) && last.resident > 0);
        assert!(samples.windows(2).all(|w| w[0].t <= w[1].t));
    }
}
