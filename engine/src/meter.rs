//! What stages take of the processor and of memory, while several may run at once.
//!
//! Whenever a stage begins or ends, what the process has had of the processor since the last time goes in even shares to
//! those that ran meanwhile. Memory is that of the process, looked at then and every few milliseconds. Neither is part of
//! a key or a result; a system that gives no numbers gives none here.

use stage::Metric;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, Weak};
use std::thread::Builder;
use std::time::Duration;
use system::clock;
use system::{processor_seconds, resident_bytes};

/// How often memory is looked at. \[ms\]
const EVERY_MS: u64 = 20;

/// What a stage took; `None` where the system gives no numbers, or the result was made before it was asked.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Spent {
    /// Of the processor, programs that it ran and that ended included: an even share where several ran at once. \[s\]
    pub processor: Option<f64>,
    /// The most memory that the process had meanwhile. \[bytes\]
    pub memory: Option<u64>,
}

/// Under these names records keep it among a result's metrics.
const KEPT: [&str; 2] = ["engine processor", "engine memory"];

impl Spent {
    /// As records keep it.
    pub(crate) fn metrics(&self) -> impl Iterator<Item = Metric> {
        let values = [self.processor, self.memory.map(|bytes| bytes as f64)];
        let all = KEPT.into_iter().zip(values).zip(["s", "B"]);
        all.filter_map(|((name, value), unit)| {
            Some(Metric {
                name: name.into(),
                value: value?,
                unit: unit.into(),
            })
        })
    }

    /// Out of a record's metrics, which lose it.
    pub(crate) fn taken(metrics: &mut Vec<Metric>) -> Spent {
        let found = KEPT.map(|name| Some(metrics.iter().find(|m| m.name == name)?.value));
        metrics.retain(|m| !KEPT.contains(&m.name.as_str()));
        let sound = |x: &f64| x.is_finite() && *x >= 0.0;
        let [processor, memory] = found.map(|value| value.filter(sound));
        Spent {
            processor,
            memory: memory.map(|bytes| bytes as u64),
        }
    }
}

/// Measures the stages of a run.
#[derive(Default)]
pub(crate) struct Meter(Arc<Shared>);

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    bell: Condvar,
}

#[derive(Default)]
struct State {
    running: Vec<(u64, Spent)>,
    /// What the process had had of the processor. \[s\]
    before: Option<f64>,
    next: u64,
    looked_after: bool,
}

impl State {
    /// Parts what was had since the last time among those that run.
    fn part(&mut self) {
        let now = processor_seconds();
        if let (Some(before), Some(now)) = (self.before, now) {
            let share = (now - before).max(0.0) / self.running.len().max(1) as f64;
            for (_, spent) in &mut self.running {
                spent.processor = Some(spent.processor.unwrap_or(0.0) + share);
            }
        }
        self.before = now;
        self.weigh();
    }

    /// Looks at memory.
    fn weigh(&mut self) {
        if let Some(bytes) = resident_bytes("self") {
            for (_, spent) in &mut self.running {
                spent.memory = Some(spent.memory.unwrap_or(0).max(bytes));
            }
        }
    }
}

/// A stage that is measured as long as this lives.
pub(crate) struct Measured<'a> {
    meter: &'a Meter,
    id: Option<u64>,
}

impl Meter {
    /// A stage begins. In a simulation nothing is measured.
    pub(crate) fn begin(&self) -> Measured<'_> {
        if clock::is_simulated() {
            return Measured {
                meter: self,
                id: None,
            };
        }
        let mut state = self.0.lock();
        state.part();
        let id = state.next;
        state.next += 1;
        state.running.push((id, Spent::default()));
        state.weigh();
        if !state.looked_after {
            let shared = Arc::downgrade(&self.0);
            // Without a thread memory is looked at when stages begin and end.
            let looks = Builder::new().spawn(move || look(&shared));
            state.looked_after = looks.is_ok();
        }
        Measured {
            meter: self,
            id: Some(id),
        }
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("bug: poisoned")
    }
}

/// Looks at memory as long as something runs and somebody measures.
fn look(shared: &Weak<Shared>) {
    while let Some(shared) = shared.upgrade() {
        let mut state = shared.lock();
        if state.running.is_empty() {
            state.looked_after = false;
            return;
        }
        state.weigh();
        let wait = Duration::from_millis(EVERY_MS);
        drop(shared.bell.wait_timeout(state, wait));
    }
}

impl Measured<'_> {
    /// What it took until now.
    pub(crate) fn end(self) -> Spent {
        if self.id.is_none() {
            return Spent::default();
        }
        let mut state = self.meter.0.lock();
        state.part();
        let own = state.running.iter().find(|(id, _)| Some(*id) == self.id);
        own.map_or(Spent::default(), |(_, spent)| *spent)
    }
}

impl Drop for Measured<'_> {
    fn drop(&mut self) {
        let mut state = self.meter.0.lock();
        state.running.retain(|(id, _)| Some(*id) != self.id);
        if state.running.is_empty() {
            self.meter.0.bell.notify_all();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_had_is_parted_among_those_that_run() {
        let ran = |id: u64| (id, Spent::default());
        let mut state = State {
            running: vec![ran(1), ran(2)],
            before: processor_seconds().map(|now| now - 3.0),
            ..State::default()
        };
        state.part();
        let known = state.running[0].1.processor;
        assert!(known.is_some() || cfg!(not(target_os = "linux")));
        let Some(processor) = known else { return };
        assert!((1.5..2.5).contains(&processor), "{processor}");
        assert_eq!(state.running[0].1.processor, state.running[1].1.processor);
        assert!(state.running[1].1.memory > Some(100_000));
    }

    #[test]
    fn a_busy_stage_is_measured_and_an_idle_process_is_let_go() {
        let meter = Meter::default();
        let outer = meter.begin();
        let start = clock::instant();
        let mut x = 0u64;
        while clock::since(start) < Duration::from_millis(300) {
            x = std::hint::black_box(x + 1);
        }
        let inner = meter.begin().end();
        let outer = outer.end();
        if cfg!(target_os = "linux") {
            // How much the machine gave is not ours to decide.
            assert!(outer.processor > inner.processor && outer.memory.is_some());
        }
        assert!(meter.0.lock().running.is_empty());
    }

    #[test]
    fn records_keep_it_among_metrics_and_give_it_back() {
        let own = Metric {
            name: "volume".into(),
            value: 61.0,
            unit: "l".into(),
        };
        let spent = Spent {
            processor: Some(1.5),
            memory: Some(3_000_000),
        };
        let mut metrics = vec![own.clone()];
        metrics.extend(spent.metrics());
        assert_eq!(metrics.len(), 3);
        assert_eq!(Spent::taken(&mut metrics), spent);
        assert_eq!(metrics, [own]);
        assert_eq!(Spent::taken(&mut metrics), Spent::default());
        let mut strange: Vec<Metric> = spent.metrics().collect();
        strange[0].value = f64::NAN;
        strange[1].value = -1.0;
        assert_eq!(Spent::taken(&mut strange), Spent::default());
    }
}
