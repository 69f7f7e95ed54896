//! When nodes and the loops in them began and ended.

use engine::Spent;

/// A node, or a loop in it, from begin to end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Span {
    /// The node.
    pub(crate) node: String,
    /// The loop in it; `None` for the node itself.
    pub(crate) label: Option<String>,
    /// Since the run began. \[s\]
    pub(crate) from: f64,
    /// Since the run began. \[s\]
    pub(crate) to: f64,
    /// What the node took; of a loop nothing is known.
    pub(crate) spent: Spent,
}

/// Those that are over, and those that are not.
#[derive(Debug, Default)]
pub(crate) struct Spans {
    spans: Vec<Span>,
    open: Vec<usize>,
}

impl Spans {
    pub(crate) fn begin(&mut self, node: &str, label: Option<&str>, now: f64) {
        self.open.push(self.spans.len());
        self.spans.push(Span {
            node: node.to_owned(),
            label: label.map(str::to_owned),
            from: now,
            to: now,
            spent: Spent::default(),
        });
    }

    /// A loop begins with nothing done and ends with all of it.
    pub(crate) fn progress(
        &mut self,
        node: &str,
        label: &str,
        (done, of): (usize, usize),
        now: f64,
    ) {
        if done == 0 {
            self.begin(node, Some(label), now);
        }
        if done >= of {
            let last = self.open.iter().rposition(|i| {
                let span = &self.spans[*i];
                span.node == node && span.label.as_deref() == Some(label)
            });
            if let Some(at) = last {
                let over = self.open.remove(at);
                self.spans[over].to = now;
            }
        }
    }

    /// A node is over, which took so much, and what is left of its loops.
    pub(crate) fn end(&mut self, node: &str, spent: Spent, now: f64) {
        let spans = &mut self.spans;
        self.open.retain(|i| {
            let ends = spans[*i].node == node;
            if ends {
                spans[*i].to = now;
                if spans[*i].label.is_none() {
                    spans[*i].spent = spent;
                }
            }
            !ends
        });
    }

    /// All of them, once the run is over.
    pub(crate) fn ended(mut self, now: f64) -> Vec<Span> {
        for i in std::mem::take(&mut self.open) {
            self.spans[i].to = now;
        }
        self.spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_end_with_their_last_step_or_with_their_node() {
        let mut spans = Spans::default();
        spans.begin("a", None, 1.0);
        spans.progress("a", "photos", (0, 2), 1.5);
        spans.progress("a", "photos", (1, 2), 2.0);
        spans.progress("a", "photos", (2, 2), 2.5);
        // Nothing to do is over at once.
        spans.progress("a", "none", (0, 0), 2.75);
        spans.progress("a", "rounds", (0, 9), 3.0);
        spans.begin("b", None, 3.5);
        spans.end("a", Spent::default(), 4.0);
        let all = spans.ended(5.0);
        let reported: Vec<_> = all
            .iter()
            .map(|s| (s.node.as_str(), s.label.as_deref(), s.from, s.to))
            .collect();
        assert_eq!(
            reported,
            [
                ("a", None, 1.0, 4.0),
                ("a", Some("photos"), 1.5, 2.5),
                ("a", Some("none"), 2.75, 2.75),
                ("a", Some("rounds"), 3.0, 4.0),
                ("b", None, 3.5, 5.0),
            ]
        );
    }
}
