//! Listens to a run.

use super::cost::{Cost, costs};
use super::spans::{Span, Spans};
use super::trace::trace;
use crate::done::{Done, Watch};
use serde_json::Value;
use stage::Hash;
use std::sync::Mutex;
use std::time::Instant;

/// Listens to a run, notes when nodes and loops began and ended, and passes it on.
pub struct Profiler<'a> {
    listener: &'a dyn Watch,
    start: Instant,
    spans: Mutex<Spans>,
}

/// What was noted of a run: nodes and loops, in the order in which they began.
pub struct Profile(Vec<Span>);

impl Profile {
    /// What nodes and loops took; a loop that ran several times is one.
    pub fn costs(&self) -> Vec<Cost> {
        costs(&self.0)
    }

    /// As a trace.
    pub fn trace(&self) -> Value {
        trace(&self.0)
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

    /// What was noted, once the run is over.
    pub fn profile(self) -> Profile {
        let end = self.now();
        let spans = self.spans.into_inner().expect("bug: poisoned");
        Profile(spans.ended(end))
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
        self.note(|spans, now| spans.end(node, done.spent, now));
        self.listener.done(node, done);
    }
}
