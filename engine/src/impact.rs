//! What a param reaches: the node that has it, and all that read what it makes.

use crate::graph::{Graph, Source};
use stage::Value;

/// A param of a pipeline.
#[derive(Debug, Clone)]
pub struct Impact {
    /// The node that has it.
    pub node: usize,
    /// Its name, with the unit.
    pub param: &'static str,
    /// What it is now.
    pub value: Value,
    /// What it is by default.
    pub default: Value,
    /// Every node that another value may change, its own first, in the order of the walk.
    pub reaches: Vec<usize>,
}

/// The node and all that depend on it, among those that the wanted ones need.
pub fn reached(graph: &Graph, wanted: &[usize], node: usize) -> Vec<usize> {
    let needed = crate::done::needed(graph, wanted);
    let mut hit = vec![false; graph.nodes.len()];
    // Each node comes after what it reads.
    for (i, bound) in graph.nodes.iter().enumerate() {
        let reads = |source: &Source| matches!(source, Source::Node(j) if hit[*j]);
        hit[i] = i == node || bound.from.iter().flatten().any(reads);
    }
    (0..graph.nodes.len())
        .filter(|i| hit[*i] && needed[*i])
        .collect()
}

/// Every param of every node that the wanted ones need.
pub fn impacts(graph: &Graph, wanted: &[usize]) -> Vec<Impact> {
    let mut all = Vec::new();
    for (node, bound) in graph.nodes.iter().enumerate() {
        let reaches = reached(graph, wanted, node);
        if !reaches.contains(&node) {
            continue;
        }
        // A program's params have no defaults but what the node gives.
        let of_program = bound
            .params
            .values
            .iter()
            .filter(|_| bound.program.is_some());
        all.extend(of_program.map(|(param, value)| Impact {
            node,
            param,
            value: value.clone(),
            default: value.clone(),
            reaches: reaches.clone(),
        }));
        for (spec, (_, value)) in bound.stage.params().iter().zip(&bound.params.values) {
            all.push(Impact {
                node,
                param: spec.name,
                value: value.clone(),
                default: spec.default.clone(),
                reaches: reaches.clone(),
            });
        }
    }
    all
}
