//! A result that is to be written.

use super::fault::Fault;
use engine::Outcome;
use engine::graph::Graph;
use engine::out;
use stage::{AnyArtifact, message};

stage::messages! {
    GONE = "cli-result-gone": "the result of `{node}` went out of the cache before it was written; run the same command again";
}

/// A result that must be there, for somebody wants to write it; and the bytes of its own file
/// where that is what is written.
///
/// # Errors
///
/// It went out of the cache meanwhile.
pub fn there(
    graph: &Graph,
    outcome: &Outcome,
    node: usize,
) -> Result<(AnyArtifact, Vec<u8>), Fault> {
    let found = outcome.artifact(graph, node).and_then(|artifact| {
        let raw = match out::formats(graph.catalog, artifact.kind()) {
            [out::RAW] => outcome.bytes(node)?,
            _ => vec![],
        };
        Some((artifact, raw))
    });
    found.ok_or_else(|| {
        let name = &graph.nodes[node].name;
        Fault::coded(&message!(GONE, node = name)).of_stage()
    })
}
