//! What a node or a loop took: of the clock, of the processor, of memory.

use super::profiler::Profile;
use super::sample::Sample;
use super::spans::Span;

/// What a span took.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// The node.
    pub node: String,
    /// The loop in it; `None` for the node itself.
    pub label: Option<String>,
    /// By the clock; the sum where a loop ran several times. \[s\]
    pub seconds: f64,
    /// Of the processor: an even share where several nodes ran at once. `None` where the system has no numbers. \[s\]
    pub processor: Option<f64>,
    /// The most memory that the process had meanwhile. \[bytes\]
    pub resident: Option<u64>,
}

/// What nodes and loops took, in the order in which they began; a loop that ran several times is one.
pub fn costs(profile: &Profile) -> Vec<Cost> {
    let busy = busy(&profile.samples);
    let nodes: Vec<&Span> = profile.spans.iter().filter(|s| s.label.is_none()).collect();
    let running = |t: f64| {
        nodes
            .iter()
            .filter(|n| n.from <= t && t < n.to)
            .count()
            .max(1)
    };
    let mut all: Vec<Cost> = Vec::new();
    for span in &profile.spans {
        let inside = |from: f64, to: f64| (span.to.min(to) - span.from.max(from)).max(0.0);
        let share = |&(from, to, rate): &(f64, f64, f64)| {
            rate * inside(from, to) / running((from + to) / 2.0) as f64
        };
        let known = !busy.is_empty();
        let processor = known.then(|| busy.iter().map(share).sum::<f64>());
        let meanwhile = profile
            .samples
            .iter()
            .filter(|s| span.from <= s.t && s.t <= span.to);
        let resident = meanwhile.map(|s| s.resident).max();
        let same = |c: &&mut Cost| c.node == span.node && c.label == span.label;
        match all.iter_mut().find(same) {
            Some(cost) => {
                cost.seconds += span.to - span.from;
                cost.processor = cost.processor.zip(processor).map(|(a, b)| a + b);
                cost.resident = cost.resident.max(resident);
            }
            None => all.push(Cost {
                node: span.node.clone(),
                label: span.label.clone(),
                seconds: span.to - span.from,
                processor,
                resident,
            }),
        }
    }
    all
}

/// How many threads were busy between two samples: from, to, threads.
pub(super) fn busy(samples: &[Sample]) -> Vec<(f64, f64, f64)> {
    let between = |pair: &[Sample]| {
        let (a, b) = (&pair[0], &pair[1]);
        let seconds: f64 = shares(a, b).iter().map(|(_, s)| s).sum();
        (a.t, b.t, seconds / (b.t - a.t).max(1e-9))
    };
    samples.windows(2).map(between).collect()
}

/// What each thread had of the processor between two samples. \[s\]
pub(super) fn shares(a: &Sample, b: &Sample) -> Vec<(u64, f64)> {
    let before = |id: u64| {
        let at = a.threads.binary_search_by_key(&id, |(id, _)| *id);
        at.map_or(0.0, |i| a.threads[i].1)
    };
    let share = |&(id, seconds): &(u64, f64)| (id, (seconds - before(id)).max(0.0));
    b.threads.iter().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(node: &str, label: Option<&str>, from: f64, to: f64) -> Span {
        Span {
            node: node.into(),
            label: label.map(str::to_owned),
            from,
            to,
        }
    }

    fn sample(t: f64, threads: &[(u64, f64)], resident: u64) -> Sample {
        Sample {
            t,
            threads: threads.to_vec(),
            resident,
        }
    }

    #[test]
    fn time_of_the_processor_is_parted_among_what_runs() {
        let profile = Profile {
            spans: vec![
                span("a", None, 0.0, 2.0),
                span("a", Some("loop"), 0.0, 0.5),
                span("b", None, 1.0, 3.0),
                span("a", Some("loop"), 0.5, 1.0),
            ],
            // Two threads for two seconds, then one; thread 9 begins in the last second.
            samples: vec![
                sample(0.0, &[(1, 5.0), (2, 1.0)], 10),
                sample(1.0, &[(1, 6.0), (2, 2.0)], 30),
                sample(2.0, &[(1, 7.0), (2, 3.0)], 20),
                sample(3.0, &[(1, 7.0), (2, 3.0), (9, 1.0)], 25),
            ],
        };
        let reported: Vec<_> = costs(&profile)
            .into_iter()
            .map(|c| {
                (
                    c.node,
                    c.label,
                    c.seconds,
                    c.processor.unwrap(),
                    c.resident.unwrap(),
                )
            })
            .collect();
        assert_eq!(
            reported,
            [
                ("a".into(), None, 2.0, 3.0, 30),
                ("a".into(), Some("loop".into()), 1.0, 2.0, 30),
                ("b".into(), None, 2.0, 2.0, 30),
            ]
        );
    }
}
