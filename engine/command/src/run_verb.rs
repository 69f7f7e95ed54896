//! `run`, and what every verb that runs shares.

use super::arguments::Wanted;
use super::deliver;
use super::fault::Fault;
use super::open::{folders, open, options, prefetch};
use super::profiled::profiled;
use super::program::GlobalArgs;
use super::progress::Progress;
use super::ran::Ran;
use super::telling::Steps;
use clap::Args;
use engine::Outcome;
use engine::delivery::Delivery;
use engine::graph::Graph;
use engine::lasttime::History;
use engine::past::Of;
use engine::store::Store;
use engine::walk::{Both, Watch};
use engine::{verify, walk};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// Arguments of `run`.
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
    /// Show what each node and loop took of clock, processor and memory, and write a trace of it into this file
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
}

/// Runs in a store, and turns failures into faults; `again` is the command that repeats a failed node.
///
/// # Errors
///
/// A wanted node failed, the user stopped, or inputs and store cannot be read.
pub fn execute(
    store: Store,
    graph: &Graph,
    folders: &[(String, PathBuf)],
    wanted: &[usize],
    global: &GlobalArgs,
    again: &str,
) -> Result<Outcome, Fault> {
    match execute_some(store, graph, folders, wanted, global, false, again)? {
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
    global: &GlobalArgs,
    keep_going: bool,
    again: &str,
) -> Result<(Outcome, Option<Fault>), Fault> {
    let needed = walk::needed(graph, wanted);
    let count = needed.iter().filter(|n| **n).count();
    // What it takes to write what is wanted must be there.
    let mut wanted = wanted.to_vec();
    let beside = wanted.iter().filter_map(|i| graph.beside(*i));
    let beside: Vec<usize> = beside.filter(|i| needed[*i]).collect();
    wanted.extend(beside);
    let wanted = wanted.as_slice();
    super::programs::unguarded(graph, wanted, global);
    let names = graph.nodes.iter().zip(&needed);
    let names = names.filter(|(_, needed)| **needed).map(|(n, _)| &n.name);
    let steps = global.host.telling.as_ref();
    let steps = steps.map(|telling| Steps::new(telling, names.clone()));
    let speaker = Progress::new(global.quiet || global.json, count, steps);
    if speaker.asks_for_time() {
        let history = History::of(&global.cache, Of::default());
        let seconds = |name: &str| Some(history.last(name)?.seconds);
        let expected = names.filter_map(|name| Some((name.clone(), seconds(name)?)));
        speaker.expect(expected.collect());
    }
    let options = options(global, keep_going);
    let watch: &dyn Watch = match &global.host.watch {
        Some(watch) => &**watch,
        None => &speaker,
    };
    let both = global.host.beside.as_deref().map(|b| Both(watch, b));
    let watch = both.as_ref().map_or(watch, |both| both as &dyn Watch);
    let cancel = global.host.cancel();
    let outcome = profiled(watch, global, |watch| {
        engine::run_in(store, graph, folders, wanted, &options, watch, cancel)
    })?;
    let outcome = outcome.map_err(Fault::of)?;
    let failures = outcome.failures(graph);
    if !failures.is_empty() {
        let fault = Fault::failed(&failures, again);
        return Ok((outcome, Some(fault)));
    }
    if outcome.cancelled() {
        return Err(Fault::stopped());
    }
    Ok((outcome, None))
}

/// Every stage once more; those that differ are a fault.
fn verify(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    outcome: &Outcome,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let started = |node: &str| {
        if !global.quiet && !global.json {
            crate::errln!("{node}: once more");
        }
    };
    let options = options(global, false);
    let unsteady = verify::verify(
        graph,
        folders,
        outcome,
        &options,
        global.host.cancel(),
        &started,
    );
    let lines: Vec<String> = unsteady
        .map_err(Fault::input)?
        .iter()
        .map(|u| format!("{}: {}", u.node, u.what))
        .collect();
    match lines.is_empty() {
        true if global.host.cancel().load(Ordering::Relaxed) => Err(Fault::stopped()),
        true => Ok(()),
        false => Err(Fault::stage(lines.join("\n"))),
    }
}

/// The last screen of a run: what the program shows of its results, and where they are.
fn ended(ran: &Ran<'_>, out: Option<&Path>, global: &GlobalArgs) {
    let screen = (global.program().screen)(ran);
    if let Some(screen) = &screen {
        crate::out!("{screen}");
    }
    if let Some(out) = out {
        let apart = if screen.is_some() { "\n" } else { "" };
        crate::outln!("{apart}all files: {}", out.display());
    }
}

/// Runs a pipeline and writes its results.
pub(crate) fn run(run: &Run, global: &GlobalArgs) -> Result<(), Fault> {
    let global = &GlobalArgs {
        profile: run.profile.clone(),
        ..global.clone()
    };
    let prefetch = prefetch(&run.wanted, global);
    let (graph, wanted) = open(&run.wanted, global)?;
    let folders = folders(&run.wanted.change)?;
    if let Some(out) = &run.out {
        deliver::check(out, &graph, &folders)?;
    }
    let store = Store::open_after(&global.cache, prefetch).map_err(Fault::of)?;
    if let Some(out) = &run.out {
        store.note_delivery(out, &deliver::whose(&folders), &folders);
    }
    let again: Vec<String> = std::env::args().collect();
    let wanted = match run.verify {
        true => walk::all(&graph, &wanted),
        false => wanted,
    };
    let (keep_going, again) = (run.keep_going, again.join(" "));
    let (outcome, fault) =
        execute_some(store, &graph, &folders, &wanted, global, keep_going, &again)?;
    if run.verify && fault.is_none() {
        verify(&graph, &folders, &outcome, global)?;
    }
    let ran = Ran::of(&graph, &outcome, &folders);
    let out = run.out.as_deref();
    let out = out.filter(|_| fault.is_none() || keep_going);
    if let Some(out) = out {
        let mut delivery = Delivery::open(out, &deliver::whose(&folders)).map_err(Fault::stage)?;
        delivery.begin().map_err(Fault::stage)?;
        deliver::write(&mut delivery, &outcome, &ran, &wanted, global)?;
        deliver::finish(delivery, &graph, &outcome, run.clean, global)?;
    }
    if !global.json {
        ended(&ran, out, global);
    }
    if let Some(fault) = fault {
        return Err(fault);
    }
    if global.json {
        crate::outln!(
            "{}",
            serde_json::to_string_pretty(&outcome.json(&graph)).expect("bug: JSON")
        );
    }
    Ok(())
}
