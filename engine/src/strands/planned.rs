//! Makes the plan of a run or a sweep: binds each point, puts their graphs together, cuts.

use super::cut::cut;
use super::file::{InputLine, Plan, PointLine, StrandLine};
use super::work::recipe;
use crate::graph::Graph;
use crate::recipe::{Mistakes, Overrides, Pipeline};
use crate::session::EngineError;
use crate::store::Store;
use crate::sweep::whole::{Member, Whole};
use std::path::PathBuf;

/// What a plan is asked to hold.
pub struct Asked<'a> {
    /// The pipeline.
    pub pipeline: &'a Pipeline,
    /// What each point changes, and the user's folders that it reads; a run is one point.
    pub points: &'a [(Overrides, Folders)],
    /// The nodes that are wanted; none is the pipeline's goal.
    pub nodes: &'a [String],
}

/// Inputs by name, and where each is.
pub type Folders = Vec<(String, PathBuf)>;

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum Unplanned {
    /// A point is wrong.
    #[error("{0}")]
    Wrong(Mistakes),
    /// Store or inputs.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

/// The plan of a run or a sweep. What is in the store does not matter.
///
/// # Errors
///
/// A point is wrong, or inputs cannot be read.
pub fn planned(asked: &Asked<'_>, program: &str, store: &Store) -> Result<Plan, Unplanned> {
    let mut whole = Whole::default();
    let mut members: Vec<Member> = Vec::new();
    for (overrides, folders) in asked.points {
        let graph = asked.pipeline.graph(overrides).map_err(Unplanned::Wrong)?;
        let wanted = wanted(&graph, asked.nodes);
        members.push(whole.add(graph, wanted, folders, store)?);
    }
    let texts = asked.pipeline.texts();
    let mut plan = Plan::new(program, texts, asked.nodes.to_vec());
    let (graph, files, _) = whole.graph();
    let Some(graph) = graph else {
        return Ok(plan);
    };
    let inputs = graph.inputs.iter().zip(&files);
    plan.inputs = inputs
        .map(|(i, files)| InputLine::of(&i.name, files))
        .collect();
    for ((overrides, _), member) in asked.points.iter().zip(&members) {
        plan.points.push(PointLine {
            variant: overrides.variant.clone(),
            sets: overrides.sets.clone(),
            inputs: member.inputs.clone(),
        });
    }
    // A goal is a wanted node of a point.
    let mut goals: Vec<(usize, Vec<usize>)> = Vec::new();
    for (point, member) in members.iter().enumerate() {
        for node in &member.wanted {
            let needed = crate::walk::all(&member.graph, &[*node]);
            let places = needed.iter().filter_map(|i| member.places[*i]);
            goals.push((point, places.collect()));
        }
    }
    let needed: Vec<Vec<usize>> = goals.iter().map(|(_, nodes)| nodes.clone()).collect();
    for strand in cut(&graph, &needed) {
        let point = goals[strand.goal].0;
        let member = &members[point];
        let own = |i: &usize| member.places[*i].is_some_and(|p| strand.nodes.contains(&p));
        let nodes: Vec<usize> = (0..member.places.len()).filter(own).collect();
        let name = |i: &usize| member.graph.nodes[*i].name.clone();
        plan.strands.push(StrandLine {
            layer: strand.layer,
            point,
            recipe: recipe(&member.graph, &nodes),
            nodes: nodes.iter().map(name).collect(),
            reads: strand.reads,
        });
    }
    Ok(plan)
}

/// The places of the wanted nodes; none named are the pipeline's goal.
pub fn wanted(graph: &Graph, nodes: &[String]) -> Vec<usize> {
    match nodes.is_empty() {
        true => graph.goal.clone(),
        false => nodes.iter().filter_map(|name| graph.node(name)).collect(),
    }
}
