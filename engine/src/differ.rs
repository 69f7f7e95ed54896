//! Where two runs part ways: which settings differ, and the first result that differs.

use crate::provenance::PackedProvenance;
use serde::Deserialize;
use stage::Message;
use std::collections::HashMap;

/// A node of a run, as `run.json` has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct NodeRun {
    /// Its name in the pipeline.
    pub node: String,
    /// Its stage.
    pub stage: String,
    /// What became of it: found, made, failed, skipped, cancelled.
    #[serde(alias = "fate")]
    pub status: String,
    /// The content of its result.
    pub content: Option<String>,
    /// What its result depends on, line by line.
    #[serde(default, alias = "story")]
    pub provenance: PackedProvenance,
    /// How long it took: now, or when it was made. \[s\]
    pub seconds: f64,
    /// Size of its result. \[bytes\]
    pub bytes: u64,
    /// What the user should know.
    #[serde(default)]
    pub warnings: Vec<Message>,
}

/// All nodes by their names.
pub fn by_name(nodes: &[NodeRun]) -> HashMap<&str, &NodeRun> {
    nodes.iter().map(|n| (n.node.as_str(), n)).collect()
}

/// A param or an input of a node that differs.
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

/// What is different about a run, compared with the first.
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
    /// Nodes that have other params or inputs, and yet made the same bytes.
    pub met_again: Vec<String>,
}

/// What is different about `b`.
pub fn differ(a: &[NodeRun], b: &[NodeRun]) -> Difference {
    let mut d = Difference::default();
    let (of_a, of_b) = (by_name(a), by_name(b));
    for node in a {
        let Some(other) = of_b.get(node.node.as_str()) else {
            d.gone.push(node.node.clone());
            continue;
        };
        d.changes.extend(changes(node, other));
        if node.content != other.content {
            d.diverged.push(node.node.clone());
        } else if node.provenance != other.provenance {
            d.met_again.push(node.node.clone());
        }
    }
    let only_b = b.iter().filter(|n| !of_a.contains_key(n.node.as_str()));
    d.new = only_b.map(|n| n.node.clone()).collect();
    d.first = d.diverged.first().cloned();
    d
}

/// Lines of the provenance that differ, without the contents of ports: those follow from other nodes.
fn changes(a: &NodeRun, b: &NodeRun) -> Vec<Change> {
    // Whether a port is wired is compared; what flows through it is not.
    fn line<'a>((what, value): (&'a str, &'a str)) -> (&'a str, &'a str) {
        match what.starts_with("from ") && value != "nothing" {
            true => (what, "something"),
            false => (what, value),
        }
    }
    let [old, new] = [a, b].map(|node| node.provenance.lines().map(line).collect::<Vec<_>>());
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
