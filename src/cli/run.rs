//! `tailor run`, and what every verb that runs shares.

use super::speak::Speaker;
use super::{CANCEL, Change, Fault, House, Wanted, deliver};
use crate::delivery::Delivery;
use crate::engine::{self, Options, Outcome};
use crate::graph::Graph;
use crate::lasttime::History;
use crate::past::Of;
use crate::recipe::{self, Overrides};
use crate::store::{Ahead, Store};
use crate::{out, verify, walk};
use clap::Args;
use serde_json::json;
use shape::Photos;
use stage::AnyArtifact;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Arguments of `tailor run`.
#[derive(Args)]
pub(crate) struct Run {
    #[command(flatten)]
    wanted: Wanted,
    /// Write the wanted results into this folder
    #[arg(long)]
    out: Option<PathBuf>,
    /// Remove from that folder what an earlier run wrote there and this one does not
    #[arg(long, requires = "out")]
    clean: bool,
    /// Go on with what does not depend on a failed node, and write what there is
    #[arg(long)]
    keep_going: bool,
    /// Keep nothing in the cache: what is made goes when the results are written
    #[arg(long)]
    pub(super) private: bool,
    /// Run every stage once more and compare: a stage must give the same bytes twice
    #[arg(long)]
    verify: bool,
}

/// Reads what is remembered of the store while the pipeline is read.
pub(crate) fn ahead(wanted: &Wanted, house: &House) -> Ahead {
    let bytes = std::fs::metadata(&wanted.pipeline).map_or(0, |m| m.len());
    Ahead::of(&house.cache, bytes)
}

/// Opens the pipeline of some arguments and finds the wanted nodes.
pub(crate) fn open(wanted: &Wanted) -> Result<(Graph, Vec<usize>), Fault> {
    let graph = opened(Some(&wanted.pipeline), &wanted.change)?;
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
pub(crate) fn node(graph: &Graph, name: &str) -> Result<usize, Fault> {
    graph.node(name).ok_or_else(|| {
        let names: Vec<&str> = graph.nodes.iter().map(|n| n.name.as_str()).collect();
        Fault::input(stage::unknown("node", name, &names))
    })
}

/// A pipeline file, the product's if none is said, with what the command line changes.
pub(crate) fn opened(file: Option<&std::path::Path>, change: &Change) -> Result<Graph, Fault> {
    let overrides = Overrides {
        variant: change.variant.clone(),
        sets: change.set.clone(),
    };
    let graph = match file {
        Some(file) => recipe::open(file, &overrides, &crate::catalog::CATALOG),
        None => recipe::open_text(
            "pipelines/body.toml",
            super::door::BODY,
            &overrides,
            &crate::catalog::CATALOG,
        ),
    };
    graph.map_err(Fault::mistakes)
}

/// `NAME=FOLDER` as a pair.
pub(crate) fn folders(change: &Change) -> Result<Vec<(String, PathBuf)>, Fault> {
    let pair = |text: &String| {
        let (name, folder) = text.split_once('=').ok_or_else(|| {
            Fault::input(format!(
                "`--input {text}`: say NAME=FOLDER, such as photos=samples/mannequin"
            ))
        })?;
        Ok((name.to_owned(), PathBuf::from(folder)))
    };
    change.input.iter().map(pair).collect()
}

/// Options of the house.
pub(crate) fn options(house: &House, keep_going: bool) -> Options {
    Options {
        cache: house.cache.clone(),
        threads: house.threads.map(NonZeroUsize::get),
        keep_going,
    }
}

/// Runs in a store, and turns failures into faults; `again` is the command that repeats a failed node.
pub(crate) fn execute(
    store: Store,
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    house: &House,
    again: &str,
) -> Result<Outcome, Fault> {
    match execute_some(store, graph, folders, wanted, house, false, again)? {
        (outcome, None) => Ok(outcome),
        (_, Some(fault)) => Err(fault),
    }
}

/// As [`execute`], with what came of the rest beside the fault.
fn execute_some(
    store: Store,
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    house: &House,
    keep_going: bool,
    again: &str,
) -> Result<(Outcome, Option<Fault>), Fault> {
    let needed = walk::needed(graph, wanted);
    let count = needed.iter().filter(|n| **n).count();
    // Files are called after the photos, which must be there for it.
    let mut wanted = wanted.to_vec();
    wanted.extend(photos_node(graph).filter(|i| needed[*i]));
    let wanted = wanted.as_slice();
    let speaker = Speaker::new(house.quiet || house.json, count);
    if speaker.asks_for_time() {
        let history = History::of(&house.cache, Of::default());
        let names = graph
            .nodes
            .iter()
            .zip(&needed)
            .filter(|(_, needed)| **needed);
        let seconds = |name: &str| Some(history.last(name)?.seconds);
        let expected = names.filter_map(|(n, _)| Some((n.name.clone(), seconds(&n.name)?)));
        speaker.expect(expected.collect());
    }
    let options = options(house, keep_going);
    let outcome = engine::run_in(store, graph, folders, wanted, &options, &speaker, &CANCEL);
    let outcome = outcome.map_err(Fault::input)?;
    let failures = outcome.failures(graph);
    if !failures.is_empty() {
        let lines: Vec<String> = failures
            .iter()
            .map(|(node, why)| format!("{node} failed: {why}\n"))
            .collect();
        let one = |(node, why): &(&str, &str)| json!({ "node": node, "why": why });
        let mut fault = Fault::stage(format!("{}to repeat it: {again}", lines.concat()));
        let failures = failures.iter().map(one).collect();
        fault.more.insert("failures".into(), failures);
        fault.more.insert("repeat".into(), again.into());
        return Ok((outcome, Some(fault)));
    }
    if outcome.cancelled() {
        return Err(Fault::stopped());
    }
    Ok((outcome, None))
}

/// A result that must be there, for somebody wants to write it; and the bytes of its own file
/// where that is what is written.
pub(crate) fn there(
    graph: &Graph,
    outcome: &Outcome,
    node: usize,
) -> Result<(AnyArtifact, Vec<u8>), Fault> {
    let found = outcome.artifact(graph, node).and_then(|artifact| {
        let raw = match out::formats(artifact.kind()) {
            [out::RAW] => outcome.bytes(node)?,
            _ => vec![],
        };
        Some((artifact, raw))
    });
    found.ok_or_else(|| {
        let name = &graph.nodes[node].name;
        Fault::stage(format!(
            "the result of `{name}` went out of the cache before it was written; run the same command again"
        ))
    })
}

fn photos_node(graph: &Graph) -> Option<usize> {
    graph
        .nodes
        .iter()
        .position(|n| n.stage.yields() == "photos")
}

/// The photos of a run, for the names of files.
pub(crate) fn photos(graph: &Graph, outcome: &Outcome) -> Photos {
    let photos = photos_node(graph)
        .and_then(|at| outcome.artifact(graph, at))
        .and_then(|a| a.downcast::<Photos>());
    photos.map_or_else(Photos::default, |p| (*p).clone())
}

/// Every stage once more; those that differ are a fault.
fn verify(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    outcome: &Outcome,
    house: &House,
) -> Result<(), Fault> {
    let told = |node: &str| {
        if !house.quiet && !house.json {
            super::errln!("{node}: once more");
        }
    };
    let options = options(house, false);
    let unsteady = verify::verify(graph, folders, outcome, &options, &CANCEL, &told);
    let lines: Vec<String> = unsteady
        .map_err(Fault::input)?
        .iter()
        .map(|u| format!("{}: {}", u.node, u.what))
        .collect();
    match lines.is_empty() {
        true if CANCEL.load(Ordering::Relaxed) => Err(Fault::stopped()),
        true => Ok(()),
        false => Err(Fault::stage(lines.join("\n"))),
    }
}

/// Does it.
pub(crate) fn run(run: &Run, house: &House) -> Result<(), Fault> {
    let ahead = ahead(&run.wanted, house);
    let (graph, wanted) = open(&run.wanted)?;
    let folders = folders(&run.wanted.change)?;
    if let Some(out) = &run.out {
        deliver::check(out, &graph, &folders)?;
    }
    let store = Store::open_after(&house.cache, ahead).map_err(Fault::input)?;
    let again: Vec<String> = std::env::args().collect();
    let wanted = match run.verify {
        true => walk::all(&graph, &wanted),
        false => wanted,
    };
    let (keep_going, again) = (run.keep_going, again.join(" "));
    let (outcome, fault) =
        execute_some(store, &graph, &folders, &wanted, house, keep_going, &again)?;
    if run.verify && fault.is_none() {
        verify(&graph, &folders, &outcome, house)?;
    }
    if let Some(out) = run.out.as_ref().filter(|_| fault.is_none() || keep_going) {
        let mut delivery = Delivery::open(out, &deliver::whose(&folders)).map_err(Fault::stage)?;
        delivery.begin().map_err(Fault::stage)?;
        deliver::write(&mut delivery, &graph, &outcome, &wanted)?;
        deliver::finish(delivery, &graph, &outcome, run.clean, house)?;
    }
    if let Some(fault) = fault {
        return Err(fault);
    }
    if house.json {
        super::outln!(
            "{}",
            serde_json::to_string_pretty(&outcome.json(&graph)).expect("bug: JSON")
        );
    }
    Ok(())
}
