//! A profile as a trace: "Trace Event Format", which Perfetto and Chrome's `about:tracing` show.

use super::cost::{busy, shares};
use super::profiler::Profile;
use super::spans::Span;
use serde_json::{Value, json};

/// Nodes and loops as slices, threads that were busy and memory as curves. Times are microseconds.
pub fn trace(profile: &Profile) -> Value {
    let us = |t: f64| (t * 1e6).round();
    let mut events: Vec<Value> = Vec::new();
    let lanes = lanes(&profile.spans);
    for (span, lane) in profile.spans.iter().zip(&lanes) {
        let name = span.label.as_ref().unwrap_or(&span.node);
        events.push(json!({
            "ph": "X", "pid": 1, "tid": lane, "name": name, "cat": span.node,
            "ts": us(span.from), "dur": us(span.to - span.from),
        }));
    }
    let mut curve = |t: f64, name: &str, value: f64| {
        let value = (value * 1000.0).round() / 1000.0;
        events.push(
            json!({ "ph": "C", "pid": 1, "name": name, "ts": us(t), "args": { "value": value } }),
        );
    };
    for ((from, _, threads), pair) in busy(&profile.samples)
        .iter()
        .zip(profile.samples.windows(2))
    {
        curve(*from, "threads busy", *threads);
        curve(*from, "memory [MB]", pair[0].resident as f64 / 1e6);
        let dt = (pair[1].t - pair[0].t).max(1e-9);
        for (id, seconds) in shares(&pair[0], &pair[1]) {
            if seconds > 0.0 || pair[0].threads.iter().any(|(known, _)| *known == id) {
                curve(*from, &format!("thread {id}"), seconds / dt);
            }
        }
    }
    json!({ "displayTimeUnit": "ms", "traceEvents": events })
}

/// A lane for each span: nodes that run at once are beside each other, loops with their node.
fn lanes(spans: &[Span]) -> Vec<usize> {
    let mut ends: Vec<f64> = Vec::new();
    let mut of: Vec<(&str, usize)> = Vec::new();
    let mut lane = |span: &Span| {
        let free = ends.iter().position(|end| *end <= span.from);
        let lane = free.unwrap_or(ends.len());
        match free {
            Some(lane) => ends[lane] = span.to,
            None => ends.push(span.to),
        }
        lane
    };
    let mut all = Vec::new();
    for span in spans {
        let known = of.iter().rfind(|(node, _)| *node == span.node);
        let at = match (&span.label, known) {
            (Some(_), Some((_, at))) => *at,
            _ => lane(span),
        };
        of.push((&span.node, at));
        all.push(at);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::sample::Sample;
    use super::*;

    #[test]
    fn nodes_that_run_at_once_are_side_by_side() {
        let span = |node: &str, label: Option<&str>, from: f64, to: f64| Span {
            node: node.into(),
            label: label.map(str::to_owned),
            from,
            to,
        };
        let spans = vec![
            span("a", None, 0.0, 2.0),
            span("b", None, 1.0, 3.0),
            span("a", Some("loop"), 1.5, 2.0),
            span("c", None, 2.0, 4.0),
        ];
        assert_eq!(lanes(&spans), [0, 1, 0, 0]);
        let sample = |t: f64| Sample {
            t,
            threads: vec![(7, t)],
            resident: 5_000_000,
        };
        let samples = vec![sample(0.0), sample(0.5)];
        let reported = trace(&Profile { spans, samples });
        let events = reported["traceEvents"].as_array().unwrap();
        let kind = |ph: &str| events.iter().filter(|e| e["ph"] == ph).count();
        assert_eq!((kind("X"), kind("C")), (4, 3));
        assert_eq!(events[0]["dur"], 2e6);
        let busy = events.iter().find(|e| e["name"] == "threads busy").unwrap();
        assert_eq!(busy["args"]["value"], 1.0);
    }
}
