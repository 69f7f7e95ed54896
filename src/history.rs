//! The records of runs: one file a run, with provenance; a run that found all that an earlier one
//! had is a line that says so. `past.rs` reads them.

use crate::graph::{Bound, Graph, Source};
use crate::key;
use crate::past::run_file;
use crate::store::{Store, StoreError};
use crate::walk::{Done, Fate};
use serde::Serialize;
use serde_json::json;
use stage::Hash;
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
    stage: &'static str,
    version: u32,
    fate: &'static str,
    why: Option<&'a str>,
    key: Option<String>,
    content: Option<String>,
    story: Cow<'a, [(String, String)]>,
    seconds: f64,
    bytes: u64,
    metrics: Vec<MetricRecord<'a>>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct MetricRecord<'a> {
    name: &'a str,
    value: f64,
    unit: &'a str,
}

const PROGRAM: &str = concat!("tailor ", env!("CARGO_PKG_VERSION"));

/// What a run came to.
pub(crate) struct Told<'a> {
    pub(crate) graph: &'a Graph,
    /// One entry a node of the graph.
    pub(crate) nodes: &'a [Option<Done>],
    /// The content of each input.
    pub(crate) inputs: &'a [Hash],
    pub(crate) seconds: f64,
}

impl<'a> Told<'a> {
    /// What a node's key was made of.
    fn story(&self, node: &Bound, done: &'a Done) -> Cow<'a, [(String, String)]> {
        if done.key.is_none() || !done.story.is_empty() {
            return Cow::Borrowed(&done.story);
        }
        let content = |source: &Option<Source>| match source.as_ref()? {
            Source::Input(i) => Some(self.inputs[*i]),
            Source::Node(j) => self.nodes[*j].as_ref()?.content,
        };
        let contents: Vec<Option<Hash>> = node.from.iter().map(content).collect();
        Cow::Owned(key::story(node, &contents).0)
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
                stage: node.stage.name(),
                version: node.stage.version(),
                fate: done.fate.word(),
                why: match &done.fate {
                    Fate::Failed(why) => Some(why),
                    _ => None,
                },
                key: hex(done.key),
                content: hex(done.content),
                story: self.story(node, done),
                seconds: done.seconds,
                bytes: done.bytes,
                metrics: done.metrics.iter().map(metric).collect(),
                warnings: &done.warnings,
            })
        };
        RunRecord {
            program: PROGRAM,
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
pub(crate) fn write(store: &Store, id: &str, told: &Told<'_>) -> Result<(), StoreError> {
    let Told {
        graph,
        nodes,
        seconds,
        ..
    } = *told;
    let all_found = nodes.iter().flatten().all(|d| d.fate == Fate::Found);
    let digest = digest(graph, nodes);
    let last_file = store.root().join("last-run");
    let last = all_found
        .then(|| std::fs::read_to_string(last_file).ok())
        .flatten();
    let same = last
        .as_deref()
        .and_then(|text| text.trim().split_once(' '))
        .filter(|(of, base)| *of == digest && run_file(store.root(), base).is_file());
    let written = match same {
        Some((_, base)) => {
            let line = json!({ "program": PROGRAM, "seconds": seconds, "same_as": base });
            store.write(&format!("runs/{id}.json"), line.to_string().as_bytes())
        }
        None => {
            let bytes = serde_json::to_vec(&told.record()).expect("bug: JSON");
            store
                .write(&format!("runs/{id}.json"), &bytes)
                .and_then(|()| store.write("last-run", format!("{digest} {id}\n").as_bytes()))
        }
    };
    let made = nodes.iter().flatten().any(|d| d.fate == Fate::Made);
    let failed = nodes
        .iter()
        .flatten()
        .any(|d| matches!(d.fate, Fate::Failed(_)));
    if made && !failed { written } else { Ok(()) }
}

/// What was found or made, as one hash.
fn digest(graph: &Graph, nodes: &[Option<Done>]) -> String {
    let mut hasher = blake3::Hasher::new();
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
