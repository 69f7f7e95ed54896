//! What came of a run: results by node, the record, files.

use crate::artifact::Artifact;
use crate::asked::{Folders, global};
use crate::fault::guarded;
use crate::job;
use command::{Fault, GlobalArgs, Heard, Host, SweepArgs};
use engine::sweep::End;
use engine::walk::Watch;
use engine::{Options, Outcome, out};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stage::Message;
use std::path::PathBuf;
use std::sync::Arc;

/// What came of a run.
#[pyclass(frozen, module = "tailor._native")]
pub(crate) struct Run {
    graph: Arc<engine::graph::Graph>,
    outcome: Outcome,
}

/// A file's name and bytes, for Python.
type PyFile = (String, Py<PyBytes>);

#[pymethods]
impl Run {
    /// The run as `run.json` has it.
    fn record(&self, py: Python<'_>) -> PyResult<String> {
        guarded(py, || Ok(self.outcome.json(&self.graph).to_string()))
    }

    /// The result of a node.
    fn artifact(&self, py: Python<'_>, node: &str) -> PyResult<Artifact> {
        guarded(py, || {
            let (blob, stage) = self.outcome.blob(node).map_err(Fault::input)?;
            Ok(Artifact::new(blob, stage))
        })
    }

    /// Nodes with a result.
    fn results(&self) -> Vec<String> {
        let nodes = self.graph.nodes.iter().zip(&self.outcome.nodes);
        let there = nodes.filter(|(_, done)| done.as_ref().is_some_and(|d| d.content.is_some()));
        there.map(|(node, _)| node.name.clone()).collect()
    }

    /// Nodes that failed, and why: a message as JSON.
    fn failures(&self) -> Vec<(String, String)> {
        let all = self.outcome.failures(&self.graph).into_iter();
        all.map(|(node, why)| (node.to_owned(), json(why)))
            .collect()
    }

    /// Formats in which a node's result is written, the usual one first.
    fn formats(&self, py: Python<'_>, node: &str) -> PyResult<Vec<&'static str>> {
        guarded(py, || {
            let at = command::node(&self.graph, node)?;
            let kind = self.graph.nodes[at].stage.yields();
            Ok(out::formats(self.graph.catalog, kind).to_vec())
        })
    }

    /// A node's result as files: one without a name, or several.
    fn files(&self, py: Python<'_>, node: &str, format: Option<String>) -> PyResult<Vec<PyFile>> {
        let files = guarded(py, || {
            let (blob, stage) = self.outcome.blob(node).map_err(Fault::input)?;
            let artifact = stage.read(&blob).map_err(Fault::stage)?;
            let at = command::node(&self.graph, node)?;
            let beside = self.graph.beside(at);
            let beside = beside.and_then(|at| self.outcome.artifact(&self.graph, at));
            let (raw, catalog) = (|| blob.to_vec(), self.graph.catalog);
            out::files(catalog, artifact, raw, beside, format.as_deref()).map_err(Fault::input)
        })?;
        let file = |(name, bytes): (String, Vec<u8>)| (name, PyBytes::new(py, &bytes).unbind());
        Ok(files.into_iter().map(file).collect())
    }
}

/// Runs wanted nodes of a graph.
pub(crate) fn run(
    py: Python<'_>,
    graph: Arc<engine::graph::Graph>,
    global: GlobalArgs,
    folders: Folders,
    mut wanted: Vec<usize>,
    keep_going: bool,
    hear: Option<Py<PyAny>>,
) -> PyResult<Run> {
    job::run(py, hear, move |host, listener| {
        // What it takes to write what is wanted must be there.
        let needed = engine::walk::all(&graph, &wanted);
        let beside = wanted.iter().filter_map(|i| graph.beside(*i));
        let beside: Vec<usize> = beside.filter(|i| needed.contains(i)).collect();
        wanted.extend(beside);
        let options = Options {
            cache: global.cache.clone(),
            threads: global.threads.map(Into::into),
            keep_going,
        };
        let (watch, cancel): (&dyn Watch, _) = (&*listener, host.cancel());
        let outcome = engine::run(&graph, &folders, &wanted, &options, watch, cancel);
        let outcome = outcome.map_err(Fault::input)?;
        if !keep_going {
            let failures = outcome.failures(&graph);
            if !failures.is_empty() {
                return Err(Fault::failed(&failures, ""));
            }
        }
        match outcome.cancelled() {
            true => Err(Fault::stopped()),
            false => Ok(Run { graph, outcome }),
        }
    })
}

/// A message for Python.
fn json(message: &Message) -> String {
    serde_json::to_string(message).expect("bug: JSON")
}

/// `tailor measure`.
pub(crate) fn measured(
    py: Python<'_>,
    words: Vec<String>,
    cache: PathBuf,
    threads: Option<usize>,
    hear: Option<Py<PyAny>>,
) -> PyResult<(Run, PathBuf, Vec<String>)> {
    job::run(py, hear, move |host, _| {
        let mut global = global(cache, threads)?;
        global.host = host;
        let measured = tailor::measured(&words, &global)?;
        let run = Run {
            graph: Arc::new(measured.graph),
            outcome: measured.outcome,
        };
        Ok((
            run,
            measured.out,
            measured.warnings.iter().map(json).collect(),
        ))
    })
}

/// `tailor sweep`.
pub(crate) fn swept(
    py: Python<'_>,
    words: Vec<String>,
    cache: PathBuf,
    threads: Option<usize>,
    allow_exec: bool,
    hear: Option<Py<PyAny>>,
) -> PyResult<(String, Vec<String>)> {
    job::run(py, hear, move |host: Host, listener| {
        let mut global = global(cache, threads)?;
        global.allow_exec = allow_exec;
        global.host = host;
        let args = SweepArgs::read(&words)?;
        let mut points = 0;
        let swept = command::swept(&args, &global, &*listener, &mut |heard| match heard {
            Heard::Outlook(outlook) => {
                points = usize::try_from(outlook.points).unwrap_or(usize::MAX);
                let what = outlook.to_string();
                listener.report(("outlook", String::new(), what, 0, points, outlook.seconds));
            }
            Heard::Row(row, at, name) => {
                let word = match &row.end {
                    End::Done => "point",
                    _ => "point failed",
                };
                listener.report((word, name, String::new(), at, points, row.seconds));
            }
        })?;
        let json = swept.json(tailor::program().catalog.program);
        Ok((json.to_string(), swept.missing()))
    })
}
