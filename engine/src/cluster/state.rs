//! Which strands of a plan are done, by what is in the store; nobody else is asked.

use crate::graph::{Graph, Source};
use crate::key;
use crate::recipe::{Overrides, Pipeline};
use crate::store::Store;
use crate::strands::{Plan, WorkError};
use stage::Hash;
use std::collections::HashMap;

/// What is known of every strand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strands {
    /// Whether all results of each are there.
    pub done: Vec<bool>,
}

impl Strands {
    /// How many are done of some.
    pub fn done_in(&self, strands: std::ops::Range<usize>) -> usize {
        self.done[strands].iter().filter(|done| **done).count()
    }
}

/// Looks every strand up: keys from the plan's inputs and from what was made of them.
///
/// # Errors
///
/// The pipeline means nothing to this program.
pub fn state(plan: &Plan, pipeline: &Pipeline, store: &Store) -> Result<Strands, WorkError> {
    let mut known: HashMap<Hash, Option<Hash>> = HashMap::new();
    let mut done = vec![false; plan.strands.len()];
    let mut of_point: Vec<Vec<usize>> = vec![vec![]; plan.points.len()];
    for (at, strand) in plan.strands.iter().enumerate() {
        of_point[strand.point].push(at);
    }
    let inputs: Vec<Hash> = plan
        .inputs
        .iter()
        .map(|i| stage::content(&i.files()))
        .collect();
    for (point, strands) in plan.points.iter().zip(&of_point) {
        if strands.is_empty() {
            continue;
        }
        let overrides = Overrides {
            variant: point.variant.clone(),
            sets: point.sets.clone(),
        };
        let graph = pipeline.graph(&overrides).map_err(WorkError::Wrong)?;
        crate::foreign::settle(&graph, &all(&graph), store, &|| false);
        let input = |name: &str| {
            let found = point.inputs.iter().find(|i| plan.inputs[**i].name == name);
            found.map(|i| inputs[*i])
        };
        let inputs: Vec<Option<Hash>> = graph.inputs.iter().map(|i| input(&i.name)).collect();
        let contents = contents(&graph, &inputs, store, &mut known);
        for at in strands {
            let there = |name: &String| graph.node(name).is_some_and(|i| contents[i].is_some());
            done[*at] = plan.strands[*at].nodes.iter().all(there);
        }
    }
    Ok(Strands { done })
}

fn all(graph: &Graph) -> Vec<usize> {
    (0..graph.nodes.len()).collect()
}

/// The content of each node that was made.
fn contents(
    graph: &Graph,
    inputs: &[Option<Hash>],
    store: &Store,
    known: &mut HashMap<Hash, Option<Hash>>,
) -> Vec<Option<Hash>> {
    let mut contents: Vec<Option<Hash>> = Vec::with_capacity(graph.nodes.len());
    for node in &graph.nodes {
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(j)) => inputs[*j].map(Some),
            Some(Source::Node(j)) => contents[*j].map(Some),
        };
        let from: Option<Vec<Option<Hash>>> = node.from.iter().map(content).collect();
        let found = from.and_then(|from| {
            let key = key::key(node, &from);
            let look = || store.found(key).map(|found| found.record.content);
            *known.entry(key).or_insert_with(look)
        });
        contents.push(found);
    }
    contents
}
