//! A profile as a trace: "Trace Event Format", which Perfetto and Chrome's `about:tracing` show.

use super::spans::Span;
use serde_json::{Value, json};

/// Nodes and loops as slices, nodes with what they took of the processor and of memory. Times are microseconds.
pub(super) fn trace(spans: &[Span]) -> Value {
    let us = |t: f64| (t * 1e6).round();
    let event = |(span, lane): (&Span, usize)| {
        let name = span.label.as_ref().unwrap_or(&span.node);
        let memory = span.spent.memory.map(|bytes| bytes as f64 / 1e6);
        json!({
            "ph": "X", "pid": 1, "tid": lane, "name": name, "cat": span.node,
            "ts": us(span.from), "dur": us(span.to - span.from),
            "args": { "processor_s": span.spent.processor, "memory_mb": memory },
        })
    };
    let events: Vec<Value> = spans.iter().zip(lanes(spans)).map(event).collect();
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
    use super::*;
    use engine::Spent;

    #[test]
    fn nodes_that_run_at_once_are_side_by_side() {
        let span = |node: &str, label: Option<&str>, from: f64, to: f64| Span {
            node: node.into(),
            label: label.map(str::to_owned),
            from,
            to,
            spent: Spent {
                processor: label.is_none().then_some(3.0),
                memory: None,
            },
        };
        let spans = vec![
            span("a", None, 0.0, 2.0),
            span("b", None, 1.0, 3.0),
            span("a", Some("loop"), 1.5, 2.0),
            span("c", None, 2.0, 4.0),
        ];
        assert_eq!(lanes(&spans), [0, 1, 0, 0]);
        let reported = trace(&spans);
        let events = reported["traceEvents"].as_array().unwrap();
        assert_eq!((events.len(), &events[0]["dur"]), (4, &json!(2e6)));
        assert_eq!(events[0]["args"]["processor_s"], 3.0);
        assert_eq!(events[2]["args"]["processor_s"], Value::Null);
    }
}
