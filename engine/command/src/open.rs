//! From arguments to a pipeline, its wanted nodes and its inputs.

use super::arguments::{Change, Wanted};
use super::fault::Fault;
use super::program::GlobalArgs;
use super::programs::permitted;
use engine::Options;
use engine::graph::Graph;
use engine::recipe::{self, Overrides};
use engine::store::Prefetch;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Reads what is remembered of the store while the pipeline is read.
pub(crate) fn prefetch(wanted: &Wanted, global: &GlobalArgs) -> Prefetch {
    let bytes = std::fs::metadata(&wanted.pipeline).map_or(0, |m| m.len());
    Prefetch::of(&global.cache, bytes)
}

/// Opens the pipeline of some arguments and finds the wanted nodes.
pub(crate) fn open(wanted: &Wanted, global: &GlobalArgs) -> Result<(Graph, Vec<usize>), Fault> {
    let graph = open_pipeline(Some(&wanted.pipeline), &wanted.change, global)?;
    let nodes = wanted.nodes.iter().map(|name| node(&graph, name));
    let nodes = nodes.collect::<Result<Vec<_>, Fault>>()?;
    let goal = if nodes.is_empty() {
        graph.goal.clone()
    } else {
        nodes
    };
    Ok((graph, goal))
}

/// The node of a name.
///
/// # Errors
///
/// There is no such node.
pub fn node(graph: &Graph, name: &str) -> Result<usize, Fault> {
    graph.node(name).ok_or_else(|| {
        let names: Vec<&str> = graph.nodes.iter().map(|n| n.name.as_str()).collect();
        Fault::coded(&stage::unknown("node", name, &names))
    })
}

/// A pipeline file or a built-in pipeline, by default the program's own, with what the command line changes.
///
/// # Errors
///
/// None is given and the program has none, or all mistakes of the pipeline.
pub fn open_pipeline(
    file: Option<&Path>,
    change: &Change,
    global: &GlobalArgs,
) -> Result<Graph, Fault> {
    let graph = read_pipeline(file, change, global)?;
    permitted(&graph, global)?;
    Ok(graph)
}

/// As [`open_pipeline`], of which nothing is to be run: no program of it is allowed.
pub(crate) fn read_pipeline(
    file: Option<&Path>,
    change: &Change,
    global: &GlobalArgs,
) -> Result<Graph, Fault> {
    let overrides = Overrides {
        variant: change.variant.clone(),
        sets: change.set.clone(),
    };
    let catalog = global.catalog();
    let file = match file.or(global.program().pipeline.map(Path::new)) {
        Some(file) => file,
        None => return Err(Fault::input("name a pipeline: give its file")),
    };
    recipe::open(file, &overrides, catalog).map_err(Fault::mistakes)
}

/// `NAME=FOLDER` as a pair.
///
/// # Errors
///
/// A text without `=`.
pub fn folders(change: &Change) -> Result<Vec<(String, PathBuf)>, Fault> {
    let pair = |text: &String| {
        let (name, folder) = text
            .split_once('=')
            .ok_or_else(|| Fault::input(format!("`--input {text}`: give NAME=FOLDER")))?;
        Ok((name.to_owned(), PathBuf::from(folder)))
    };
    change.input.iter().map(pair).collect()
}

/// Options of the global.
pub(crate) fn options(global: &GlobalArgs, keep_going: bool) -> Options {
    Options {
        cache: global.cache.clone(),
        threads: global.threads.map(NonZeroUsize::get),
        keep_going,
    }
}

/// A folder of truth that is not there would be a sweep without errors.
pub(super) fn truth_is_there(truth: Option<&Path>) -> Result<(), Fault> {
    match truth.filter(|folder| !folder.is_dir()) {
        Some(folder) => Err(Fault::input(format!(
            "--truth {}: there is no such folder",
            folder.display()
        ))),
        None => Ok(()),
    }
}
