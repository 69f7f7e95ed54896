//! Which strands of a plan are done, by what is in the store; nobody else is asked.

use engine::graph::{Graph, Source};
use engine::key;
use engine::recipe::{Overrides, Pipeline};
use engine::store::Store;
use engine::strands::{InputLine, Plan, WorkError, wanted};
use stage::Hash;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

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

/// Points that are looked up side by side.
const AT_A_TIME: usize = 256;

/// A listing has so many records in one answer: it is worth it while it takes no more requests
/// than there are strands.
const A_REQUEST: usize = 1000;

/// Looks every strand up: keys from the plan's inputs and from what was made of them. Of a store that
/// machines share it is asked once what is there, and then only for what other strands read.
///
/// # Errors
///
/// The pipeline means nothing to this program.
pub fn state(plan: &Plan, pipeline: &Pipeline, store: &Store) -> Result<Strands, WorkError> {
    let mut of_point: Vec<Vec<usize>> = vec![vec![]; plan.points.len()];
    for (at, strand) in plan.strands.iter().enumerate() {
        of_point[strand.point].push(at);
    }
    let contents = |i: &InputLine| stage::content(&i.files());
    let inputs: Vec<Hash> = plan.inputs.iter().map(contents).collect();
    let mut done = vec![false; plan.strands.len()];
    let mut seen = Seen {
        store,
        listed: store.listed(A_REQUEST * plan.strands.len()),
        known: HashMap::new(),
    };
    let asked: Vec<usize> = (0..plan.points.len())
        .filter(|at| !of_point[*at].is_empty())
        .collect();
    for points in asked.chunks(AT_A_TIME) {
        let looks = points
            .iter()
            .map(|at| look(plan, *at, &inputs, pipeline, store));
        let mut looks: Vec<Look> = looks.collect::<Result<_, _>>()?;
        let most = looks.iter().map(|look| look.graph.nodes.len()).max();
        (0..most.unwrap_or(0)).for_each(|node| seen.node(&mut looks, node));
        for (look, point) in looks.iter().zip(points) {
            for at in &of_point[*point] {
                let there = |name: &String| look.graph.node(name).is_some_and(|i| look.there[i]);
                done[*at] = plan.strands[*at].nodes.iter().all(there);
            }
        }
    }
    Ok(Strands { done })
}

/// A point that is looked up, node by node.
struct Look {
    graph: Graph,
    inputs: Vec<Option<Hash>>,
    /// Whether the plan makes it.
    needed: Vec<bool>,
    /// Whether another of those reads it: then its content must be known.
    read: Vec<bool>,
    there: Vec<bool>,
    contents: Vec<Option<Hash>>,
}

/// The graph of a point, of which nothing is known yet.
fn look(
    plan: &Plan,
    at: usize,
    contents: &[Hash],
    pipeline: &Pipeline,
    store: &Store,
) -> Result<Look, WorkError> {
    let point = &plan.points[at];
    let overrides = Overrides {
        variant: point.variant.clone(),
        sets: point.sets.clone(),
    };
    let graph = pipeline.graph(&overrides).map_err(WorkError::Wrong)?;
    let n = graph.nodes.len();
    let all = engine::walk::all(&graph, &wanted(&graph, &plan.wanted));
    engine::permission::settle(&graph, &all, store, &|| false);
    let input = |name: &str| {
        let found = point.inputs.iter().find(|i| plan.inputs[**i].name == name);
        found.map(|i| contents[*i])
    };
    let inputs = graph.inputs.iter().map(|i| input(&i.name)).collect();
    let (mut needed, mut read) = (vec![false; n], vec![false; n]);
    for i in all {
        needed[i] = true;
        engine::walk::sources(&graph, i).for_each(|j| read[j] = true);
    }
    Ok(Look {
        graph,
        inputs,
        needed,
        read,
        there: vec![false; n],
        contents: vec![None; n],
    })
}

impl Look {
    /// The key of a node, if all that it reads was made.
    fn key(&self, node: usize) -> Option<Hash> {
        let node = self.graph.nodes.get(node).filter(|_| self.needed[node])?;
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(j)) => self.inputs[*j].map(Some),
            Some(Source::Node(j)) => self.contents[*j].map(Some),
        };
        let from: Option<Vec<Option<Hash>>> = node.from.iter().map(content).collect();
        Some(key::key(node, &from?))
    }
}

/// What was seen of the store.
struct Seen<'a> {
    store: &'a Store,
    /// The records of the shared store.
    listed: Option<Arc<HashSet<[u8; 32]>>>,
    /// The content of each key that was asked for.
    known: HashMap<Hash, Option<Hash>>,
}

impl Seen<'_> {
    /// Looks one node of all points up, side by side.
    fn node(&mut self, looks: &mut [Look], node: usize) {
        let keys: Vec<Option<Hash>> = looks.iter().map(|look| look.key(node)).collect();
        let (mut fresh, mut once) = (Vec::new(), HashSet::new());
        for (look, key) in looks.iter().zip(&keys) {
            let Some(key) = key else { continue };
            let asked = look.read[node] || self.listed.is_none();
            if asked && !self.known.contains_key(key) && once.insert(*key) {
                fresh.push(*key);
            }
        }
        self.store.bring_all(&fresh);
        for key in fresh {
            let found = self.store.found(key);
            self.known.insert(key, found.map(|f| f.record.content));
        }
        for (look, key) in looks.iter_mut().zip(keys) {
            let Some(key) = key else { continue };
            let content = self.known.get(&key).copied().flatten();
            look.contents[node] = content;
            look.there[node] = content.is_some() || self.is_there(key);
        }
    }

    /// Whether the record of a key is here, or listed there.
    fn is_there(&self, key: Hash) -> bool {
        let listed = self.listed.as_ref();
        listed
            .is_some_and(|all| all.contains(key.as_bytes()) || self.store.found_here(key).is_some())
    }
}
