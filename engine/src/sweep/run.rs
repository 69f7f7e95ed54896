//! Runs the points of a sweep, one after the other, each to its end.

use super::busy::Busy;
use super::points::Point;
use crate::graph::{Graph, Source};
use crate::key;
use crate::outcome::Outcome;
use crate::session::{self, EngineError, Options};
use crate::store::Store;
use crate::tells::BESIDE;
use crate::walk::{Status, Watch, needed};
use stage::{Files, Hash, Metric};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// How a point ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// All that is wanted is there.
    Done,
    /// A node failed: which, and why.
    Failed(String, String),
    /// The pipeline is wrong at this point.
    Wrong(String),
    /// The user asked to stop before its end.
    Stopped,
}

/// What came of a point.
#[derive(Debug, Clone)]
pub struct Row {
    /// The point.
    pub point: Point,
    /// How it ended.
    pub end: End,
    /// What was asked for, in the order of the columns; `None` where there is none.
    pub metrics: Vec<(String, Option<Metric>)>,
    /// Names of all that there is of the nodes that were asked.
    pub known: Vec<String>,
    /// How many nodes ran for it.
    pub made: usize,
    /// How many were in the store.
    pub found: usize,
    /// How long it took now. \[s\]
    pub seconds: f64,
    /// How long its nodes took when each was made: what it would cost alone. \[s\]
    pub alone: f64,
    /// What the nodes took that ran for it. \[s\]
    pub work: f64,
    /// How long no stage ran: to open and plan, to hash, keep and read, to tell. \[s\]
    pub engine: f64,
}

/// Errors of results against ground truth.
pub type Errors<'a> = dyn Fn(&Graph, &Outcome) -> Result<Vec<Metric>, String> + 'a;

/// What all points have in common.
pub struct Sweeping<'a> {
    /// The pipeline at a point.
    pub open: &'a dyn Fn(&Point) -> Result<Graph, String>,
    /// The nodes that are wanted; none is the pipeline's goal.
    pub nodes: &'a [String],
    /// The user's folders.
    pub folders: &'a [(String, PathBuf)],
    /// How to run.
    pub options: &'a Options,
    /// `node.metric`; none is all that the wanted nodes tell.
    pub tell: &'a [String],
    /// Errors of a point's results against ground truth, as `error.…`.
    pub errors: Option<&'a Errors<'a>>,
    /// Who hears what happens inside a point.
    pub watch: &'a dyn Watch,
    /// Set when the user asks to stop.
    pub cancel: &'a AtomicBool,
}

/// Runs points in order; `done` gets each row as it comes. A point that fails does not stop the
/// others, and what failed is not tried again for the points that share it.
///
/// # Errors
///
/// Store or inputs cannot be used. A point that fails is in its row.
pub fn run(
    sweeping: &Sweeping<'_>,
    points: impl Iterator<Item = Point>,
    mut done: impl FnMut(&Row),
) -> Result<Vec<Row>, EngineError> {
    // Programs that are kept are kept for all points.
    let _keeping = crate::foreign::Keeping::new(&sweeping.options.cache);
    let mut failures = BTreeMap::new();
    let mut rows = Vec::new();
    for point in points {
        let row = one(sweeping, point, &mut failures)?;
        done(&row);
        rows.push(row);
        if sweeping.cancel.load(Ordering::Relaxed) {
            break;
        }
    }
    Ok(rows)
}

/// Why keys of this sweep failed.
type Failures = BTreeMap<[u8; 32], String>;

fn one(sweeping: &Sweeping<'_>, point: Point, failures: &mut Failures) -> Result<Row, EngineError> {
    let mut row = Row {
        point,
        end: End::Done,
        metrics: vec![],
        known: vec![],
        made: 0,
        found: 0,
        seconds: 0.0,
        alone: 0.0,
        work: 0.0,
        engine: 0.0,
    };
    let start = std::time::Instant::now();
    let graph = match (sweeping.open)(&row.point) {
        Ok(graph) => graph,
        Err(why) => {
            row.end = End::Wrong(why);
            return Ok(row);
        }
    };
    let named = sweeping.nodes.iter().filter_map(|name| graph.node(name));
    let mut wanted: Vec<usize> = named.collect();
    if sweeping.nodes.is_empty() {
        wanted = graph.goal.clone();
    }
    let store = Store::open(&sweeping.options.cache)?;
    let files = session::inputs(&graph, sweeping.folders, &store)?;
    if let Some((node, why)) = foreseen(&graph, &wanted, &files, &store, failures) {
        row.end = End::Failed(node, why);
        return Ok(row);
    }
    let busy = Busy::new(sweeping.watch);
    let outcome = session::run(
        &graph,
        sweeping.folders,
        &crate::walk::all(&graph, &wanted),
        sweeping.options,
        &busy,
        sweeping.cancel,
    )?;
    for done in outcome.nodes.iter().flatten() {
        match &done.status {
            Status::Executed => (row.made, row.work) = (row.made + 1, row.work + done.seconds),
            Status::Hit => row.found += 1,
            Status::Failed(why) => {
                failures.extend(done.key.map(|key| (*key.as_bytes(), why.clone())));
            }
            Status::Skipped | Status::Cancelled => {}
        }
        row.alone += done.seconds;
    }
    row.end = match outcome.failure(&graph) {
        Some((node, why)) => End::Failed(node.into(), why.into()),
        None if outcome.cancelled() => End::Stopped,
        None => End::Done,
    };
    match metrics(sweeping, &graph, &wanted, &outcome, row.end == End::Done) {
        Ok(cells) => (row.metrics, row.known) = (cells.metrics, cells.known),
        Err(why) => row.end = End::Wrong(format!("against the truth: {why}")),
    }
    row.seconds = start.elapsed().as_secs_f64();
    row.engine = (row.seconds - busy.seconds()).max(0.0);
    Ok(row)
}

/// A node of the point that failed in this sweep already, with the same inputs and params.
fn foreseen(
    graph: &Graph,
    wanted: &[usize],
    files: &[Files],
    store: &Store,
    failures: &Failures,
) -> Option<(String, String)> {
    if failures.is_empty() {
        return None;
    }
    let needed = needed(graph, wanted);
    let mut contents: Vec<Option<Hash>> = vec![None; graph.nodes.len()];
    for (i, node) in graph.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(j)) => Some(Some(stage::content(&files[*j]))),
            Some(Source::Node(j)) => contents[*j].map(Some),
        };
        let inputs: Option<Vec<Option<Hash>>> = node.from.iter().map(content).collect();
        let Some(key) = inputs.map(|inputs| key::key(node, &inputs)) else {
            continue;
        };
        if let Some(why) = failures.get(key.as_bytes()) {
            return Some((node.name.clone(), why.clone()));
        }
        contents[i] = store.record(key).map(|record| record.content);
    }
    None
}

/// What a row says of its point.
struct Cells {
    /// What was asked for, where it is known.
    metrics: Vec<(String, Option<Metric>)>,
    /// The names of all that could have been.
    known: Vec<String>,
}

/// What was asked for.
fn metrics(
    sweeping: &Sweeping<'_>,
    graph: &Graph,
    wanted: &[usize],
    outcome: &Outcome,
    done: bool,
) -> Result<Cells, String> {
    let mut known: BTreeMap<usize, Vec<Metric>> = BTreeMap::new();
    let plain = |node: usize| -> Vec<Metric> {
        let Some(done) = &outcome.nodes[node] else {
            return vec![];
        };
        let beside = BESIDE.into_iter().zip([done.seconds, done.bytes as f64]);
        let beside = beside.map(|((name, unit), value)| Metric {
            name: name.into(),
            value,
            unit: unit.into(),
        });
        done.metrics.iter().cloned().chain(beside).collect()
    };
    let mut of = |node: usize| -> Vec<Metric> {
        let all = known.entry(node).or_insert_with(|| {
            let mut all = plain(node);
            all.extend({
                let artifact = outcome.artifact(graph, node);
                artifact.map_or(vec![], |artifact| graph.catalog.facts(artifact))
            });
            all
        });
        all.clone()
    };
    let mut metrics = Vec::new();
    for asked in sweeping.tell.iter().filter(|t| !t.starts_with("error.")) {
        let (node, name) = asked.split_once('.').unwrap_or((asked, ""));
        let find = |all: Vec<Metric>| all.into_iter().find(|m| m.name == name);
        // The result itself is read only for what no metric says.
        let metric = graph
            .node(node)
            .and_then(|node| find(plain(node)).or_else(|| find(of(node))));
        metrics.push((asked.clone(), metric));
    }
    if sweeping.tell.is_empty() {
        for node in wanted {
            let name = &graph.nodes[*node].name;
            let plain = |m: &Metric| !m.name.contains('.') && m.name != "bytes";
            let all = of(*node).into_iter().filter(plain);
            metrics.extend(all.map(|m| (format!("{name}.{}", m.name), Some(m))));
        }
    }
    let asked: Vec<&str> = sweeping
        .tell
        .iter()
        .filter_map(|t| t.strip_prefix("error."))
        .collect();
    let errors = match sweeping.errors.filter(|_| done) {
        Some(errors) => errors(graph, outcome)?,
        None => vec![],
    };
    let all = asked.is_empty();
    for name in &asked {
        let metric = errors.iter().find(|m| m.name == *name).cloned();
        metrics.push((format!("error.{name}"), metric));
    }
    if all {
        metrics.extend(
            errors
                .iter()
                .map(|m| (format!("error.{}", m.name), Some(m.clone()))),
        );
    }
    let inside = known.iter().flat_map(|(node, all)| {
        let name = &graph.nodes[*node].name;
        all.iter().map(move |m| format!("{name}.{}", m.name))
    });
    let outside = errors.iter().map(|m| format!("error.{}", m.name));
    let known = inside.chain(outside).collect();
    Ok(Cells { metrics, known })
}
