//! The engine as a library: hash the inputs, walk, write the run down, read results.

use crate::graph::{Bound, Graph, InputDecl};
use crate::history::{self, Told};
use crate::journal::Journal;
use crate::past;
use crate::run_one::{Pool, Surroundings};
use crate::source::{self, Memo, SourceError};
use crate::store::{InUse, Store, StoreError};
use crate::walk::{Done, Fate, Job, Watch, walk};
use serde_json::Value;
use stage::{AnyArtifact, AnyStage, Artifact, Corrupt, Files, Hash};
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

pub use crate::past::runs;

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
    /// An input that the pipeline does not have.
    #[error("{0}")]
    Unknown(String),
}

/// A run that came to an end.
pub struct Outcome {
    /// One entry a node, in the graph's order; `None` for those that were not wanted.
    pub nodes: Vec<Option<Done>>,
    /// The whole run took so long. \[s\]
    pub seconds: f64,
    /// The name and the stage of each node.
    names: Vec<(String, &'static dyn AnyStage)>,
    /// The content of each input.
    inputs: Vec<Hash>,
    store: Store,
    /// Results stay as long as somebody may read them.
    _using: InUse,
}

/// The files of each input, hashed; what was hashed is remembered in the store.
pub fn inputs(
    graph: &Graph,
    said: &[(String, PathBuf)],
    store: &Store,
) -> Result<Vec<Files>, EngineError> {
    let found = said_inputs(graph, said, store)?;
    let whole = |(files, input): (Option<Files>, &InputDecl)| {
        files.ok_or_else(|| EngineError::Unsaid(input.name.clone(), input.about.clone()))
    };
    found.into_iter().zip(&graph.inputs).map(whole).collect()
}

/// As [`inputs`], `None` for those for which no folder is said.
pub fn said_inputs(
    graph: &Graph,
    said: &[(String, PathBuf)],
    store: &Store,
) -> Result<Vec<Option<Files>>, EngineError> {
    let memo_file = store.root().join("files.json");
    let mut memo = Memo::load(&memo_file);
    let folders: HashMap<&str, &PathBuf> =
        said.iter().map(|(name, f)| (name.as_str(), f)).collect();
    let known: HashSet<&str> = graph.inputs.iter().map(|i| i.name.as_str()).collect();
    if let Some((name, _)) = said.iter().find(|(name, _)| !known.contains(&**name)) {
        let known: Vec<&str> = graph.inputs.iter().map(|i| i.name.as_str()).collect();
        let what = stage::unknown("input", name, &known);
        return Err(EngineError::Unknown(format!("`--input {name}`: {what}")));
    }
    let mut files = Vec::with_capacity(graph.inputs.len());
    for input in &graph.inputs {
        let folder = folders.get(input.name.as_str());
        let found = folder.map(|folder| source::files(folder, input, &mut memo));
        let name = input.name.clone();
        let found = found.transpose();
        files.push(found.map_err(|why| EngineError::Source { name, why })?);
    }
    if memo.is_fresh() {
        // Best effort: a store that cannot be written to may still hold all that is wanted.
        let _ = store.write("files.json", &memo.bytes());
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
    let store = Store::open(&options.cache)?;
    run_in(store, graph, folders, wanted, options, watch, cancel)
}

/// As [`run`], in a store that is open already.
pub fn run_in(
    store: Store,
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Outcome, EngineError> {
    let start = std::time::Instant::now();
    let using = store.using();
    let files = inputs(graph, folders, &store)?;
    let contents: Vec<Hash> = files.iter().map(stage::content).collect();
    for (content, files) in contents.iter().zip(&files) {
        store.note_capture(*content, &files.root);
    }
    let threads = threads(options);
    let id = past::next_id(store.root());
    let journal = Journal::new(watch, store.root().join(format!("runs/{id}.jsonl")));
    let pool = Pool::new(threads);
    let around = Surroundings {
        store: &store,
        watch: &journal,
        cancel,
        pool: &pool,
    };
    let job = Job {
        graph,
        files: &files,
        contents: &contents,
        wanted,
        threads,
        keep_going: options.keep_going,
    };
    let nodes = walk(&job, &around);
    store.save_index();
    let seconds = start.elapsed().as_secs_f64();
    let told = Told {
        graph,
        nodes: &nodes,
        inputs: &contents,
        seconds,
    };
    history::write(&store, &id, &told, &files)?;
    let names = graph.nodes.iter().map(|n| (n.name.clone(), n.stage));
    Ok(Outcome {
        names: names.collect(),
        inputs: contents,
        nodes,
        seconds,
        store,
        _using: using,
    })
}

/// How many threads the options mean: at most four a core.
pub fn threads(options: &Options) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, |n| n.get());
    let most = THREADS_A_CORE * cores();
    options.threads.unwrap_or_else(cores).clamp(1, most)
}

/// More threads than this cost memory and gain nothing.
const THREADS_A_CORE: usize = 4;

/// Why there is no result of a node to be read.
#[derive(Debug, thiserror::Error)]
pub enum ResultError {
    /// No node of that name.
    #[error("{0}")]
    Unknown(String),
    /// It was not wanted, failed, or was not reached.
    #[error("`{0}` has no result: it was not wanted, or it did not come to its end")]
    Missing(String),
    /// Not in the store any more.
    #[error("the result of `{0}` went out of the cache; run it again")]
    Gone(String),
    /// Not whole.
    #[error("the result of `{node}` cannot be read")]
    Corrupt {
        /// The node.
        node: String,
        /// What is wrong with it.
        source: Corrupt,
    },
    /// Another kind than was asked for.
    #[error("`{node}` makes {kind}, not {asked}")]
    Kind {
        /// The node.
        node: String,
        /// What it makes.
        kind: &'static str,
        /// What was asked for.
        asked: &'static str,
    },
}

impl Outcome {
    /// The result of the node of a name.
    ///
    /// # Errors
    /// Where there is no such node, or no result of it, or it is of another kind.
    pub fn read<A: Artifact>(&self, name: &str) -> Result<Arc<A>, ResultError> {
        let Some(at) = self.names.iter().position(|(node, _)| node == name) else {
            let known: Vec<&str> = self.names.iter().map(|(node, _)| node.as_str()).collect();
            return Err(ResultError::Unknown(stage::unknown("node", name, &known)));
        };
        let (node, stage) = (name.to_owned(), self.names[at].1);
        let Some(content) = self.nodes[at].as_ref().and_then(|done| done.content) else {
            return Err(ResultError::Missing(node));
        };
        let Some(blob) = self.store.blob(content) else {
            return Err(ResultError::Gone(node));
        };
        let artifact = match stage.read(&blob) {
            Ok(artifact) => artifact,
            Err(source) => return Err(ResultError::Corrupt { node, source }),
        };
        let (kind, asked) = (stage.yields(), A::KIND);
        artifact
            .downcast()
            .ok_or(ResultError::Kind { node, kind, asked })
    }

    /// The result of a node, out of the store.
    pub fn artifact(&self, graph: &Graph, node: usize) -> Option<AnyArtifact> {
        let content = self.nodes[node].as_ref()?.content?;
        graph.nodes[node]
            .stage
            .read(&self.store.blob(content)?)
            .ok()
    }

    /// The bytes of a node's result, out of the store.
    pub fn bytes(&self, node: usize) -> Option<Vec<u8>> {
        let content = self.nodes[node].as_ref()?.content?;
        Some(self.store.blob(content)?.to_vec())
    }

    /// The first failure: node and why.
    pub fn failure<'a>(&'a self, graph: &'a Graph) -> Option<(&'a str, &'a str)> {
        self.failures(graph).into_iter().next()
    }

    /// All failures: node and why.
    pub fn failures<'a>(&'a self, graph: &'a Graph) -> Vec<(&'a str, &'a str)> {
        let nodes = self.nodes.iter().zip(&graph.nodes);
        let why = |(done, node): (&'a Option<Done>, &'a Bound)| match &done.as_ref()?.fate {
            Fate::Failed(why) => Some((node.name.as_str(), why.as_str())),
            _ => None,
        };
        nodes.filter_map(why).collect()
    }

    /// Whether the user asked to stop before all was done.
    pub fn cancelled(&self) -> bool {
        self.nodes
            .iter()
            .flatten()
            .any(|done| done.fate == Fate::Cancelled)
    }

    /// The run with its provenance, for `run.json`.
    pub fn json(&self, graph: &Graph) -> Value {
        let told = Told {
            graph,
            nodes: &self.nodes,
            inputs: &self.inputs,
            seconds: self.seconds,
        };
        serde_json::to_value(told.record()).expect("bug: JSON")
    }
}
