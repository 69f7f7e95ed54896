//! The engine as a library: hash the inputs, walk, write the run down, read results.

use crate::graph::Graph;
use crate::run_one::Surroundings;
use crate::source::{self, Memo, SourceError};
use crate::store::{Store, StoreError};
use crate::walk::{Done, Fate, Job, Watch, walk};
use serde_json::{Value, json};
use stage::{AnyArtifact, Files, Hash};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// How to run.
#[derive(Debug, Clone)]
pub struct Options {
    /// Where the store lies.
    pub cache: PathBuf,
    /// How many threads work; `None` is one a core.
    pub threads: Option<usize>,
    /// Whether to go on with what does not depend on a failed node.
    pub keep_going: bool,
}

/// Why nothing could be run.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The inputs.
    #[error("input `{name}`: {why}")]
    Source {
        /// Which input.
        name: String,
        /// Why.
        why: SourceError,
    },
    /// An input that nobody handed over.
    #[error("input `{0}` ({1}) was not handed over: say --input {0}=FOLDER")]
    Unsaid(String, String),
}

/// A run that came to an end.
pub struct Outcome {
    /// One entry a node, in the graph's order; `None` for those that were not wanted.
    pub nodes: Vec<Option<Done>>,
    /// The whole run took so long. \[s\]
    pub seconds: f64,
    store: Store,
}

/// The files of each input, hashed; what was hashed is remembered in the store.
pub fn inputs(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    store: &Store,
) -> Result<Vec<Files>, EngineError> {
    let memo_file = store.root().join("files.json");
    let mut memo = Memo::load(&memo_file);
    let before = memo.bytes();
    let mut files = Vec::new();
    for input in &graph.inputs {
        let folder = folders.iter().find(|(name, _)| *name == input.name);
        let unsaid = || EngineError::Unsaid(input.name.clone(), input.about.clone());
        let (name, folder) = folder.ok_or_else(unsaid)?;
        let found = source::files(folder, input, &mut memo);
        files.push(found.map_err(|why| EngineError::Source {
            name: name.clone(),
            why,
        })?);
    }
    let after = memo.bytes();
    if after != before {
        store.write("files.json", &after)?;
    }
    Ok(files)
}

/// Runs the wanted nodes of a graph.
pub fn run(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Outcome, EngineError> {
    let start = std::time::Instant::now();
    let store = Store::open(&options.cache)?;
    let files = inputs(graph, folders, &store)?;
    let threads = threads(options);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.expect("bug: no threads");
    let around = Surroundings {
        store: &store,
        watch,
        cancel,
        pool: &pool,
    };
    let job = Job {
        graph,
        files: &files,
        wanted,
        threads,
        keep_going: options.keep_going,
    };
    let nodes = walk(&job, &around);
    let outcome = Outcome {
        nodes,
        seconds: start.elapsed().as_secs_f64(),
        store,
    };
    let record = serde_json::to_vec_pretty(&outcome.json(graph)).expect("bug: JSON");
    outcome.store.write(
        &format!("runs/{:020}.json", crate::clock::now_ns()),
        &record,
    )?;
    Ok(outcome)
}

/// How many threads the options mean.
pub fn threads(options: &Options) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, |n| n.get());
    options.threads.unwrap_or_else(cores).max(1)
}

impl Outcome {
    /// The result of a node, out of the store.
    pub fn artifact(&self, graph: &Graph, node: usize) -> Option<AnyArtifact> {
        let content = self.nodes[node].as_ref()?.content?;
        graph.nodes[node]
            .stage
            .read(&self.store.blob(content)?)
            .ok()
    }

    /// The first failure: node and why.
    pub fn failure<'a>(&'a self, graph: &'a Graph) -> Option<(&'a str, &'a str)> {
        self.nodes
            .iter()
            .zip(&graph.nodes)
            .find_map(|(done, node)| match &done.as_ref()?.fate {
                Fate::Failed(why) => Some((node.name.as_str(), why.as_str())),
                _ => None,
            })
    }

    /// Whether the user asked to stop before all was done.
    pub fn cancelled(&self) -> bool {
        self.nodes
            .iter()
            .flatten()
            .any(|done| done.fate == Fate::Cancelled)
    }

    /// The run with its provenance, for `run.json` and the store.
    pub fn json(&self, graph: &Graph) -> Value {
        let hex = |hash: Option<Hash>| hash.map(|h| h.to_hex().to_string());
        let node = |(done, node): (&Done, &crate::graph::Bound)| {
            let (fate, why) = match &done.fate {
                Fate::Found => ("found", None),
                Fate::Made => ("made", None),
                Fate::Failed(why) => ("failed", Some(why)),
                Fate::Skipped => ("skipped", None),
                Fate::Cancelled => ("cancelled", None),
            };
            let metric =
                |m: &stage::Metric| json!({"name": m.name, "value": m.value, "unit": m.unit});
            json!({
                "node": node.name, "stage": node.stage.name(), "version": node.stage.version(),
                "fate": fate, "why": why, "key": hex(done.key), "content": hex(done.content),
                "story": done.story, "seconds": done.seconds, "bytes": done.bytes,
                "metrics": done.metrics.iter().map(metric).collect::<Vec<_>>(),
                "warnings": done.warnings,
            })
        };
        let nodes = self.nodes.iter().zip(&graph.nodes);
        let nodes: Vec<_> = nodes
            .filter_map(|(d, n)| d.as_ref().map(|d| node((d, n))))
            .collect();
        json!({
            "program": concat!("tailor ", env!("CARGO_PKG_VERSION")), "about": graph.about,
            "seconds": self.seconds, "nodes": nodes,
        })
    }
}

/// The records of earlier runs in a store, the newest first.
pub fn runs(store: &Path) -> Vec<(String, Value)> {
    let Ok(entries) = std::fs::read_dir(store.join("runs")) else {
        return vec![];
    };
    let mut names: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    names.sort();
    let read = |path: &PathBuf| {
        let run = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
        Some((path.file_stem()?.to_str()?.to_owned(), run))
    };
    names.iter().rev().filter_map(read).collect()
}
