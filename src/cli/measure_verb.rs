//! `tailor measure`: from a folder of photos to girths and a report.

use super::cohort;
use super::delivered::place_of_results;
use super::measure_args::Measure;
use super::measuring::{Measured, one};
use super::provenance::called;
use super::stated::Stated;
use crate::catalog::is_photo;
use crate::delivery::Delivery;
use crate::store::Store;
use command::{Fault, GlobalArgs, whose};
use serde_json::{Value, json};
use stage::message;
use std::path::{Path, PathBuf};

stage::messages! {
    FILES = "fail-photos-one-by-one": "these are photos of one folder, each of which would be a capture: tailor measure {folder}";
    PROFILE = "cli-profile": "--profile is of one run: give one folder";
    CAME_TO_NOTHING = "cli-captures": "{some} of {all} captures came to nothing: {folders}";
    SAME_PLACE = "cli-same-place": "{one} and {other} would both be written to {place}: measure them one after the other, each with its own --out";
}

/// `tailor measure`: each folder on its own; one that fails does not stop the rest. Faults are in the reader's language.
pub(crate) fn measure(measure: &Measure, global: &GlobalArgs) -> Result<(), Fault> {
    measure.spoken.read(all(measure, global))
}

fn all(measure: &Measure, global: &GlobalArgs) -> Result<(), Fault> {
    let stated = measure.facts.stated()?;
    if measure.profile.is_some() && measure.folders.len() > 1 {
        return Err(Fault::coded(&message!(PROFILE)));
    }
    if let Some(folder) = one_folder(&measure.folders) {
        return Err(Fault::coded(&message!(FILES, folder = folder)));
    }
    let global = &GlobalArgs {
        profile: measure.profile.clone(),
        ..global.clone()
    };
    if let [capture] = measure.folders.as_slice() {
        let measured = one(measure, capture, measure.out.as_deref(), &stated, global)?;
        if global.json {
            command::outln!("{}", pretty(&answer(&measured)));
        }
        return Ok(());
    }
    many(measure, &stated, global)
}

/// The folder of which a shell handed over the photos one by one.
fn one_folder(all: &[PathBuf]) -> Option<String> {
    let first = all.first()?.parent()?;
    let photo = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        name.is_some_and(is_photo) && path.parent() == Some(first) && path.is_file()
    };
    let folder = match first.as_os_str().is_empty() {
        true => ".".to_owned(),
        false => first.display().to_string(),
    };
    (all.len() > 1 && all.iter().all(photo)).then_some(folder)
}

/// How it was made, where it is, and the girths as `girths.json` has them.
fn answer(measured: &Measured) -> Value {
    let mut run = measured.run();
    run["out"] = json!(measured.out.display().to_string());
    let girths = std::fs::read(measured.out.join("girths.json")).ok();
    let girths = girths.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    run["girths"] = girths.unwrap_or_default();
    run
}

/// Several captures: a row each, one table.
fn many(measure: &Measure, stated: &[Stated], global: &GlobalArgs) -> Result<(), Fault> {
    let places = places(measure)?;
    let (mut answers, mut rows, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for (capture, out) in measure.folders.iter().zip(&places) {
        let shown = capture.display().to_string();
        if !global.json && !global.quiet {
            command::errln!("{shown}:");
        }
        let done = one(measure, capture, Some(out), stated, global);
        match measure.spoken.read(done) {
            Ok(measured) => {
                let (out, run) = (measured.out.display().to_string(), measured.run());
                let row = cohort::Row::measured(capture, &measured);
                let reported = cohort::json(&row);
                answers.push(json!({ "folder": shown, "out": out, "row": reported, "run": run }));
                rows.push(row);
            }
            // The user asked to stop.
            Err(fault) if fault.code() == 130 => return Err(fault),
            Err(fault) => {
                if !global.json {
                    command::errln!("{shown}: {}", fault.text());
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
        let reported = rows.iter().map(cohort::json).collect::<Vec<_>>();
        let json = pretty(&json!({ "program": global.catalog().program, "captures": reported }));
        table(measure, out, global, &cohort::csv(&rows), json.into_bytes())?;
    }
    match global.json {
        true => command::outln!("{}", pretty(&answers)),
        false => command::outln!("\n{}", cohort::text(&rows)),
    }
    match failed.as_slice() {
        [] => Ok(()),
        // With JSON the answers have it.
        _ if global.json => Err(Fault::stage("")),
        folders => {
            let (some, all) = (folders.len(), places.len());
            let why = message!(CAME_TO_NOTHING, some = some, all = all, folders = folders);
            Err(Fault::coded(&why).of_stage())
        }
    }
}

/// The table of all captures, as a delivery of its own: whoever forgets one of them hears of it.
fn table(
    measure: &Measure,
    out: &Path,
    global: &GlobalArgs,
    csv: &[u8],
    json: Vec<u8>,
) -> Result<(), Fault> {
    let input = |folder: &PathBuf| ("photos".to_owned(), folder.clone());
    let folders: Vec<(String, PathBuf)> = measure.folders.iter().map(input).collect();
    let of = whose(&folders);
    let store = Store::open(&global.cache).map_err(Fault::of)?;
    store.note_delivery(out, &of, &folders);
    let mut delivery = Delivery::open(out, &of).map_err(Fault::stage)?;
    for (name, bytes) in [("cohort.csv", csv.to_vec()), ("cohort.json", json)] {
        let file = [(String::new(), bytes)];
        delivery.put(name, &file).map_err(Fault::stage)?;
    }
    let run = json!({ "program": global.catalog().program });
    delivery
        .finish(run, false)
        .map_err(Fault::stage)
        .map(|_| ())
}

fn pretty(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).expect("bug: JSON")
}

/// A folder of results for each capture, no two the same.
fn places(measure: &Measure) -> Result<Vec<PathBuf>, Fault> {
    let mut places: Vec<PathBuf> = Vec::new();
    for capture in &measure.folders {
        let (alone, name) = place_of_results(capture, None).or_else(|fault| {
            // The place is given: what is beside the folder does not matter.
            let out = measure.out.as_deref().ok_or(fault)?;
            let whole = capture.canonicalize().unwrap_or_else(|_| capture.clone());
            Ok((out.to_owned(), called(&whole)))
        })?;
        let place = match &measure.out {
            Some(out) => out.join(name),
            None => alone,
        };
        if let Some(at) = places.iter().position(|p| *p == place) {
            let shown = |path: &Path| path.display().to_string();
            let one = shown(&measure.folders[at]);
            let (other, place) = (shown(capture), shown(&place));
            let why = message!(SAME_PLACE, one = one, other = other, place = place);
            return Err(Fault::coded(&why));
        }
        places.push(place);
    }
    Ok(places)
}
