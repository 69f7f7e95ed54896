//! What came of a point, and what its row shows.

use super::points::Point;
use super::sweeping::Sweeping;
use crate::done::Done;
use crate::graph::{Bound, Graph};
use crate::numbers::{BESIDE, ENDS};
use crate::outcome::Outcome;
use crate::walk::Status;
use stage::{Hash, Metric};
use std::collections::BTreeMap;

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

/// A result of a point, in the store.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The node.
    pub node: String,
    /// The key of its record.
    pub key: Hash,
    /// The content of its blob.
    pub content: Hash,
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
    /// What holds a number that was asked for, by its result itself.
    pub within: Vec<(String, [f64; 2])>,
    /// Names of all that there is of the nodes that were asked.
    pub known: Vec<String>,
    /// Where its results are, in the pipeline's order.
    pub results: Vec<Kept>,
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
    /// How long no stage ran: to open and plan, to hash, keep and read, to report. \[s\]
    pub engine: f64,
}

impl Row {
    /// Of a point of which nothing is known yet.
    pub(super) fn new(point: Point, end: End) -> Row {
        Row {
            point,
            end,
            metrics: vec![],
            within: vec![],
            known: vec![],
            results: vec![],
            made: 0,
            found: 0,
            seconds: 0.0,
            alone: 0.0,
            work: 0.0,
            engine: 0.0,
        }
    }

    /// What came of its nodes, and their numbers; `wanted` are those that are asked.
    pub(super) fn fill(
        &mut self,
        sweeping: &Sweeping<'_>,
        graph: &Graph,
        wanted: &[usize],
        outcome: &Outcome,
    ) {
        for done in outcome.nodes.iter().flatten() {
            match &done.status {
                Status::Executed => {
                    (self.made, self.work) = (self.made + 1, self.work + done.seconds)
                }
                Status::Hit => self.found += 1,
                Status::Failed(_) | Status::Skipped | Status::Cancelled => {}
            }
            self.alone += done.seconds;
        }
        let kept = |(node, done): (&Bound, &Option<Done>)| {
            let done = done.as_ref()?;
            Some(Kept {
                node: node.name.clone(),
                key: done.key?,
                content: done.content?,
            })
        };
        let nodes = graph.nodes.iter().zip(&outcome.nodes);
        self.results = nodes.filter_map(kept).collect();
        self.end = match outcome.failure(graph) {
            Some((node, why)) => End::Failed(node.into(), why.into()),
            None if outcome.cancelled() => End::Stopped,
            None => End::Done,
        };
        match metrics(sweeping, graph, wanted, outcome, self.end == End::Done) {
            Ok(cells) => {
                (self.metrics, self.within, self.known) =
                    (cells.metrics, cells.within, cells.known);
            }
            Err(why) => self.end = End::Wrong(format!("against the truth: {why}")),
        }
    }
}

/// What a row shows of its point.
struct Cells {
    /// What was asked for, where it is known.
    metrics: Vec<(String, Option<Metric>)>,
    /// Its intervals, by its name.
    within: Vec<(String, [f64; 2])>,
    /// The names of all that could have been.
    known: Vec<String>,
}

/// The numbers of a node without its result being read.
fn plain(done: &Done) -> Vec<Metric> {
    let spent = done.spent;
    let values = [
        Some(done.seconds),
        Some(done.bytes as f64),
        spent.processor,
        spent.memory.map(|bytes| bytes as f64),
    ];
    let beside = BESIDE.into_iter().zip(values);
    let beside = beside.filter_map(|((name, unit), value)| {
        Some(Metric {
            name: name.into(),
            value: value?,
            unit: unit.into(),
        })
    });
    done.metrics.iter().cloned().chain(beside).collect()
}

/// What holds a number of a result, where the result knows.
fn within(all: &[Metric], metric: &str) -> Option<[f64; 2]> {
    let end = |ending: &str| {
        let name = format!("{metric}{ending}");
        Some(all.iter().find(|m| m.name == name)?.value)
    };
    Some([end(ENDS[0])?, end(ENDS[1])?])
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
    let plain = |node: usize| outcome.nodes[node].as_ref().map_or(vec![], plain);
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
        // The result itself is read only for what no metric gives.
        let metric = graph
            .node(node)
            .and_then(|node| find(plain(node)).or_else(|| find(of(node))));
        metrics.push((asked.clone(), metric));
    }
    if sweeping.tell.is_empty() {
        for node in wanted {
            let name = &graph.nodes[*node].name;
            let aside = ["processor", "memory", "bytes"];
            let plain = |m: &Metric| !m.name.contains('.') && !aside.contains(&m.name.as_str());
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
    let within = |(name, _): &(String, Option<Metric>)| {
        let (node, metric) = name.split_once('.')?;
        Some((
            name.clone(),
            within(known.get(&graph.node(node)?)?, metric)?,
        ))
    };
    let within = metrics.iter().filter_map(within).collect();
    let inside = known.iter().flat_map(|(node, all)| {
        let name = &graph.nodes[*node].name;
        all.iter().map(move |m| format!("{name}.{}", m.name))
    });
    let outside = errors.iter().map(|m| format!("error.{}", m.name));
    let known = inside.chain(outside).collect();
    Ok(Cells {
        metrics,
        within,
        known,
    })
}
