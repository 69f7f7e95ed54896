//! Looking and measuring: what `tailor doctor` and `tailor measure` do, shown on pages meanwhile.

use super::app::App;
use super::home::Place;
use super::jobs::Job;
use super::progress::{Progress, Step, Teller};
use super::record::{Ended, Record};
use super::show::SHOWN;
use crate::cli::doctor::{Doctor, seen};
use crate::cli::measure_args::Measure;
use crate::cli::measuring::prepared_one;
use crate::cli::prepared::Prepared;
use crate::cli::words::arguments;
use crate::lasttime::History;
use crate::past::Of;
use crate::store::Store;
use command::Fault;
use engine::{Options, walk};
use serde_json::{Value, json};
use stage::{Message, message};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;

stage::messages! {
    BROKE_OFF = "fail-bug": "a bug: the program broke off; what is done is kept";
}

/// The words for what is known of a capture.
fn words(record: &Record) -> Vec<OsString> {
    let plate = record.plate().map(|(_, kept)| kept.file.as_str());
    // Results and report have the capture's name.
    let name = (!record.name.is_empty()).then(|| format!("--name={}", record.name));
    let words = record.facts.words(plate);
    words.into_iter().chain(name).map(OsString::from).collect()
}

/// The folder, which no word is mistaken for a flag of.
fn folder(words: &mut Vec<OsString>, place: &Place) {
    words.extend(["--".into(), place.photos().into_os_string()]);
}

/// Why something came to nothing, without what only a terminal has: names of nodes, commands, where the capture is.
fn reasons(place: &Place, fault: &Fault) -> Vec<Message> {
    let folder = place.photos().display().to_string();
    let named = |why: Message| match why.code() {
        code if code.is_empty() || code.starts_with("cli-") => {
            why.replace(&folder, "this capture").into()
        }
        _ => why,
    };
    fault.messages().into_iter().map(named).collect()
}

/// Looks at a capture; keeps and returns what was seen, or `wrong`: why nothing can be.
///
/// # Errors
///
/// The disk refuses.
pub(super) fn look(app: &App, place: &Place) -> std::io::Result<Value> {
    let _alone = app.looking.lock().unwrap_or_else(|e| e.into_inner());
    // Another tab asked meanwhile.
    if let Some(look) = place.look() {
        return Ok(look);
    }
    let record = place.record()?;
    let mut words = words(&record);
    folder(&mut words, place);
    let found = arguments::<Doctor>(words).and_then(|doctor| seen(&doctor, &app.quiet()));
    let look = match found {
        Ok((mut found, warnings)) => {
            found["warnings"] = json!(warnings);
            found
        }
        Err(fault) => json!({ "wrong": reasons(place, &fault) }),
    };
    place.keep_look(&look)?;
    Ok(look)
}

/// What a run of a capture is, before it runs.
pub(super) fn prepared(place: &Place) -> Result<Prepared, Fault> {
    let record = place.record().map_err(Fault::stage)?;
    let mut words = words(&record);
    words.push("--out".into());
    words.push(place.out().into_os_string());
    for (asked, word) in [
        (record.facts.walk, "--walk"),
        (record.facts.quick, "--variant=quick"),
        (record.facts.inches, "--unit=in"),
    ] {
        words.extend(asked.then(|| OsString::from(word)));
    }
    folder(&mut words, place);
    prepared_one(&arguments::<Measure>(words)?)
}

/// Measures a capture on a thread of its own, unless somebody does already; whether it is new.
///
/// # Errors
///
/// The capture's facts are wrong, or the disk refuses: in words, which are on its page as well.
pub(super) fn measure(app: &Arc<App>, place: &Place) -> Result<bool, Vec<Message>> {
    let (job, new) = app.jobs.begin(&place.id);
    if !new {
        return Ok(false);
    }
    let begun = || -> Result<Prepared, Fault> {
        let ready = prepared(place)?;
        let begun = Ended {
            state: "begun".into(),
            ..Ended::default()
        };
        place.keep_ended(&begun).map_err(Fault::stage)?;
        Ok(ready)
    };
    let ready = begun().map_err(|fault| {
        let why = reasons(place, &fault);
        end(place, &job, "failed", why.clone(), &None);
        why
    })?;
    let (app, place) = (Arc::clone(app), place.clone());
    std::thread::spawn(move || work(&app, &place, &job, &ready));
    Ok(true)
}

/// Runs, and records how it ended.
fn work(app: &App, place: &Place, job: &Job, ready: &Prepared) {
    let mut teller = None;
    let ran = app.jobs.alone(job, || {
        let watch = &*teller.insert(begun(app, job, ready));
        catch_unwind(AssertUnwindSafe(|| run(app, job, ready, watch)))
    });
    match ran {
        None => end(place, job, "stopped", vec![], &teller),
        Some(Err(_)) => {
            end(place, job, "failed", vec![message!(BROKE_OFF)], &teller);
        }
        Some(Ok(Err(fault))) if fault.code() == 130 => end(place, job, "stopped", vec![], &teller),
        Some(Ok(Err(fault))) => end(place, job, "failed", reasons(place, &fault), &teller),
        Some(Ok(Ok(()))) => end(place, job, "done", vec![], &teller),
    }
}

/// Tells what will run.
fn begun(app: &App, job: &Job, ready: &Prepared) -> Teller {
    let graph = &ready.graph;
    let history = History::of(&app.global.cache, Of::default());
    let needed = walk::all(graph, &ready.wanted).into_iter();
    let step = |node: usize| Step {
        node: graph.nodes[node].name.clone(),
        state: "open",
        done: 0,
        of: 0,
        seconds: 0.0,
        expected: history
            .last(&graph.nodes[node].name)
            .map(|line| line.seconds),
    };
    let steps = needed.map(step).collect();
    let warnings = ready.warnings.clone();
    let state = "running";
    job.sender.send_replace(Progress {
        state,
        steps,
        warnings,
        ..Progress::default()
    });
    let nodes = graph.nodes.iter();
    let shown = nodes.filter(|n| n.name == "photos" || SHOWN.iter().any(|(s, _)| *s == n.name));
    let shown: BTreeMap<String, &'static str> =
        shown.map(|n| (n.name.clone(), n.stage.name())).collect();
    Teller::new(job.sender.clone(), shown)
}

fn run(app: &App, job: &Job, ready: &Prepared, teller: &Teller) -> Result<(), Fault> {
    let graph = &ready.graph;
    let store = Store::open(&app.global.cache).map_err(Fault::input)?;
    let mut wanted = ready.wanted.clone();
    let beside: Vec<usize> = wanted.iter().filter_map(|at| graph.beside(*at)).collect();
    wanted.extend(beside);
    let options = Options {
        cache: app.global.cache.clone(),
        threads: app.global.threads.map(|n| n.get()),
        keep_going: false,
    };
    let folders = &ready.folders;
    let outcome = engine::run_in(
        store,
        graph,
        folders,
        &wanted,
        &options,
        teller,
        &job.cancel,
    );
    let outcome = outcome.map_err(Fault::input)?;
    let failures = outcome.failures(graph);
    if !failures.is_empty() {
        return Err(Fault::failed(&failures, ""));
    }
    if outcome.cancelled() || job.cancel.load(Ordering::Relaxed) {
        return Err(Fault::stopped());
    }
    let warnings = outcome
        .nodes
        .iter()
        .flatten()
        .flat_map(|done| done.warnings.clone());
    job.sender.send_modify(|p| p.warnings.extend(warnings));
    ready.deliver(&outcome, true, &app.quiet())
}

/// Keeps and announces how it ended.
fn end(place: &Place, job: &Job, state: &'static str, why: Vec<Message>, teller: &Option<Teller>) {
    let progress = job.sender.borrow().clone();
    let ended = Ended {
        state: state.to_owned(),
        why: why.clone(),
        warnings: progress.warnings,
        seconds: teller.as_ref().map_or(0.0, Teller::seconds),
        results: progress.pictures,
    };
    let seconds = ended.seconds;
    // A full disk must not hide how it ended from who looks.
    let kept = place.keep_ended(&ended);
    job.sender.send_modify(|p| {
        (p.state, p.seconds) = (state, seconds);
        p.why.extend(why);
        p.why.extend(kept.err().map(|e| e.to_string().into()));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_measured_is_called_as_its_owner_calls_it() {
        let name = "Anna, \"May\" --quick = 2".to_owned();
        let mut record = Record {
            name: name.clone(),
            ..Record::default()
        };
        let name_flag = format!("--name={name}");
        assert_eq!(words(&record), [OsString::from(name_flag)]);
        let mut all = words(&record);
        all.extend(["--".into(), "photos".into()]);
        assert!(arguments::<Measure>(all).is_ok());
        record.name.clear();
        assert!(words(&record).is_empty());
    }
}
