//! `tailor measure`: from a folder of photos to girths and a report.

use super::cohort;
use super::delivered::{called, place_of_results, write, written};
use super::facts::Facts;
use super::folder;
use super::provenance::get;
use super::said::{Said, opened};
use super::screen::screen;
use super::source::Source;
use crate::delivery::{self, Delivery};
use crate::graph::Graph;
use crate::photos::{photos, photos_node};
use crate::store::Store;
use clap::Args;
use engine::cli::{Fault, GlobalArgs, check_out, execute, finish, whose};
use serde_json::{Value, json};
use shape::{Cameras, Girths};
use std::path::{Path, PathBuf};

/// The folder of a capture that holds such masks.
const MASKS: &str = "masks";

/// What lengths are shown in.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
pub(super) enum Shown {
    /// Centimetres
    Cm,
    /// Inches
    In,
}

/// Arguments of `tailor measure`.
#[derive(Args)]
pub(crate) struct Measure {
    /// Folders with the photos or the video of one turn each, or videos; masks in a folder's `masks` are taken instead of own ones
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Where to write; here, the folder's name with `-out`, if not said. Of several folders each gets its own in it
    #[arg(long)]
    out: Option<PathBuf>,
    /// Remove from that folder what an earlier run wrote there and this one does not
    #[arg(long)]
    clean: bool,
    /// Keep nothing in the cache: what is made goes when the results are written
    #[arg(long)]
    pub(super) private: bool,
    /// A variant of the pipeline
    #[arg(long)]
    variant: Option<String>,
    /// Another value for a param: NODE.PARAM=VALUE
    #[arg(long)]
    set: Vec<String>,
    /// Leave the photos out of the report
    #[arg(long)]
    no_photos: bool,
    /// Make faces on the report's photos unrecognisable
    #[arg(long)]
    blur_face: bool,
    /// What the screen and the report show lengths in; files stay in centimetres
    #[arg(long, value_enum, default_value = "cm")]
    unit: Shown,
    /// The camera was walked around somebody who stood still; masks in the folder's `masks` are taken instead of own ones
    #[arg(long)]
    walk: bool,
    /// Take the photos in folders below, too, in the order of their paths
    #[arg(long)]
    recursive: bool,
    /// Take the folder's video, though there are photos, too
    #[arg(long)]
    video: bool,
    #[command(flatten)]
    facts: Facts,
}

/// `tailor measure`: each folder on its own; one that fails does not stop the others.
pub(crate) fn measure(measure: &Measure, global: &GlobalArgs) -> Result<(), Fault> {
    let said = measure.facts.said()?;
    if let [capture] = measure.folders.as_slice() {
        let run = one(measure, capture, measure.out.as_deref(), &said, global)?.run;
        if global.json {
            engine::outln!("{}", pretty(&run));
        }
        return Ok(());
    }
    many(measure, &said, global)
}

/// Several captures: a row each, one table.
fn many(measure: &Measure, said: &[Said], global: &GlobalArgs) -> Result<(), Fault> {
    let places = places(measure)?;
    let (mut answers, mut rows, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for (capture, out) in measure.folders.iter().zip(&places) {
        let shown = capture.display().to_string();
        if !global.json && !global.quiet {
            engine::errln!("{shown}:");
        }
        match one(measure, capture, Some(out), said, global) {
            Ok(Measured { out, run, row }) => {
                let out = out.display().to_string();
                let told = cohort::json(&row);
                answers.push(json!({ "folder": shown, "out": out, "row": told, "run": run }));
                rows.push(row);
            }
            // The user asked to stop.
            Err(fault) if fault.code() == 130 => return Err(fault),
            Err(fault) => {
                if !global.json {
                    engine::errln!("{shown}: {}", fault.text());
                }
                failed.push(shown.clone());
                let row = cohort::Row::failed(capture, out, &fault);
                let mut answer = fault.json();
                answer["row"] = cohort::json(&row);
                rows.push(row);
                answer["folder"] = shown.into();
                answers.push(answer);
            }
        }
    }
    if let Some(out) = &measure.out {
        let told = rows.iter().map(cohort::json).collect::<Vec<_>>();
        let json = pretty(&json!({ "program": global.catalog().program, "captures": told }));
        for (name, bytes) in [
            ("cohort.csv", cohort::csv(&rows)),
            ("cohort.json", json.into_bytes()),
        ] {
            let file = [(String::new(), bytes)];
            delivery::write(&out.join(name), &file).map_err(Fault::stage)?;
        }
    }
    match global.json {
        true => engine::outln!("{}", pretty(&answers)),
        false => engine::outln!("\n{}", cohort::text(&rows)),
    }
    match failed.as_slice() {
        [] => Ok(()),
        // With JSON the answers have said it.
        _ if global.json => Err(Fault::stage("")),
        some => Err(Fault::stage(format!(
            "{} of {} captures came to nothing: {}",
            some.len(),
            places.len(),
            some.join(", ")
        ))),
    }
}

fn pretty(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).expect("bug: JSON")
}

/// A folder of results for each capture, no two the same.
fn places(measure: &Measure) -> Result<Vec<PathBuf>, Fault> {
    let mut places: Vec<PathBuf> = Vec::new();
    for capture in &measure.folders {
        let (alone, name) = place_of_results(capture, None).or_else(|fault| {
            // Somebody says where to write: what lies beside the folder does not matter.
            let out = measure.out.as_deref().ok_or(fault)?;
            let whole = capture.canonicalize().unwrap_or_else(|_| capture.clone());
            Ok((out.to_owned(), called(&whole)))
        })?;
        let place = match &measure.out {
            Some(out) => out.join(name),
            None => alone,
        };
        if let Some(at) = places.iter().position(|p| *p == place) {
            return Err(Fault::input(format!(
                "{} and {} would both be written to {}: measure them one after the other, each with its own --out",
                measure.folders[at].display(),
                capture.display(),
                place.display()
            )));
        }
        places.push(place);
    }
    Ok(places)
}

/// The pipeline for a capture with what is said of it, and its inputs.
fn pipeline(
    measure: &Measure,
    source: &Source,
    said: &[Said],
) -> Result<(Graph, Vec<(String, PathBuf)>), Fault> {
    let mut sets = Vec::new();
    // A turn is looked at while it is read; a walk is none.
    sets.push(format!("photos.stop={}", !measure.walk));
    for (asked, set) in [
        (measure.no_photos, "report.photos=false"),
        (measure.blur_face, "report.blur_face=true"),
        (measure.unit == Shown::In, "report.unit=in"),
    ] {
        sets.extend(asked.then(|| set.to_owned()));
    }
    // What the user sets himself comes last, and wins.
    sets.extend(measure.set.iter().cloned());
    let mut folders = source.inputs();
    let masks = source.folder().join(MASKS);
    let name = match (measure.walk, masks.is_dir()) {
        (true, true) => "walk-own-masks",
        (true, false) => "walk",
        (false, true) => "own-masks",
        (false, false) => "body",
    };
    if masks.is_dir() {
        folders.push((MASKS.to_owned(), masks));
    }
    let graph = opened(name, source.over(), measure.variant.clone(), said, &sets)?;
    Ok((graph, folders))
}

/// A capture that was measured.
struct Measured {
    /// Where its results lie.
    out: PathBuf,
    /// How they were made.
    run: Value,
    row: cohort::Row,
}

/// Measures one capture.
fn one(
    measure: &Measure,
    capture: &Path,
    out: Option<&Path>,
    said: &[Said],
    global: &GlobalArgs,
) -> Result<Measured, Fault> {
    let looked = folder::look(capture, &measure.facts, measure.recursive, measure.video)?;
    let more: Vec<Said> = said.iter().chain(&looked.more).cloned().collect();
    let (mut graph, folders) = pipeline(measure, &looked.source, &more)?;
    let (out, shown) = place_of_results(capture, out)?;
    if let Some(few) = looked.few.clone().filter(|_| !measure.walk) {
        return Err(Fault::input(few));
    }
    folder::widen(&mut graph, &looked);
    check_out(&out, &graph, &folders)?;
    if !global.json && !global.quiet {
        looked.warnings.iter().for_each(|w| engine::errln!("{w}"));
    }
    let again: Vec<String> = std::env::args().collect();
    // What is written must be there, the goal or not.
    let mut wanted = graph.goal.clone();
    wanted.extend(written(&graph));
    // Files are called after the photos.
    wanted.extend(photos_node(&graph));
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let again = again.join(" ");
    let outcome = execute(store, &graph, &folders, &wanted, global, &again)?;
    let own = whose(&[("photos".to_owned(), capture.to_owned())]);
    let mut delivery = Delivery::open(&out, &own).map_err(Fault::stage)?;
    delivery.begin().map_err(Fault::stage)?;
    write(&graph, &outcome, &mut delivery)?;
    finish(delivery, &graph, &outcome, measure.clean, global)?;
    if !global.json
        && let Some(girths) = get::<Girths>(&graph, &outcome, "girths")
    {
        let cameras = get::<Cameras>(&graph, &outcome, "cameras");
        let count = photos(&graph, &outcome).photos.len();
        let inches = measure.unit == Shown::In;
        let screen = screen(&shown, count, cameras.as_deref(), &girths, inches);
        engine::out!("{screen}");
        engine::outln!("\nall files: {}", out.display());
        engine::outln!("report:    {}", out.join("report.html").display());
    }
    Ok(Measured {
        row: cohort::Row::measured(capture, &out, &graph, &outcome),
        run: outcome.json(&graph),
        out,
    })
}
