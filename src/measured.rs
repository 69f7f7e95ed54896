//! Which surface of a pipeline is the one that is measured.

use crate::graph::{Graph, Source};

/// The surface that is measured: what the last reader of a mesh among the girths reads, else the
/// last surface that is made.
pub fn measured(graph: &Graph) -> Option<usize> {
    let surface = |source: &Source| match source {
        Source::Node(j) if graph.nodes[*j].stage.yields() == "mesh" => Some(*j),
        _ => None,
    };
    let girths = graph
        .nodes
        .iter()
        .rev()
        .filter(|n| n.stage.yields() == "girths");
    let read = girths
        .flat_map(|n| n.from.iter().flatten())
        .find_map(surface);
    let last = || {
        (0..graph.nodes.len())
            .rev()
            .find(|i| graph.nodes[*i].stage.yields() == "mesh")
    };
    read.or_else(last)
}
