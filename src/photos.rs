//! The photos of a run.

use crate::engine::Outcome;
use crate::graph::Graph;
use shape::Photos;
use stage::Artifact;
use std::sync::Arc;

/// The node whose result they are.
pub(crate) fn photos_node(graph: &Graph) -> Option<usize> {
    let mut nodes = graph.nodes.iter();
    nodes.position(|n| n.stage.yields() == Photos::KIND)
}

/// They themselves; none where there are none.
pub(crate) fn photos(graph: &Graph, outcome: &Outcome) -> Arc<Photos> {
    let node = photos_node(graph);
    let photos = node.and_then(|at| outcome.artifact(graph, at));
    let photos = photos.and_then(|artifact| artifact.downcast::<Photos>());
    photos.unwrap_or_default()
}
