//! What nodes and loops took: of the clock, of the processor, of memory.

use super::spans::Span;
use engine::Spent;

/// What a node or a loop took.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cost {
    /// The node.
    pub(crate) node: String,
    /// The loop in it; `None` for the node itself.
    pub(crate) label: Option<String>,
    /// By the clock; the sum where a loop ran several times. \[s\]
    pub(crate) seconds: f64,
    /// What the node took; of a loop nothing is known.
    pub(crate) spent: Spent,
}

/// In the order in which they began; a loop that ran several times is one.
pub(super) fn costs(spans: &[Span]) -> Vec<Cost> {
    let mut all: Vec<Cost> = Vec::new();
    for span in spans {
        let same = |c: &&mut Cost| c.node == span.node && c.label == span.label;
        match all.iter_mut().find(same) {
            Some(cost) => cost.seconds += span.to - span.from,
            None => all.push(Cost {
                node: span.node.clone(),
                label: span.label.clone(),
                seconds: span.to - span.from,
                spent: span.spent,
            }),
        }
    }
    all
}
