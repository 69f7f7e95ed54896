//! A pipeline that can run: its nodes, its plan, its run.

use crate::asked::{Folders, global};
use crate::fault::{guarded, wrong};
use crate::outcome::{self, Run};
use command::{Change, Fault, GlobalArgs};
use engine::graph::Source;
use engine::plan::{self, State};
use pyo3::prelude::*;
use serde_json::{Value, json};
use stage::AnyStage;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

/// A pipeline bound to stages, with all that was set.
#[pyclass(frozen, module = "tailor._native")]
pub(crate) struct Graph {
    pub(crate) graph: Arc<engine::graph::Graph>,
    pub(crate) global: GlobalArgs,
}

#[pymethods]
impl Graph {
    /// Opens a pipeline: a file, or the name of a built-in one.
    #[new]
    fn new(
        py: Python<'_>,
        pipeline: PathBuf,
        variant: Option<String>,
        sets: Vec<String>,
        cache: PathBuf,
        threads: Option<usize>,
        allow_exec: bool,
    ) -> PyResult<Graph> {
        guarded(py, || {
            let mut global = global(cache, threads)?;
            global.allow_exec = allow_exec;
            let change = Change {
                input: vec![],
                variant,
                set: sets,
            };
            let graph = command::open_pipeline(Some(&pipeline), &change, &global)?;
            let graph = Arc::new(graph);
            Ok(Graph { graph, global })
        })
    }

    /// Nodes, inputs and goal as JSON.
    fn about(&self) -> String {
        let graph = &self.graph;
        let name = |source: &Source| match source {
            Source::Node(i) => graph.nodes[*i].name.clone(),
            Source::Input(i) => format!("@{}", graph.inputs[*i].name),
        };
        let node = |node: &engine::graph::Bound| {
            let ports = node.ports.iter().zip(&node.from);
            let from =
                ports.filter_map(|(p, s)| Some((p.name.to_owned(), name(s.as_ref()?).into())));
            let params = node.params.values.iter();
            let params = params.map(|(name, value)| ((*name).to_owned(), value.to_string().into()));
            json!({
                "node": node.name, "stage": node.stage.name(), "kind": node.stage.yields(),
                "from": from.collect::<serde_json::Map<String, Value>>(),
                "params": params.collect::<serde_json::Map<String, Value>>(),
            })
        };
        let input = |input: &engine::graph::InputDecl| json!({ "name": input.name, "about": input.about, "files": input.files });
        let goal: Vec<&str> = graph
            .goal
            .iter()
            .map(|i| graph.nodes[*i].name.as_str())
            .collect();
        json!({
            "about": graph.about, "goal": goal,
            "nodes": graph.nodes.iter().map(node).collect::<Vec<_>>(),
            "inputs": graph.inputs.iter().map(input).collect::<Vec<_>>(),
        })
        .to_string()
    }

    /// What a run would do, as JSON: a row a node.
    fn plan(&self, py: Python<'_>, folders: Folders, nodes: Vec<String>) -> PyResult<String> {
        guarded(py, || {
            let graph = &*self.graph;
            let wanted = wanted(graph, &nodes)?;
            let store = engine::store::Store::open(&self.global.cache).map_err(Fault::input)?;
            let files = engine::inputs(graph, &folders, &store).map_err(Fault::input)?;
            let planned = plan::plan(graph, &files, &wanted, &store);
            let row = |(node, planned): (&engine::graph::Bound, &Option<plan::Planned>)| {
                let planned = planned.as_ref()?;
                let (state, why) = match &planned.state {
                    State::Cached => ("cached", vec![]),
                    State::May => ("may run", vec![]),
                    State::Stale(changes) => ("will run", changes.clone()),
                };
                let why: Vec<String> = why
                    .iter()
                    .map(|(what, old, new)| format!("{what}: {old} → {new}"))
                    .collect();
                Some(json!({
                    "node": node.name, "stage": node.stage.name(), "state": state,
                    "seconds": planned.seconds, "why": why.join("; "),
                }))
            };
            let rows: Vec<Value> = graph.nodes.iter().zip(&planned).filter_map(row).collect();
            Ok(Value::from(rows).to_string())
        })
    }

    /// Runs it.
    fn run(
        &self,
        py: Python<'_>,
        folders: Folders,
        nodes: Vec<String>,
        keep_going: bool,
        hear: Option<Py<PyAny>>,
    ) -> PyResult<Run> {
        let wanted = wanted(&self.graph, &nodes).map_err(|fault| wrong(py, fault.text()))?;
        let (graph, global) = (self.graph.clone(), self.global.clone());
        outcome::run(py, graph, global, folders, wanted, keep_going, hear)
    }
}

/// The wanted nodes; none is the pipeline's goal.
fn wanted(graph: &engine::graph::Graph, nodes: &[String]) -> Result<Vec<usize>, Fault> {
    if nodes.is_empty() {
        return Ok(graph.goal.clone());
    }
    nodes
        .iter()
        .map(|name| command::node(graph, name))
        .collect()
}

/// The stages that take what comes from elsewhere, a kind each.
pub(crate) fn importers() -> String {
    let one = |importer: &engine::Importer| {
        let stage = importer.stage;
        let ports = stage.ports().into_iter();
        let ports =
            ports.map(|p| json!({ "name": p.name, "kind": p.kind, "optional": p.optional }));
        json!({
            "kind": stage.yields(), "stage": stage.name(), "files": importer.files,
            "ports": ports.collect::<Vec<_>>(),
        })
    };
    let all: Vec<Value> = tailor::catalog::IMPORTERS.iter().map(one).collect();
    Value::from(all).to_string()
}

/// The kinds that stages make.
pub(crate) fn kinds() -> Vec<&'static str> {
    let kinds: BTreeSet<&str> = tailor::catalog::stages().map(AnyStage::yields).collect();
    kinds.into_iter().collect()
}
