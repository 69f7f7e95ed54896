//! From arguments to a pipeline, its wanted nodes and its inputs.

use super::arguments::{Change, Wanted};
use super::fault::Fault;
use super::program::GlobalArgs;
use super::speech::CANCEL;
use crate::foreign::{self, Sandbox};
use crate::graph::Graph;
use crate::recipe::{self, Overrides};
use crate::session::Options;
use crate::store::{Prefetch, Store};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Once;
use std::sync::atomic::Ordering;

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
        Fault::input(stage::unknown("node", name, &names))
    })
}

/// A pipeline file or a built-in pipeline, the program's own if none is said, with what the command line changes.
///
/// # Errors
///
/// None is said and the program has none, or all mistakes of the pipeline.
pub fn open_pipeline(
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
        None => return Err(Fault::input("say which pipeline: give its file")),
    };
    let graph = recipe::open(file, &overrides, catalog).map_err(Fault::mistakes)?;
    permitted(&graph, global)?;
    Ok(graph)
}

/// With `--allow-exec` remembers that the programs of a pipeline may run; tells all whether they may.
///
/// # Errors
///
/// The cache cannot be used.
pub(super) fn permitted(graph: &Graph, global: &GlobalArgs) -> Result<(), Fault> {
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    if foreign::programs(graph, &all).next().is_none() {
        return Ok(());
    }
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    if global.allow_exec {
        foreign::allow(graph, &all, &store).map_err(Fault::input)?;
    }
    let stop = || CANCEL.load(Ordering::Relaxed);
    foreign::settle(graph, &all, &store, &stop);
    Ok(())
}

/// Says once what keeps programs apart from the rest of this machine, if that is nothing.
pub(super) fn unguarded(graph: &Graph, nodes: &[usize], global: &GlobalArgs) {
    static SAID: Once = Once::new();
    let quiet = global.quiet || global.json;
    if !quiet
        && foreign::programs(graph, nodes).next().is_some()
        && let Sandbox::None(why) = foreign::sandbox()
    {
        SAID.call_once(|| {
            crate::errln!(
                "{why}: the pipeline's programs can reach the network and write wherever you can"
            );
        });
    }
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
            .ok_or_else(|| Fault::input(format!("`--input {text}`: say NAME=FOLDER")))?;
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
