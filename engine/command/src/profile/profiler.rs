//! Listens to a run.

use super::cost::{Cost, costs};
use super::spans::{Span, Spans};
use super::trace::trace;
use engine::walk::{Done, Watch};
use serde_json::Value;
use std::sync::Mutex;
use std::time::Instant;

/// Notes when nodes and loops of a run began and ended.
pub(crate) struct Profiler {
    start: Instant,
    spans: Mutex<Spans>,
}

/// What was noted of a run: nodes and loops, in the order in which they began.
pub(crate) struct Profile(Vec<Span>);

impl Profile {
    /// What nodes and loops took; a loop that ran several times is one.
    pub(crate) fn costs(&self) -> Vec<Cost> {
        costs(&self.0)
    }

    /// As a trace.
    pub(crate) fn trace(&self) -> Value {
        trace(&self.0)
    }
}

impl Default for Profiler {
    fn default() -> Self {
        Profiler {
            start: Instant::now(),
            spans: Mutex::default(),
        }
    }
}

impl Profiler {
    /// What was noted, once the run is over.
    pub(crate) fn profile(self) -> Profile {
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

impl Watch for Profiler {
    fn started(&self, node: &str) {
        self.note(|spans, now| spans.begin(node, None, now));
    }
    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        self.note(|spans, now| spans.progress(node, label, (done, of), now));
    }
    fn done(&self, node: &str, done: &Done) {
        self.note(|spans, now| spans.end(node, done.spent, now));
    }
}
