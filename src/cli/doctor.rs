//! `tailor doctor`: a capture looked at before minutes are spent on it.

use super::facts::Facts;
use super::folder;
use super::provenance::get;
use super::stated::opened;
use crate::photos::photos;
use crate::store::Store;
use clap::Args;
use command::text::count;
use command::{Fault, GlobalArgs, execute};
use serde_json::{Value, json};
use shape::{Document, People, Photos, Tags};
use stage::Message;
use std::path::{Path, PathBuf};
use std::sync::Arc;

stage::messages! {
    /// Where [`on_the_spot`] holds.
    ON_THE_SPOT = "find-can-turning": "a person turns before a fixed camera: without a disk, give --turning --stature CM";
    HAND_OVER = "find-mat-other-mend": "hand over the file of the mat on the disk with --mat, or correct `[mat]` in capture.toml";
    NOTHING = "find-can-no-mat": "no, with this mat: see above";
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
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let wanted: Vec<usize> = (0..graph.nodes.len()).collect();
    // What is seen is the answer; there is no progress to be watched.
    let quiet = GlobalArgs {
        quiet: true,
        ..global.clone()
    };
    let outcome = execute(store, &graph, &folders, &wanted, &quiet, again)?;
    let document = get::<Document>(&graph, &outcome, "look");
    let document = document
        .ok_or_else(|| Fault::stage("what was seen went out of the cache: run it again"))?;
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

/// Looks at a capture. One of which nothing will come ends with 1.
pub(crate) fn doctor(args: &Doctor, global: &GlobalArgs) -> Result<(), Fault> {
    let mut look = look(
        &args.folder,
        &args.facts,
        args.recursive,
        args.video,
        global,
    )?;
    let stopped = entries(&look.findings).any(|f| f["grade"] == "stop");
    let turns = !stopped && on_the_spot(&look);
    if turns || args.turning {
        let how = if turns { ON_THE_SPOT } else { NOT_ON_THE_SPOT };
        look.findings["can"]["turning"] = json!(Message::new(&how, []));
    }
    if let Some(can) = look.findings["can"]
        .as_object_mut()
        .filter(|_| args.turning)
    {
        can.retain(|what, _| ["lengths", "turning"].contains(&what.as_str()));
    }
    if global.json {
        let mut found = look.findings;
        found["folder"] = args.folder.display().to_string().into();
        found["warnings"] = json!(look.warnings);
        command::outln!(
            "{}",
            serde_json::to_string_pretty(&found).expect("bug: JSON")
        );
    } else {
        command::out!("{}", screen(&args.folder, &look));
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

/// Names of photos, the first few.
fn some(photos: &Value) -> String {
    let names: Vec<&str> = photos
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect();
    match names.len() {
        0 => String::new(),
        1..=5 => format!("{}: ", names.join(", ")),
        more => format!("{}, … ({more} photos): ", names[..3].join(", ")),
    }
}

/// How much noise the photos have.
fn noise(found: &Value) -> String {
    let against = match found["noise_against"].as_str() {
        Some("plate") => "photos against the plate",
        _ => "photos against their neighbours, where nothing moved",
    };
    match found["noise_levels"].as_f64() {
        Some(levels) => format!("noise: {levels:.1} grey levels ({against})\n"),
        None => "noise: not measured (no two pictures show the same)\n".into(),
    }
}

/// How bad something is, the worst first.
pub(crate) const GRADES: [&str; 3] = ["stop", "doubt", "hint"];

/// A line for all that is odd, the worst first; warnings are doubts.
fn odd(look: &Look) -> Vec<String> {
    let found = entries(&look.findings).map(|f| {
        let [what, mend] = ["what", "mend"].map(|key| message(&f[key]));
        let text = format!("{}{what} - {mend}", some(&f["photos"]));
        (f["grade"].as_str().unwrap_or_default(), text)
    });
    let warned = look.warnings.iter().map(|w| ("doubt", w.to_string()));
    let mut all: Vec<(&str, String)> = found.chain(warned).collect();
    all.sort_by_key(|(grade, _)| GRADES.iter().position(|g| g == grade));
    let line = |(grade, text): (&str, String)| format!("  {grade:<6} {text}\n");
    all.into_iter().map(line).collect()
}

/// The answer for people.
fn screen(folder: &Path, look: &Look) -> String {
    let found = &look.findings;
    let text = |key: &str| found[key].as_str().unwrap_or_default();
    let mut facts = vec![
        format!(
            "{} of {}×{} pixels",
            count(found["photos"].as_u64().unwrap_or(0) as usize, "photo"),
            found["width"],
            found["height"]
        ),
        text("camera").to_owned(),
        found["focal_35mm"]
            .as_f64()
            .map_or("focal length unknown".into(), |mm| format!("{mm:.0} mm")),
        match found["plate"].as_str() {
            Some(plate) => format!("with the empty scene ({plate})"),
            None => "no photo of the empty scene".into(),
        },
    ];
    facts.retain(|fact| !fact.is_empty());
    let mut stated = format!("{}: {}\n", folder.display(), facts.join(", "));
    stated += &match text("motion") {
        "turn" => format!(
            "the camera stood still ({:.0} % of the picture does)\n",
            found["still_pct"].as_f64().unwrap_or(0.0)
        ),
        _ => format!(
            "the camera moved ({:.0} % of the picture do not move)\n",
            found["still_pct"].as_f64().unwrap_or(0.0)
        ),
    };
    stated += &noise(found);
    let lines = odd(look);
    if !lines.is_empty() {
        stated += "\nwhat is odd\n";
        stated += &lines.concat();
    }
    stated += "\nwhat can be measured\n";
    for (what, how) in found["can"].as_object().into_iter().flatten() {
        stated += &format!("  {what:<8} {}\n", message(how));
    }
    stated
}
