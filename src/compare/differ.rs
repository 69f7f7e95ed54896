//! Where two runs part ways: what was said otherwise, and the first result that came out otherwise.

use super::side::{NodeRun, Side};

/// Something that a node was told otherwise.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The node.
    pub node: String,
    /// What: `voxel_mm`, `stage`, ….
    pub what: String,
    /// In the first run.
    pub old: String,
    /// In the other.
    pub new: String,
}

/// What is different about a run, held against the first.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Difference {
    /// Stages and params, in the order of the walk.
    pub changes: Vec<Change>,
    /// Nodes that only the first has.
    pub gone: Vec<String>,
    /// Nodes that only the other has.
    pub new: Vec<String>,
    /// The first node, in the order of the walk, whose result is another.
    pub first: Option<String>,
    /// All nodes whose result is another.
    pub diverged: Vec<String>,
    /// Nodes that read or were told something else, and yet made the same bytes.
    pub met_again: Vec<String>,
}

/// What is different about `b`.
pub fn differ(a: &Side, b: &Side) -> Difference {
    let mut d = Difference::default();
    let (of_a, of_b) = (a.by_name(), b.by_name());
    for node in &a.nodes {
        let Some(other) = of_b.get(node.node.as_str()) else {
            d.gone.push(node.node.clone());
            continue;
        };
        d.changes.extend(changes(node, other));
        if node.content != other.content {
            d.diverged.push(node.node.clone());
        } else if node.story != other.story {
            d.met_again.push(node.node.clone());
        }
    }
    let only_b = b
        .nodes
        .iter()
        .filter(|n| !of_a.contains_key(n.node.as_str()));
    d.new = only_b.map(|n| n.node.clone()).collect();
    d.first = d.diverged.first().cloned();
    d
}

/// Lines of the story that differ, without the contents of ports: those follow from others.
fn changes(a: &NodeRun, b: &NodeRun) -> Vec<Change> {
    // Whether a port is wired is said; what flows through it is not.
    fn line<'a>((what, value): (&'a str, &'a str)) -> (&'a str, &'a str) {
        match what.starts_with("from ") && value != "nothing" {
            true => (what, "something"),
            false => (what, value),
        }
    }
    let [old, new] = [a, b].map(|node| node.story.lines().map(line).collect::<Vec<_>>());
    let find = |lines: &[(&str, &str)], what: &str| {
        let line = lines.iter().find(|(w, _)| *w == what);
        line.map_or("nothing", |(_, v)| v).to_owned()
    };
    let names = old
        .iter()
        .chain(new.iter().filter(|(w, _)| !old.iter().any(|(x, _)| x == w)));
    names
        .map(|(what, _)| Change {
            node: a.node.clone(),
            what: what.strip_prefix("with ").unwrap_or(what).to_owned(),
            old: find(&old, what),
            new: find(&new, what),
        })
        .filter(|c| c.old != c.new)
        .collect()
}
