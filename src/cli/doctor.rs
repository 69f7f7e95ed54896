//! `tailor doctor`: a capture looked at before minutes are spent on it.

use super::facts::Facts;
use super::folder;
use super::provenance::get;
use super::spoken::{Spoken, reported};
use super::stated::opened;
use crate::photos::photos;
use crate::store::Store;
use crate::words::language::Words;
use crate::words::messages::read;
use clap::Args;
use command::{Fault, GlobalArgs, execute};
use serde_json::{Value, json};
use shape::{Document, People, Photos, Tags, some_photos};
use stage::Message;
use std::path::{Path, PathBuf};
use std::sync::Arc;

stage::messages! {
    /// Where [`on_the_spot`] holds.
    ON_THE_SPOT = "find-can-turning": "a person turns before a fixed camera: without a disk, give --turning --stature CM";
    HAND_OVER = "find-mat-other-mend": "hand over the file of the mat on the disk with --mat, or correct `[mat]` in capture.toml";
    NOTHING = "find-can-no-mat": "no, with this mat: see above";
    GONE = "fail-look-gone": "what was seen went out of the cache: run it again";
    /// Where --turning is given, and it does not.
    NOT_ON_THE_SPOT = "find-can-not-turning": "no: nobody turns before a fixed camera on these photos, or a disk or a mat is there";
}

/// Arguments of `tailor doctor`.
#[derive(Args)]
pub(crate) struct Doctor {
    /// The folder with the photos or the video of one turn, or the video
    folder: PathBuf,
    /// Take the photos in folders below, too, in the order of their paths
    #[arg(long)]
    recursive: bool,
    /// Take the folder's video, though there are photos, too
    #[arg(long)]
    video: bool,
    /// Somebody turned on the spot, without a disk: what can be measured so, and nothing of a disk
    #[arg(long)]
    turning: bool,
    #[command(flatten)]
    spoken: Spoken,
    #[command(flatten)]
    facts: Facts,
}

/// The warning of what stops `measure`: cameras do not come from another mat's tags.
const OTHER_MAT: &str = "warn-mat-other";

/// Findings, each with the warning that it makes superfluous.
const SAME: [(&str, &str); 1] = [("find-feet", "warn-cut-lower")];

/// What was seen.
pub(super) struct Look {
    /// What the stage found.
    pub(super) findings: Value,
    /// What nodes warned of, and what was odd about the folder.
    pub(super) warnings: Vec<Message>,
    /// The photos, with what is known of them.
    pub(super) photos: Arc<Photos>,
    /// Tags of a few of them.
    pub(super) tags: Arc<Tags>,
    /// Who is on the photos.
    people: Arc<People>,
    /// Which files are the turn, where that was given.
    pub(super) images: Vec<String>,
    /// The photos that are in the folder, by their names within it.
    pub(super) files: Vec<String>,
}

/// What the arguments ask for, seen: what the stage found, and the warnings.
///
/// # Errors
///
/// What is given of the capture, or the folder, is wrong; or nothing can be seen in it.
#[cfg(feature = "serve")]
pub(crate) fn seen(args: &Doctor, global: &GlobalArgs) -> Result<(Value, Vec<Message>), Fault> {
    let (recursive, video) = (args.recursive, args.video);
    // Nobody typed a command that could be repeated.
    let look = looked(&args.folder, &args.facts, recursive, video, global, "")?;
    Ok((look.findings, look.warnings))
}

/// Looks at a capture.
pub(super) fn look(
    capture: &Path,
    facts: &Facts,
    recursive: bool,
    video: bool,
    global: &GlobalArgs,
) -> Result<Look, Fault> {
    let again: Vec<String> = std::env::args().collect();
    looked(capture, facts, recursive, video, global, &again.join(" "))
}

/// The same; `again` is the command that repeats it, if there is one.
fn looked(
    capture: &Path,
    facts: &Facts,
    recursive: bool,
    video: bool,
    global: &GlobalArgs,
    again: &str,
) -> Result<Look, Fault> {
    let looked = folder::look(capture, facts, recursive, video)?;
    let stated = facts
        .stated()?
        .into_iter()
        .chain(looked.more.iter().cloned());
    let stated: Vec<_> = stated.collect();
    let mut graph = opened("doctor", looked.source.over(), None, &stated, &[])?;
    folder::widen(&mut graph, &looked);
    let folders = looked.source.inputs();
    let store = Store::open(&global.cache).map_err(Fault::of)?;
    let wanted: Vec<usize> = (0..graph.nodes.len()).collect();
    // What is seen is the answer; there is no progress to be watched.
    let quiet = GlobalArgs {
        quiet: true,
        ..global.clone()
    };
    let outcome = execute(store, &graph, &folders, &wanted, &quiet, again)?;
    let document = get::<Document>(&graph, &outcome, "look");
    let document = document.ok_or_else(|| Fault::coded(&stage::message!(GONE)).of_stage())?;
    let mut findings: Value = serde_json::from_slice(&document.bytes).map_err(Fault::stage)?;
    let mut warnings = looked.warnings;
    for done in outcome.nodes.iter().flatten() {
        warnings.extend(done.warnings.iter().cloned());
    }
    // What is found to stop all need not be warned of, too.
    let same = |warning: &Message, found: &Value| {
        SAME.contains(&(message(&found["what"]).code(), warning.code()))
    };
    warnings.retain(|warning| !entries(&findings).any(|found| same(warning, found)));
    if let Some(at) = warnings.iter().position(|w| w.code() == OTHER_MAT) {
        stop(&mut findings, warnings.remove(at));
    }
    Ok(Look {
        findings,
        warnings,
        photos: photos(&graph, &outcome),
        tags: get::<Tags>(&graph, &outcome, "tags").unwrap_or_default(),
        people: get::<People>(&graph, &outcome, "people").unwrap_or_default(),
        images: looked.patterns,
        files: looked.photos,
    })
}

/// Of a capture whose mat is another one nothing will come.
fn stop(findings: &mut Value, why: Message) {
    let mend = stage::message!(HAND_OVER);
    let found = json!({ "grade": GRADES[0], "what": why, "mend": mend, "photos": [] });
    let all = findings["findings"].as_array_mut();
    all.expect("bug: a look without findings").insert(0, found);
    for (_, can) in findings["can"].as_object_mut().into_iter().flatten() {
        *can = json!(stage::message!(NOTHING));
    }
}

/// Looks at a capture. One of which nothing will come ends with 1. Faults are in the reader's language.
pub(crate) fn doctor(args: &Doctor, global: &GlobalArgs) -> Result<(), Fault> {
    args.spoken.read(reported_of(args, global))
}

/// What was seen, printed.
fn reported_of(args: &Doctor, global: &GlobalArgs) -> Result<(), Fault> {
    let (recursive, video) = (args.recursive, args.video);
    let mut look = look(&args.folder, &args.facts, recursive, video, global)?;
    // Waist and hip of somebody who turns on the spot show without feet.
    let feet = |f: &Value| message(&f["what"]).code() == SAME[0].0;
    let stops = |f: &Value| f["grade"] == GRADES[0];
    let turns = on_the_spot(&look) && !entries(&look.findings).any(|f| stops(f) && !feet(f));
    let found = &mut look.findings;
    if turns || args.turning {
        let how = if turns { ON_THE_SPOT } else { NOT_ON_THE_SPOT };
        found["can"]["turning"] = json!(Message::new(&how, []));
    }
    if args.turning {
        let can = found["can"].as_object_mut().into_iter();
        can.for_each(|can| can.retain(|what, _| ["lengths", "turning"].contains(&what.as_str())));
        let all = found["findings"].as_array_mut().into_iter().flatten();
        let feet = all.filter(|f| feet(f));
        feet.for_each(|f| f["grade"] = GRADES[1].into());
    }
    let stopped = entries(&look.findings).any(stops);
    if global.json {
        let mut found = look.findings;
        found["folder"] = args.folder.display().to_string().into();
        found["warnings"] = json!(look.warnings);
        let json = serde_json::to_string_pretty(&found).expect("bug: JSON");
        command::outln!("{json}");
    } else {
        command::out!("{}", screen(args.spoken.words(), &args.folder, &look));
    }
    match stopped {
        true => Err(Fault::stage("")),
        false => Ok(()),
    }
}

/// Whether a person turns before a fixed camera, and nothing is known of a disk.
fn on_the_spot(look: &Look) -> bool {
    let rig = &look.photos.rig;
    let disk = rig.tagged() || rig.disk_diameter_mm.is_some();
    let tags = look.tags.views.values().any(|tags| !tags.is_empty());
    look.people.person && look.findings["motion"] == "turn" && !disk && !tags
}

/// What a document holds of a message: with a code, or as a sentence.
pub(crate) fn message(value: &Value) -> Message {
    serde_json::from_value(value.clone()).unwrap_or_default()
}

fn entries(found: &Value) -> impl Iterator<Item = &Value> {
    found["findings"].as_array().into_iter().flatten()
}

/// How much noise the photos have.
fn noise(words: Words, found: &Value) -> String {
    let Some(levels) = found["noise_levels"].as_f64() else {
        return words.text("doctor-noise-none");
    };
    let key = match found["noise_against"].as_str() {
        Some("plate") => "doctor-noise-plate",
        _ => "doctor-noise-neighbours",
    };
    words.with(key, &[("levels", words.number(levels, 1).into())])
}

/// How bad something is, the worst first.
pub(crate) const GRADES: [&str; 3] = ["stop", "doubt", "hint"];

/// A line for all that is odd, the worst first; warnings are doubts.
fn odd(words: Words, look: &Look) -> Vec<String> {
    let found = entries(&look.findings).map(|f| {
        let [what, mend] = ["what", "mend"].map(|key| reported(words, &message(&f[key])));
        let names = f["photos"].as_array().into_iter().flatten();
        let names: Vec<String> = names.filter_map(|n| Some(n.as_str()?.to_owned())).collect();
        let photos = some_photos(&names).map(|names| read(words, &names) + ": ");
        let text = format!("{}{what} - {mend}", photos.unwrap_or_default());
        (f["grade"].as_str().unwrap_or_default(), text)
    });
    let warned = look.warnings.iter();
    let warned = warned.map(|w| (GRADES[1], reported(words, w)));
    let mut all: Vec<(&str, String)> = found.chain(warned).collect();
    all.sort_by_key(|(grade, _)| GRADES.iter().position(|g| g == grade));
    let called = |grade: &str| words.text(&format!("doctor-{grade}"));
    let wide = GRADES.iter().map(|grade| called(grade).chars().count());
    let wide = wide.max().unwrap_or(0) + 1;
    let line = |(grade, text): (&str, String)| format!("  {:<wide$} {text}\n", called(grade));
    all.into_iter().map(line).collect()
}

/// What the photos are, in a line.
fn photographed(words: Words, found: &Value) -> String {
    let count = found["photos"].as_u64().unwrap_or(0);
    let size = format!("{}×{}", found["width"], found["height"]);
    let put = [("count", count.into()), ("size", size.into())];
    let plate = |name: &str| words.with("doctor-plate", &[("name", name.into())]);
    let facts = [
        words.with("doctor-photos", &put),
        found["camera"].as_str().unwrap_or_default().to_owned(),
        found["focal_35mm"]
            .as_f64()
            .map_or(words.text("focal-unknown"), |mm| format!("{mm:.0} mm")),
        found["plate"]
            .as_str()
            .map_or(words.text("doctor-no-plate"), plate),
    ];
    let facts: Vec<String> = facts.into_iter().filter(|fact| !fact.is_empty()).collect();
    facts.join(", ")
}

/// The answer for people.
fn screen(words: Words, folder: &Path, look: &Look) -> String {
    let found = &look.findings;
    let still = words.number(found["still_pct"].as_f64().unwrap_or(0.0), 0);
    let motion = match found["motion"].as_str() {
        Some("turn") => "doctor-stood",
        _ => "doctor-moved",
    };
    let mut stated = format!("{}: {}\n", folder.display(), photographed(words, found));
    stated += &format!(
        "{}\n{}\n",
        words.with(motion, &[("still", still.into())]),
        noise(words, found)
    );
    let lines = odd(words, look);
    if !lines.is_empty() {
        stated += &format!("\n{}\n{}", words.text("doctor-odd"), lines.concat());
    }
    stated += &format!("\n{}\n", words.text("doctor-can"));
    for (what, how) in found["can"].as_object().into_iter().flatten() {
        let what = words.text(&format!("doctor-{what}"));
        stated += &format!("  {what:<8} {}\n", reported(words, &message(how)));
    }
    stated
}
