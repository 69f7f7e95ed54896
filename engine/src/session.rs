//! The engine as a library: hash the inputs, walk, write the run down, read results.

use crate::graph::{Graph, InputDecl};
use crate::history::{self, RunSummary};
use crate::journal::Journal;
use crate::outcome::Outcome;
use crate::permission;
use crate::run_one::{Pool, Surroundings};
use crate::source::{self, Memo};
use crate::store::Store;
use crate::walk::{Both, Failures, Job, Watch, walk};
use stage::{Files, Hash};
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

pub use crate::engine_error::EngineError;
pub use crate::past::runs;

/// How to run.
#[derive(Debug, Clone)]
pub struct Options {
    /// Where the store is.
    pub cache: PathBuf,
    /// How many threads work; `None` is one a core.
    pub threads: Option<usize>,
    /// Whether to go on with what does not depend on a failed node.
    pub keep_going: bool,
}

/// The files of each input, hashed; what was hashed is remembered in the store.
///
/// # Errors
///
/// An input has no folder, is unknown, or cannot be read.
pub fn inputs(
    graph: &Graph,
    answer: &[(String, PathBuf)],
    store: &Store,
) -> Result<Vec<Files>, EngineError> {
    let found = given_inputs(graph, answer, store)?;
    let whole = |(files, input): (Option<Files>, &InputDecl)| {
        let about = match input.about.trim_end_matches('.') {
            "" => String::new(),
            about => format!(" ({about})"),
        };
        files.ok_or_else(|| EngineError::Unsaid(input.name.clone(), about))
    };
    found.into_iter().zip(&graph.inputs).map(whole).collect()
}

/// As [`inputs`], `None` for those for which no folder is given.
///
/// # Errors
///
/// An input is unknown, or cannot be read.
pub fn given_inputs(
    graph: &Graph,
    answer: &[(String, PathBuf)],
    store: &Store,
) -> Result<Vec<Option<Files>>, EngineError> {
    let memo_file = store.root().join("files.json");
    let mut memo = Memo::load(&memo_file);
    let folders: HashMap<&str, &PathBuf> =
        answer.iter().map(|(name, f)| (name.as_str(), f)).collect();
    let known: HashSet<&str> = graph.inputs.iter().map(|i| i.name.as_str()).collect();
    if let Some((name, _)) = answer.iter().find(|(name, _)| !known.contains(&**name)) {
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
        let found = found.map_err(|why| EngineError::Source { name, why })?;
        if let (Some(folder), Some(found)) = (folder, &found) {
            store.note_link(folder, &found.root);
        }
        files.push(found);
    }
    if memo.is_fresh() {
        // Best effort: a store that cannot be written to may still hold all that is wanted.
        let _ = store.write("files.json", &memo.bytes());
    }
    Ok(files)
}

/// Runs the wanted nodes of a graph.
///
/// # Errors
///
/// Store or inputs cannot be used. A node that fails is in the outcome.
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

/// As [`run`], of a part of a run that goes on beside it: its results are in the store and nothing is recorded, so that
/// no list of runs has it and nobody takes it for the last one.
///
/// # Errors
///
/// As [`run`].
pub fn run_unrecorded(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Outcome, EngineError> {
    let store = Store::open(&options.cache)?;
    let files = ready(graph, folders, wanted, &store, cancel)?;
    Ok(walked(store, graph, &files, wanted, options, watch, cancel))
}

/// As [`run`], in a store that is open already.
///
/// # Errors
///
/// As [`run`].
pub fn run_in(
    store: Store,
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Outcome, EngineError> {
    let files = ready(graph, folders, wanted, &store, cancel)?;
    run_files(store, graph, files, wanted, options, watch, cancel)
}

/// The files of each input, hashed, of a graph whose programs may run.
fn ready(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    store: &Store,
    cancel: &AtomicBool,
) -> Result<Vec<Files>, EngineError> {
    let stop = || cancel.load(std::sync::atomic::Ordering::Relaxed);
    settled(graph, &crate::walk::all(graph, wanted), store, &stop)?;
    inputs(graph, folders, store)
}

/// As [`run_in`], of files that are hashed already, one entry an input, and of programs that may run.
pub(crate) fn run_files(
    store: Store,
    graph: &Graph,
    files: Vec<Files>,
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Result<Outcome, EngineError> {
    let id = store.next_run()?;
    let journal = Journal::new(store.root().join(format!("runs/{id}.jsonl")));
    let watch = Both(&journal, watch);
    let outcome = walked(store, graph, &files, wanted, options, &watch, cancel);
    let summary = RunSummary {
        graph,
        nodes: &outcome.nodes,
        inputs: &outcome.inputs,
        seconds: outcome.seconds,
    };
    history::write(&outcome.store, &id, &summary, &files)?;
    Ok(outcome)
}

/// Finds or makes the wanted nodes; nothing is recorded.
fn walked(
    store: Store,
    graph: &Graph,
    files: &[Files],
    wanted: &[usize],
    options: &Options,
    watch: &dyn Watch,
    cancel: &AtomicBool,
) -> Outcome {
    let start = std::time::Instant::now();
    let _keeping = programs::Keeping::new(store.root());
    let using = store.using();
    let contents: Vec<Hash> = files.iter().map(stage::content).collect();
    store.note_captures(&contents.iter().copied().zip(files).collect::<Vec<_>>());
    let threads = threads(options);
    let pool = Pool::new(threads);
    let around = Surroundings {
        store: &store,
        watch,
        cancel,
        pool: &pool,
        failures: &Failures::default(),
    };
    let job = Job {
        graph,
        files,
        contents: &contents,
        wanted,
        threads,
        keep_going: options.keep_going,
    };
    let nodes = walk(&job, &around);
    store.save_index();
    let names = graph.nodes.iter().map(|n| (n.name.clone(), n.stage));
    Outcome {
        names: names.collect(),
        inputs: contents,
        nodes,
        seconds: start.elapsed().as_secs_f64(),
        store,
        _using: using,
    }
}

/// Whether all programs may run that the nodes need.
pub(crate) fn settled(
    graph: &Graph,
    nodes: &[usize],
    store: &Store,
    stop: &dyn Fn() -> bool,
) -> Result<(), EngineError> {
    let settled = permission::settle(graph, nodes, store, stop);
    if !settled.refused.is_empty() {
        let text = permission::listing::refusal(graph, &settled.refused);
        return Err(EngineError::NotAllowed(text));
    }
    match settled.unknown {
        Some((i, why)) if !stop() => {
            let name = graph.nodes[i].name.clone();
            Err(EngineError::Identity { name, why })
        }
        _ => Ok(()),
    }
}

/// How many threads the options mean: at most four a core.
pub fn threads(options: &Options) -> usize {
    if system::clock::is_simulated() {
        return 0;
    }
    let cores = || std::thread::available_parallelism().map_or(1, |n| n.get());
    let most = THREADS_A_CORE * cores();
    options.threads.unwrap_or_else(cores).clamp(1, most)
}

/// More threads than this cost memory and gain nothing.
const THREADS_A_CORE: usize = 4;
