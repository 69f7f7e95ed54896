//! One capture: its pipeline, its run, its folder of results.

use super::columns::{wide, wide_err};
use super::delivered::{place_of_results, written};
use super::first::First;
use super::folder::{self, Looked};
use super::live::Live;
use super::measure_args::Measure;
use super::pipeline::{first_graphs, pipeline};
use super::prepared::Prepared;
use super::provenance::{get, sentences};
use super::screen::{Of, screen, warned};
use super::source::Source;
use super::stated::Stated;
use super::words;
use crate::graph::Graph;
use crate::photos::{photos, photos_node};
use crate::store::Store;
use crate::words::alike::as_read;
use command::{Fault, GlobalArgs, Job, Ran, check_out, execute};
use engine::Outcome;
use serde_json::Value;
use shape::{Cameras, Girths};
use stage::{Message, message};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;

stage::messages! {
    ONE = "cli-one-capture": "one capture at a time: give one folder";
}

/// Who makes a first answer while the whole is on its way: for a person who waits, and where the pipeline has
/// one that differs from the whole only in where it stops.
fn first_answer(
    measure: &Measure,
    ready: &Prepared,
    looked: &Looked,
    stated: &[Stated],
    global: &GlobalArgs,
) -> Option<Arc<First>> {
    let scan = matches!(looked.source, Source::Scan(..));
    let alone = scan
        || measure.turning
        || measure.fast
        || measure.variant.is_some()
        || global.quiet
        || global.json
        || global.host.watch.is_some();
    if alone {
        return None;
    }
    let graphs = first_graphs(measure, looked, stated)?;
    Some(Arc::new(First::new(graphs, ready, measure, global)))
}

/// A capture that was measured.
pub struct Measured {
    /// The folder with its results.
    pub out: PathBuf,
    /// The pipeline that ran.
    pub graph: Graph,
    /// What came of it.
    pub outcome: Outcome,
    /// What was seen in the capture's folder before anything ran.
    pub warnings: Vec<Message>,
}

impl Measured {
    /// How the results were made, as `run.json` has it.
    pub fn run(&self) -> Value {
        self.outcome.json(&self.graph)
    }
}

/// Measures one capture, as `tailor measure` with these arguments: a folder and flags.
///
/// # Errors
///
/// What is wrong with the arguments or with the capture, a stage that failed, or that it was stopped.
pub fn measured(arguments: &[String], global: &GlobalArgs) -> Result<Measured, Fault> {
    let measure: Measure = words::arguments(arguments.iter().map(OsString::from).collect())?;
    let [capture] = measure.folders.as_slice() else {
        return Err(Fault::coded(&message!(ONE)));
    };
    if measure.private {
        let what = "--private belongs to the command line: here, give a cache that you remove";
        return Err(Fault::input(what));
    }
    let facts = measure.facts.stated()?;
    one(&measure, capture, measure.out.as_deref(), &facts, global)
}

/// The only capture of `measure`, made ready.
///
/// # Errors
///
/// What is given of it, or the folder, is wrong.
#[cfg(feature = "serve")]
pub(crate) fn prepared_one(measure: &Measure) -> Result<Prepared, Fault> {
    let stated = measure.facts.stated()?;
    let folder = &measure.folders[0];
    let ready = prepared(measure, folder, measure.out.as_deref(), &stated)?;
    Ok(ready.0)
}

fn prepared(
    measure: &Measure,
    capture: &Path,
    out: Option<&Path>,
    stated: &[Stated],
) -> Result<(Prepared, Looked), Fault> {
    let looked = folder::look(capture, &measure.facts, measure.recursive, measure.video)?;
    let more: Vec<Stated> = stated.iter().chain(&looked.more).cloned().collect();
    let (mut graph, folders) = pipeline(measure, &looked.source, &more, None)?;
    let (out, shown) = place_of_results(capture, out)?;
    if let Some(few) = looked
        .few
        .clone()
        .filter(|_| !measure.walk && !measure.turning)
    {
        return Err(Fault::coded(&few));
    }
    folder::widen(&mut graph, &looked);
    check_out(&out, &graph, &folders)?;
    // What is written must be there, the goal or not.
    let mut wanted = graph.goal.clone();
    wanted.extend(written(&graph));
    // Files are called after the photos.
    wanted.extend(photos_node(&graph));
    let ready = Prepared {
        capture: capture.to_owned(),
        graph,
        folders,
        wanted,
        warnings: looked.warnings.clone(),
        out,
        shown,
    };
    Ok((ready, looked))
}

/// What `measure` with these words would run, for `plan` and `why`: words that are no folders are nodes.
///
/// # Errors
///
/// As [`measured`], before anything runs.
pub(crate) fn ahead(measure: &Measure) -> Result<Job, Fault> {
    let (folders, words): (Vec<&PathBuf>, Vec<&PathBuf>) =
        measure.folders.iter().partition(|word| word.exists());
    let (capture, nodes) = match (folders.as_slice(), words.as_slice()) {
        ([capture], nodes) => (*capture, nodes),
        ([], [capture, nodes @ ..]) => (*capture, nodes),
        _ => return Err(Fault::coded(&message!(ONE))),
    };
    let stated = measure.facts.stated()?;
    let (ready, _) = prepared(measure, capture, measure.out.as_deref(), &stated)?;
    let name = |word: &&PathBuf| word.to_string_lossy().into_owned();
    Ok(Job {
        graph: ready.graph,
        folders: ready.folders,
        goal: ready.wanted,
        nodes: nodes.iter().map(name).collect(),
    })
}

/// What was warned of before a run came to nothing: it may be why.
fn unended(measure: &Measure, ready: &Prepared, live: &Live, global: &GlobalArgs) {
    if global.json || global.quiet {
        return;
    }
    let all = [ready.warnings.clone(), live.warnings()].concat();
    let text = warned(measure.words(), &as_read(all), wide_err());
    if !text.is_empty() {
        command::errln!("{}", text.trim_end());
    }
}

/// Measures one capture.
pub(super) fn one(
    measure: &Measure,
    capture: &Path,
    out: Option<&Path>,
    stated: &[Stated],
    global: &GlobalArgs,
) -> Result<Measured, Fault> {
    let (ready, looked) = prepared(measure, capture, out, stated)?;
    let graph = &ready.graph;
    // Who is no command line cannot be repeated by one.
    let again: Vec<String> = match global.host.watch {
        Some(_) => vec![],
        None => std::env::args().collect(),
    };
    let store = Store::open(&global.cache).map_err(Fault::of)?;
    store.note_delivery(&ready.out, &ready.whose(), &ready.folders);
    let again = again.join(" ");
    let first = first_answer(measure, &ready, &looked, stated, global);
    let mut global = global.clone();
    if let Some(first) = &first {
        global.host.beside = Some(first.clone());
    }
    let live = Arc::new(Live::new(
        measure.words(),
        &ready.shown,
        &looked,
        first.clone(),
    ));
    if !measure.verbose {
        global.host.telling = Some(live.clone());
    }
    let global = &global;
    let outcome = execute(store, graph, &ready.folders, &ready.wanted, global, &again);
    first.inspect(|first| first.end(outcome.is_ok()));
    let outcome = outcome.inspect_err(|_| unended(measure, &ready, &live, global))?;
    ready.deliver(&outcome, measure.clean, global)?;
    if !global.json
        && let Some(girths) = get::<Girths>(graph, &outcome, "girths")
    {
        let cameras = get::<Cameras>(graph, &outcome, "cameras");
        let of = Of {
            name: &ready.shown,
            photos: photos(graph, &outcome).photos.len(),
            cameras: cameras.as_deref(),
            girths: &girths,
        };
        let mut reported = ready.warnings.clone();
        reported.extend(sentences(&Ran::of(graph, &outcome, &[]), &girths));
        let words = measure.words();
        command::out!(
            "{}{}",
            screen(words, &of, wide()),
            warned(words, &reported, wide())
        );
        let shown = |path: &Path| path.display().to_string();
        let place = |key, path: &Path| words.with(key, &[("path", shown(path).into())]);
        command::outln!("\n{}", place("screen-files", &ready.out));
        let page = ready.out.join("report.html");
        if page.exists() {
            command::outln!("{}", place("screen-report", &page));
        }
    }
    Ok(Measured {
        out: ready.out,
        graph: ready.graph,
        outcome,
        warnings: ready.warnings,
    })
}
