//! The records of runs: one file a run, with provenance, in lines; a run that found all that an
//! earlier one had is a line that names that run. `past.rs` reads them.

use crate::done::{Done, Status};
use crate::graph::{Bound, Graph, Source};
use crate::key;
use crate::past::{FileLists, Head, Of, run_file};
use crate::store::{Store, StoreError};
use serde::Serialize;
use stage::{FileEntry, Files, Hash, Message};
use std::borrow::Cow;

/// A run with its provenance, for `run.json` and the store.
#[derive(Serialize)]
pub(crate) struct RunRecord<'a> {
    program: &'static str,
    about: &'a str,
    seconds: f64,
    nodes: Vec<NodeRecord<'a>>,
}

#[derive(Serialize)]
struct NodeRecord<'a> {
    node: &'a str,
    content: Option<String>,
    stage: &'static str,
    version: u32,
    status: &'static str,
    why: Option<&'a Message>,
    key: Option<String>,
    provenance: Cow<'a, [(String, String)]>,
    seconds: f64,
    bytes: u64,
    metrics: Vec<MetricRecord<'a>>,
    warnings: &'a [Message],
}

#[derive(Serialize)]
struct MetricRecord<'a> {
    name: &'a str,
    value: f64,
    unit: &'a str,
}

/// What a run came to.
pub(crate) struct RunSummary<'a> {
    pub(crate) graph: &'a Graph,
    /// One entry a node of the graph.
    pub(crate) nodes: &'a [Option<Done>],
    /// The content of each input.
    pub(crate) inputs: &'a [Hash],
    pub(crate) seconds: f64,
}

impl<'a> RunSummary<'a> {
    /// What a node's key was made of.
    fn provenance(&self, node: &Bound, done: &'a Done) -> Cow<'a, [(String, String)]> {
        if done.key.is_none() || !done.provenance.is_empty() {
            return Cow::Borrowed(&done.provenance);
        }
        let content = |source: &Option<Source>| match source.as_ref()? {
            Source::Input(i) => Some(self.inputs[*i]),
            Source::Node(j) => self.nodes[*j].as_ref()?.content,
        };
        let contents: Vec<Option<Hash>> = node.from.iter().map(content).collect();
        Cow::Owned(key::provenance(node, &contents).0)
    }

    /// As it is written down.
    pub(crate) fn record(&self) -> RunRecord<'a> {
        let hex = |hash: Option<Hash>| hash.map(|h| h.to_hex().to_string());
        let node = |(done, node): (&'a Option<Done>, &'a Bound)| {
            let done = done.as_ref()?;
            let metric = |m: &'a stage::Metric| MetricRecord {
                name: &m.name,
                value: m.value,
                unit: &m.unit,
            };
            Some(NodeRecord {
                node: &node.name,
                content: hex(done.content),
                stage: node.stage.name(),
                version: node.stage.version(),
                status: done.status.word(),
                why: match &done.status {
                    Status::Failed(why) => Some(why),
                    _ => None,
                },
                key: hex(done.key),
                provenance: self.provenance(node, done),
                seconds: done.seconds,
                bytes: done.bytes,
                metrics: done.metrics.iter().map(metric).collect(),
                warnings: &done.warnings,
            })
        };
        RunRecord {
            program: self.graph.catalog.program,
            about: &self.graph.about,
            seconds: self.seconds,
            nodes: self
                .nodes
                .iter()
                .zip(&self.graph.nodes)
                .filter_map(node)
                .collect(),
        }
    }
}

/// Writes a run down under an id. That it cannot be written is no fault of a run that made nothing,
/// and hides no other fault.
pub(crate) fn write(
    store: &Store,
    id: &str,
    summary: &RunSummary<'_>,
    files: &[Files],
) -> Result<(), StoreError> {
    let RunSummary { graph, nodes, .. } = *summary;
    let of = Of::new(graph, files);
    let statuses = || nodes.iter().flatten().map(|d| &d.status);
    let count = |fits: fn(&Status) -> bool| statuses().filter(|f| fits(f)).count();
    let failed = count(|f| matches!(f, Status::Failed(_)));
    let mut head = Head {
        program: graph.catalog.program.into(),
        about: graph.about.clone(),
        seconds: summary.seconds,
        made: count(|f| *f == Status::Executed),
        found: count(|f| *f == Status::Hit),
        failed,
        same_as: None,
        of,
    };
    let all_found = statuses().all(|f| *f == Status::Hit);
    let digest = digest(graph, nodes, &head.of);
    let last_file = store.root().join("last-run");
    let last = all_found
        .then(|| std::fs::read_to_string(last_file).ok())
        .flatten();
    head.same_as = last
        .as_deref()
        .and_then(|text| text.trim().split_once(' '))
        .filter(|(of, base)| *of == digest && run_file(store.root(), base).is_file())
        .map(|(_, base)| base.to_owned());
    let mut lines = line(&head);
    let written = if head.same_as.is_some() {
        store.write(&format!("runs/{id}.json"), &lines)
    } else {
        lines.extend(line(&file_lists(graph, files)));
        for node in summary.record().nodes {
            lines.extend(line(&node));
        }
        store
            .write(&format!("runs/{id}.json"), &lines)
            .and_then(|()| store.write("last-run", format!("{digest} {id}\n").as_bytes()))
    };
    if head.made > 0 && failed == 0 {
        written
    } else {
        Ok(())
    }
}

fn line(what: &impl Serialize) -> Vec<u8> {
    let mut line = serde_json::to_vec(what).expect("bug: JSON");
    line.push(b'\n');
    line
}

/// The files of each input.
fn file_lists(graph: &Graph, files: &[Files]) -> FileLists {
    let hash = |e: &FileEntry| (e.name.clone(), e.content.to_hex().to_string());
    let inputs = graph.inputs.iter().zip(files);
    inputs
        .map(|(input, files)| (input.name.clone(), files.entries.iter().map(hash).collect()))
        .collect()
}

/// What was found or made, and of what, as one hash.
fn digest(graph: &Graph, nodes: &[Option<Done>], of: &Of) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&line(of));
    for (done, node) in nodes.iter().zip(&graph.nodes) {
        let Some(done) = done else { continue };
        hasher.update(&(node.name.len() as u64).to_le_bytes());
        hasher.update(node.name.as_bytes());
        for hash in [done.key, done.content] {
            hasher.update(hash.as_ref().map_or(&[0; 32], |h| h.as_bytes()));
        }
    }
    hasher.finalize().to_hex().to_string()
}
