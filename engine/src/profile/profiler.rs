//! Listens to a run and looks at the process meanwhile.

use super::sample::{Sample, Sampler};
use super::spans::{Span, Spans};
use crate::done::{Done, Watch};
use stage::Hash;
use std::sync::Mutex;
use std::time::Instant;

/// Listens to a run, notes when nodes and loops began and ended, and passes it on.
pub struct Profiler<'a> {
    listener: &'a dyn Watch,
    start: Instant,
    spans: Mutex<Spans>,
}

/// What was noted of a run.
pub struct Profile {
    /// Nodes and loops, in the order in which they began.
    pub(crate) spans: Vec<Span>,
    /// The process every few milliseconds; empty where the system does not report it.
    pub(crate) samples: Vec<Sample>,
}

impl Profile {
    /// Whether nothing of the process is known.
    pub fn is_blind(&self) -> bool {
        self.samples.is_empty()
    }
}

impl<'a> Profiler<'a> {
    /// Gets the events of a run, and passes them on.
    pub fn new(listener: &'a dyn Watch) -> Self {
        Profiler {
            listener,
            start: Instant::now(),
            spans: Mutex::default(),
        }
    }

    /// Runs it, and looks at the process meanwhile.
    pub fn around<T>(&self, run: impl FnOnce() -> T) -> (T, Profile) {
        let (made, samples) = Sampler::around(self.start, run);
        let end = self.now();
        let mut spans = self.spans.lock().expect("bug: poisoned");
        let spans = std::mem::take(&mut *spans).ended(end);
        (made, Profile { spans, samples })
    }

    fn now(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn note(&self, what: impl FnOnce(&mut Spans, f64)) {
        let now = self.now();
        what(&mut self.spans.lock().expect("bug: poisoned"), now);
    }
}

impl Watch for Profiler<'_> {
    fn started(&self, node: &str) {
        self.note(|spans, now| spans.begin(node, None, now));
        self.listener.started(node);
    }
    fn waits(&self, node: &str) {
        self.listener.waits(node);
    }
    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        self.note(|spans, now| spans.progress(node, label, (done, of), now));
        self.listener.progress(node, label, done, of);
    }
    fn differs(&self, node: &str, theirs: Hash, ours: Hash) {
        self.listener.differs(node, theirs, ours);
    }
    fn done(&self, node: &str, done: &Done) {
        self.note(|spans, now| spans.end(node, now));
        self.listener.done(node, done);
    }
}
