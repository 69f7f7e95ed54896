//! How long at least one stage ran: what is left of a point's time is the engine's.

use crate::walk::{Done, Status, Watch};
use std::sync::Mutex;
use std::thread::ThreadId;
use std::time::{Duration, Instant};

/// Notes when each stage ran.
#[derive(Default)]
pub(super) struct Busy {
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Stages that run, by the thread that waits for them, and since when.
    running: Vec<(ThreadId, Instant)>,
    /// From when to when stages ran that are done.
    spans: Vec<(Instant, Instant)>,
}

impl Busy {
    /// How long at least one stage ran between two moments. \[s\] What was before is forgotten: moments are
    /// asked in their order.
    pub(super) fn seconds(&self, from: Instant, to: Instant) -> f64 {
        let mut state = self.state.lock().expect("bug: poisoned");
        state.spans.retain(|(_, end)| *end > from);
        let running = state.running.iter().map(|(_, since)| (*since, to));
        let mut spans: Vec<(Instant, Instant)> =
            state.spans.iter().copied().chain(running).collect();
        drop(state);
        spans.sort();
        let (mut all, mut until) = (Duration::ZERO, from);
        for (begin, end) in spans {
            let (begin, end) = (begin.max(until), end.min(to));
            all += end.saturating_duration_since(begin);
            until = until.max(end);
        }
        all.as_secs_f64()
    }
}

impl Watch for Busy {
    fn started(&self, _node: &str) {
        let mut state = self.state.lock().expect("bug: poisoned");
        state
            .running
            .push((std::thread::current().id(), Instant::now()));
    }

    fn done(&self, _node: &str, done: &Done) {
        let mut state = self.state.lock().expect("bug: poisoned");
        let thread = std::thread::current().id();
        let at = state.running.iter().position(|(t, _)| *t == thread);
        if let Some((_, from)) = at.map(|at| state.running.swap_remove(at)) {
            // The time that the stage itself took: what it took to keep its result is the engine's.
            let to = match done.status {
                Status::Executed => from + Duration::from_secs_f64(done.seconds),
                _ => Instant::now(),
            };
            state.spans.push((from, to));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_side_by_side_count_once() {
        let busy = Busy::default();
        let zero = Instant::now();
        let at = |s: u64| zero + Duration::from_secs(s);
        let spans = [
            (at(5), at(7)),
            (at(0), at(2)),
            (at(1), at(3)),
            (at(5), at(6)),
        ];
        busy.state.lock().unwrap().spans.extend(spans);
        assert_eq!(busy.seconds(zero, at(9)), 5.0);
        assert_eq!(busy.seconds(at(2), at(6)), 2.0);
        assert_eq!(busy.seconds(at(6), at(9)), 1.0);
        busy.done("found", &Done::nothing(Status::Hit));
        assert_eq!(
            busy.seconds(at(6), at(9)),
            1.0,
            "what did not start did not run"
        );
        busy.started("now");
        let begun = busy.state.lock().unwrap().running[0].1;
        let later = begun + Duration::from_secs(3);
        proof::near(busy.seconds(begun, later), 3.0, 1e-9);
    }
}
