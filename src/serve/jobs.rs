//! What is being measured: one capture at a time, each once, whoever asks.

use super::home::Place;
use super::progress::Progress;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::Duration;
use tokio::sync::watch;

/// A capture that is being measured, or was since the server began.
pub(super) struct Job {
    /// Whoever looks.
    pub(super) sender: watch::Sender<Progress>,
    /// Set when it is to stop.
    pub(super) cancel: AtomicBool,
}

/// All of them.
#[derive(Default)]
pub(super) struct Jobs {
    jobs: Mutex<BTreeMap<String, Arc<Job>>>,
    /// Whether one runs; a run uses all cores and much memory.
    busy: Mutex<bool>,
    free: Condvar,
}

/// How often a job that waits looks whether it is to stop.
const LOOK: Duration = Duration::from_millis(100);

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|e| e.into_inner())
}

impl Jobs {
    /// The job of a capture, if there was one since the server began.
    pub(super) fn of(&self, id: &str) -> Option<Arc<Job>> {
        locked(&self.jobs).get(id).cloned()
    }

    /// How far a capture is: by its job, else as the disk knows it.
    pub(super) fn progress(&self, place: &Place) -> Progress {
        match self.of(&place.id) {
            Some(job) => job.sender.borrow().clone(),
            None => Progress::past(place.ended().as_ref()),
        }
    }

    /// The capture's job; `true` if it is new and somebody must do it.
    pub(super) fn begin(&self, id: &str) -> (Arc<Job>, bool) {
        let mut jobs = locked(&self.jobs);
        if let Some(job) = jobs.get(id).filter(|job| job.sender.borrow().goes_on()) {
            return (Arc::clone(job), false);
        }
        let waiting = Progress {
            state: "waiting",
            ..Progress::default()
        };
        let job = Job {
            sender: watch::Sender::new(waiting),
            cancel: AtomicBool::new(false),
        };
        let job = Arc::new(job);
        jobs.insert(id.to_owned(), Arc::clone(&job));
        (job, true)
    }

    /// Takes a capture's job out, unless somebody works on it; whether nobody does.
    pub(super) fn drop_idle(&self, id: &str) -> bool {
        let mut jobs = locked(&self.jobs);
        let idle = jobs
            .get(id)
            .is_none_or(|job| !job.sender.borrow().goes_on());
        if idle {
            jobs.remove(id);
        }
        idle
    }

    /// Does something when no other job does; not at all if the job is to stop before.
    pub(super) fn alone<T>(&self, job: &Job, what: impl FnOnce() -> T) -> Option<T> {
        let mut busy = locked(&self.busy);
        while *busy {
            if job.cancel.load(Ordering::Relaxed) {
                return None;
            }
            let waited = self.free.wait_timeout(busy, LOOK);
            busy = waited.unwrap_or_else(|e| e.into_inner()).0;
        }
        if job.cancel.load(Ordering::Relaxed) {
            return None;
        }
        *busy = true;
        drop(busy);
        let _freed = Freed(self);
        Some(what())
    }

    /// Stops all, and waits until all have.
    pub(super) fn stop(&self) {
        for job in locked(&self.jobs).values() {
            job.cancel.store(true, Ordering::Relaxed);
        }
        while locked(&self.jobs)
            .values()
            .any(|job| job.sender.borrow().goes_on())
        {
            std::thread::sleep(LOOK);
        }
    }
}

/// The next one's turn, also after a panic.
struct Freed<'a>(&'a Jobs);

impl Drop for Freed<'_> {
    fn drop(&mut self) {
        *locked(&self.0.busy) = false;
        self.0.free.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_capture_is_joined_and_another_waits_its_turn() {
        let jobs = Arc::new(Jobs::default());
        let (a, new) = jobs.begin("a");
        let (again, joined) = jobs.begin("a");
        assert!(new && !joined && Arc::ptr_eq(&a, &again) && !jobs.drop_idle("a"));
        let (b, _) = jobs.begin("b");
        let (at_work, seen) = std::sync::mpsc::channel();
        let (finish, finished) = std::sync::mpsc::channel::<()>();
        let first = {
            let jobs = Arc::clone(&jobs);
            std::thread::spawn(move || {
                jobs.alone(&a, || {
                    at_work.send(()).unwrap();
                    finished.recv().unwrap();
                })
            })
        };
        seen.recv().unwrap();
        b.cancel.store(true, Ordering::Relaxed);
        assert_eq!(jobs.alone(&b, || 1), None, "stopped while it waited");
        finish.send(()).unwrap();
        assert!(first.join().unwrap().is_some());
        b.cancel.store(false, Ordering::Relaxed);
        assert_eq!(jobs.alone(&b, || 2), Some(2));
        b.sender.send_modify(|p| p.state = "done");
        assert!(jobs.drop_idle("b") && jobs.of("b").is_none());
    }
}
