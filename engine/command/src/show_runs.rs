//! Which runs `show` may take a result from, and what was otherwise in one.

use super::arguments::Change;
use super::fault::Fault;
use super::open::read_pipeline;
use super::program::GlobalArgs;
use engine::graph::{Bound, Graph, Source};
use engine::key::{self, Provenance};
use engine::walk;
use serde_json::{Value, json};
use stage::Hash;
use std::path::Path;

/// Lines of a node's recipe that a command line asks for.
pub(crate) type Asked = Vec<(String, String)>;

/// A node's entry in a run's record.
pub(crate) fn entry<'a>(run: &'a Value, node: &str) -> Option<&'a Value> {
    run["nodes"].as_array()?.iter().find(|n| n["node"] == node)
}

/// What a node does, as the lines that its key is made of.
fn recipe(node: &Bound) -> Vec<(String, String)> {
    let mut provenance = Provenance::default();
    key::describe_recipe(node, &mut provenance);
    provenance.0
}

/// What a node did in a run, with what it read.
fn did(run: &Value, node: &str) -> Vec<(String, String)> {
    let lines = entry(run, node).map(|n| n["provenance"].clone());
    serde_json::from_value(lines.unwrap_or_default()).unwrap_or_default()
}

/// What the command line changes of each node: the params that it names, and what differs without it.
pub(crate) fn asked(
    file: Option<&Path>,
    change: &Change,
    graph: &Graph,
    global: &GlobalArgs,
) -> Result<Vec<Asked>, Fault> {
    if !change.changes() {
        return Ok(vec![vec![]; graph.nodes.len()]);
    }
    let plain = read_pipeline(file, &Change::default(), global)?;
    let of = |node: &Bound| {
        let without = plain.node(&node.name).map(|at| recipe(&plain.nodes[at]));
        let without = without.unwrap_or_default();
        let named = |what: &str| {
            let param = what.strip_prefix("with ").unwrap_or_default();
            let name = format!("{}.{param}=", node.name);
            change.set.iter().any(|set| set.starts_with(&name))
        };
        let lines = recipe(node).into_iter();
        lines
            .filter(|line| named(&line.0) || !without.contains(line))
            .collect()
    };
    Ok(graph.nodes.iter().map(of).collect())
}

/// Whether a run did what is asked of the node and of all that it needs.
pub(crate) fn fits(run: &Value, graph: &Graph, node: usize, asked: &[Asked]) -> bool {
    let needed = walk::all(graph, &[node]).into_iter();
    let mut changed = needed.filter(|i| !asked[*i].is_empty());
    changed.all(|i| {
        let did = did(run, &graph.nodes[i].name);
        asked[i].iter().all(|line| did.contains(line))
    })
}

/// Whether a run read these contents of the inputs that the node needs; `None` is any.
pub(crate) fn reads(run: &Value, graph: &Graph, node: usize, contents: &[Option<Hash>]) -> bool {
    let same = |node: &Bound| {
        let mut ports = node.ports.iter().zip(&node.from);
        ports.all(|(port, source)| {
            let Some(Source::Input(input)) = source else {
                return true;
            };
            let same = |hash: Hash| {
                let line = json!([format!("from {}", port.name), hash.to_hex().as_str()]);
                let provenance = entry(run, &node.name).and_then(|n| n["provenance"].as_array());
                provenance.is_some_and(|provenance| provenance.contains(&line))
            };
            contents[*input].is_none_or(same)
        })
    };
    let needed = walk::all(graph, &[node]);
    needed.into_iter().all(|i| same(&graph.nodes[i]))
}

/// What the node, or the first one that it needs, did otherwise in a run than it would now; params count if there is a
/// pipeline's `file`, since a program's own verbs change those of its own pipeline.
pub(crate) fn otherwise(
    run: &Value,
    graph: &Graph,
    node: usize,
    file: Option<&Path>,
) -> Option<String> {
    let of = |node: &Bound| {
        let did = did(run, &node.name);
        let counts = |what: &str| file.is_some() || !what.starts_with("with ");
        let mut lines = recipe(node).into_iter();
        let (what, now) = lines.find(|line| counts(&line.0) && !did.contains(line))?;
        let then = &did.iter().find(|line| line.0 == what)?.1;
        let what = match what.strip_prefix("with ") {
            Some(param) => format!("{}.{param}", node.name),
            None => format!("the {what} of `{}`", node.name),
        };
        Some(format!("{what} was {then} and would be {now}"))
    };
    let needed = walk::all(graph, &[node]);
    needed.into_iter().find_map(|i| of(&graph.nodes[i]))
}
