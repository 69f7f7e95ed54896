//! Works on one strand: keys from actual inputs, hit → next, miss → make.

use super::file::Plan;
use crate::graph::{Graph, Source};
use crate::key::{self, Digest, Ledger};
use crate::outcome::Outcome;
use crate::recipe::{Mistakes, Overrides, Pipeline};
use crate::session::{self, EngineError, Options};
use crate::store::Store;
use crate::walk::Watch;
use programs::Catalog;
use stage::{Files, Hash};
use std::sync::atomic::AtomicBool;

/// Why a strand could not be worked on.
#[derive(Debug, thiserror::Error)]
pub enum WorkError {
    /// There is none.
    #[error("strand {0} is not in the plan, which has {1}")]
    Unknown(usize, usize),
    /// Its pipeline means nothing to this program.
    #[error("{0}")]
    Wrong(Mistakes),
    /// It would make something else than was planned.
    #[error(
        "strand {0} would make something else than was planned: this program, a script or a file of a pipeline is another than where the plan was made ({1}); use the same on all machines, or plan anew"
    )]
    Other(usize, String),
    /// What it reads was not made.
    #[error("strand {strand} reads `{node}`, which strand {from} has not made yet")]
    Early {
        /// The strand.
        strand: usize,
        /// What is missing.
        node: String,
        /// Who makes it.
        from: usize,
    },
    /// Store or inputs.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

/// A strand's graph and what came of it.
pub struct Worked {
    /// The graph of its point.
    pub graph: Graph,
    /// The strand's nodes.
    pub nodes: Vec<usize>,
    /// What came of them.
    pub outcome: Outcome,
}

/// What the nodes do, as a hash: stages, formats, params, scripts; not what their inputs are, nor what
/// is asked of the machine that runs them.
pub(super) fn recipe(graph: &Graph, nodes: &[usize]) -> String {
    struct Steady(Digest);
    impl Ledger for Steady {
        fn line(&mut self, what: &str, value: &str) {
            if what != "identity" && !what.starts_with("program ") {
                self.0.line(what, value);
            }
        }
    }
    let mut steady = Steady(Digest::default());
    for node in nodes {
        steady.line("node", &graph.nodes[*node].name);
        key::describe_recipe(&graph.nodes[*node], &mut steady);
    }
    steady.0.finish().to_hex().to_string()
}

/// The graph of a strand.
///
/// # Errors
///
/// There is no such strand, or it would make something else than was planned.
pub fn graph(plan: &Plan, strand: usize, pipeline: &Pipeline) -> Result<Graph, WorkError> {
    bound(plan, strand, pipeline).map(|(graph, ..)| graph)
}

/// The graph of a strand with the files of its inputs, and its nodes.
///
/// # Errors
///
/// There is no such strand, or it would make something else than was planned.
pub(super) fn bound(
    plan: &Plan,
    strand: usize,
    pipeline: &Pipeline,
) -> Result<(Graph, Vec<Files>, Vec<usize>), WorkError> {
    let unknown = WorkError::Unknown(strand, plan.strands.len());
    let line = plan.strands.get(strand).ok_or(unknown)?;
    let point = &plan.points[line.point];
    let overrides = Overrides {
        variant: point.variant.clone(),
        sets: point.sets.clone(),
    };
    let graph = pipeline.graph(&overrides).map_err(WorkError::Wrong)?;
    let other = || WorkError::Other(strand, plan.program.clone());
    let inputs: Vec<_> = point.inputs.iter().map(|i| &plan.inputs[*i]).collect();
    let files = graph.inputs.iter().map(|input| {
        let found = inputs.iter().find(|i| i.name == input.name);
        found.map(|line| line.files())
    });
    let files: Option<Vec<Files>> = files.collect();
    let nodes = line.nodes.iter().map(|name| graph.node(name));
    let nodes: Option<Vec<usize>> = nodes.collect();
    let (files, nodes) = (files.ok_or_else(other)?, nodes.ok_or_else(other)?);
    match recipe(&graph, &nodes) == line.recipe {
        true => Ok((graph, files, nodes)),
        false => Err(other()),
    }
}

/// The pipeline of a plan.
///
/// # Errors
///
/// Its text means nothing to this program.
pub fn pipeline(plan: &Plan, catalog: &'static Catalog) -> Result<Pipeline, WorkError> {
    Pipeline::of_texts(plan.texts.clone(), catalog).map_err(WorkError::Wrong)
}

/// Works on a strand of a plan: what is there is found, what is missing is made. What other strands make
/// is not made here; only a result that went away after it was made is made again.
///
/// # Errors
///
/// There is no such strand, it would make something else, what it reads was not made, or store and
/// inputs cannot be used. A node that fails is in the outcome.
pub fn work(
    plan: &Plan,
    strand: usize,
    pipeline: &Pipeline,
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Worked, WorkError> {
    let store = Store::open(&options.cache).map_err(EngineError::from)?;
    work_in(store, (plan, strand, pipeline), options, watch, cancel)
}

/// As [`work`], in a store that is open already.
///
/// # Errors
///
/// As [`work`].
pub(crate) fn work_in(
    store: Store,
    (plan, strand, pipeline): (&Plan, usize, &Pipeline),
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Worked, WorkError> {
    let (graph, files, nodes) = bound(plan, strand, pipeline)?;
    let stop = || cancel.load(std::sync::atomic::Ordering::Relaxed);
    let all = crate::walk::all(&graph, &nodes);
    session::settled(&graph, &all, &store, &stop)?;
    if let Some(node) = missing(&graph, &files, &nodes, &store) {
        let node = graph.nodes[node].name.clone();
        let makes = |s: &&usize| plan.strands[**s].nodes.contains(&node);
        let reads = &plan.strands[strand].reads;
        let from = reads.iter().find(makes).or(reads.first());
        let from = from.copied().unwrap_or(strand);
        return Err(WorkError::Early { strand, node, from });
    }
    let outcome = session::run_files(store, &graph, files, &nodes, options, watch, cancel)?;
    Ok(Worked {
        graph,
        nodes,
        outcome,
    })
}

/// The first node below the strand's own of which nothing is known.
fn missing(graph: &Graph, files: &[Files], own: &[usize], store: &Store) -> Option<usize> {
    let inputs: Vec<Hash> = files.iter().map(stage::content).collect();
    let mut contents: Vec<Option<Hash>> = vec![None; graph.nodes.len()];
    for i in crate::walk::all(graph, own) {
        if own.contains(&i) {
            continue;
        }
        let node = &graph.nodes[i];
        let content = |source: &Option<Source>| match source {
            None => None,
            Some(Source::Input(j)) => Some(inputs[*j]),
            Some(Source::Node(j)) => contents[*j],
        };
        let from: Vec<Option<Hash>> = node.from.iter().map(content).collect();
        match store.found(key::key(node, &from)) {
            Some(found) => contents[i] = Some(found.record.content),
            None => return Some(i),
        }
    }
    None
}
