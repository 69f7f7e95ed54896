//! `tailor init`: a commented `capture.toml` from what the photos show.

use super::doctor::{Look, look};
use super::facts::Facts;
use crate::catalog::{Known, ringed};
use clap::Args;
use command::{Fault, GlobalArgs};
use shape::Rig;
use stage::message;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;

stage::messages! {
    IS_FILE = "cli-init-file": "{file} is a file: give its folder, in which capture.toml will be written";
    THERE = "cli-init-there": "{file} is there already and was left as it is";
    NOT_WRITTEN = "cli-not-written": "cannot write {file}: {why}";
}

/// Arguments of `tailor init`.
#[derive(Args)]
pub(crate) struct Init {
    /// The folder with the photos of one turn
    folder: PathBuf,
    /// Take the photos in folders below, too, in the order of their paths
    #[arg(long)]
    recursive: bool,
    #[command(flatten)]
    facts: Facts,
}

/// Writes the file; one that is there is left as it is.
pub(crate) fn init(args: &Init, global: &GlobalArgs) -> Result<(), Fault> {
    if args.folder.is_file() {
        let file = args.folder.display().to_string();
        return Err(Fault::coded(&message!(IS_FILE, file = file)));
    }
    let file = args.folder.join("capture.toml");
    let shown = file.display().to_string();
    if file.exists() {
        return Err(Fault::coded(&message!(THERE, file = shown)));
    }
    let seen = look(&args.folder, &args.facts, args.recursive, false, global)?;
    let whole = args
        .folder
        .canonicalize()
        .unwrap_or_else(|_| args.folder.clone());
    let name = whole
        .file_name()
        .unwrap_or("turn".as_ref())
        .to_string_lossy();
    let text = draft(&name, &seen, &args.facts)?;
    let cannot = |why: std::io::Error| not_written(&shown, &why);
    // Never over one that came meanwhile.
    let mut new = std::fs::File::create_new(&file).map_err(cannot)?;
    new.write_all(text.as_bytes()).map_err(cannot)?;
    if global.json {
        command::outln!(
            "{}",
            serde_json::json!({ "file": shown.to_string(), "bytes": text.len() })
        );
    } else if !global.quiet {
        command::out!("{text}");
        command::outln!(
            "\nwritten to {shown}; fill in what you know, then: tailor measure {}",
            args.folder.display()
        );
    }
    Ok(())
}

/// Why a file could not be written.
pub(super) fn not_written(file: &str, why: &impl ToString) -> Fault {
    let why = why.to_string();
    Fault::coded(&message!(NOT_WRITTEN, file = file, why = why))
}

/// A key: given where its value is known, else a comment with what it may look like.
fn line(to: &mut String, key: &str, known: Option<String>, like: &str, note: &str) {
    let stated = match known {
        Some(value) => format!("{key} = {value}"),
        None => format!("# {key} = {like}"),
    };
    let _ = writeln!(to, "{stated:<32} # {note}");
}

/// A known number: given where it is, else a comment with what it may be.
fn fact(to: &mut String, key: &str, value: Option<String>) {
    seen_fact(to, key, value, None, "");
}

/// The same with what the photos show of it: what it may be, and what is before its comment.
fn seen_fact(to: &mut String, key: &str, value: Option<String>, like: Option<f64>, seen: &str) {
    let known = Known::of(key).expect("bug: a key of no known number");
    let like = number(like.unwrap_or_else(|| known.example()));
    let name = key.rsplit('.').next().unwrap_or(key);
    let note = seen.to_owned() + &known.comment();
    line(to, name, value, &like, &note);
}

/// A number as TOML has it: with a point.
fn number(x: f64) -> String {
    format!("{x:?}")
}

/// A text as TOML has it.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// The file's text.
fn draft(name: &str, seen: &Look, facts: &Facts) -> Result<String, Fault> {
    let rig = &seen.photos.rig;
    let mut to = String::from(
        "# What is known of this capture. A line that begins with # is not read: take the # away where you know.\n\
         # Every key has a flag of `tailor measure`, which wins. `tailor doctor` shows what would help.\n",
    );
    turn(&mut to, name, seen, facts)?;
    camera(&mut to, seen);
    subject(&mut to, rig, facts)?;
    mat(&mut to, seen, rig);
    Ok(to)
}

/// The photos: how many there are, which, and how far apart.
fn turn(to: &mut String, name: &str, seen: &Look, facts: &Facts) -> Result<(), Fault> {
    let rig = &seen.photos.rig;
    let count = seen.photos.photos.len();
    let name = facts.given("name")?.unwrap_or_else(|| quoted(name));
    line(to, "name", Some(name), "", "what the report calls it");
    let day = rig.date.as_deref().map(quoted);
    if let Some(day) = day.or(facts.given("date")?) {
        line(to, "date", Some(day), "", "the day of the capture");
    }
    fact(to, "views", Some(count.to_string()));
    if !seen.images.is_empty() {
        let list = toml::Value::Array(seen.images.iter().cloned().map(toml::Value::from).collect());
        let list = Some(list.to_string());
        line(to, "images", list, "", "which photos are the turn");
    }
    let even = (3600.0 / count as f64).round() / 10.0;
    let step = rig.step.map(|step| number(step.to_degrees()));
    seen_fact(to, "step_deg", step, Some(even), "");
    let plate = match facts.given("plate")? {
        Some(given) => Some(given),
        None => plate(seen).map(quoted),
    };
    let note = "the same scene without the subject";
    line(to, "plate", plate, "\"plate.jpg\"", note);
    Ok(())
}

/// Where the photo of the empty scene is. One that is no photo of the folder (of a video, raw) or shares its
/// name with another is found by its name alone.
fn plate(seen: &Look) -> Option<&str> {
    let name = seen.findings["plate"].as_str()?;
    let is = |file: &&String| file.rsplit('/').next() == Some(name);
    let mut files = seen.files.iter().filter(is);
    let first = files.next()?;
    files.next().is_none().then_some(first)
}

/// The lens.
fn camera(to: &mut String, seen: &Look) {
    let (rig, first) = (&seen.photos.rig, &seen.photos.photos[0]);
    let _ = writeln!(to, "\n[camera]");
    let device = &first.device;
    let seen = first.focal_35mm.map_or(String::new(), |mm| {
        format!("EXIF has {mm:.0} mm, {device}: needed only if that is wrong; ")
    });
    let own = rig.focal_35mm.filter(|mm| Some(*mm) != first.focal_35mm);
    let (own, like) = (own.map(number), first.focal_35mm);
    seen_fact(to, "camera.focal_35mm", own, like, &seen);
    if rig.focal_px.is_some() {
        fact(to, "camera.focal_px", rig.focal_px.map(number));
    }
    if let Some([x, y]) = rig.centre_px {
        let centre = Some(format!("[{x:?}, {y:?}]"));
        line(to, "centre_px", centre, "", "of a calibration");
    }
}

/// Who stood on the disk, and the disk.
fn subject(to: &mut String, rig: &Rig, facts: &Facts) -> Result<(), Fault> {
    let cm = |mm: f64| number(mm / 10.0);
    let _ = writeln!(to, "\n[subject]");
    fact(to, "subject.height_cm", rig.stature_mm.map(cm));
    fact(to, "subject.weight_kg", facts.personal("weight_kg")?);
    let note = "or \"male\": whose growth reference is meant";
    line(to, "sex", facts.personal("sex")?, "\"female\"", note);
    fact(to, "subject.age_years", facts.personal("age_years")?);
    if let Some(born) = facts.personal("born")? {
        line(
            to,
            "born",
            Some(born),
            "",
            "in place of an age, with `date`",
        );
    }
    let _ = writeln!(to, "\n[disk]");
    let diameter = rig.disk_diameter_mm.map(cm);
    fact(to, "disk.diameter_cm", diameter);
    Ok(())
}

/// What is known of a mat, and what photos show of one.
fn mat(to: &mut String, seen: &Look, rig: &Rig) {
    let ids = || seen.tags.views.values().flatten().map(|t| t.id);
    let tags = ids().min().zip(ids().max());
    let ring = ringed(&seen.tags);
    to.push('\n');
    match (tags, ring) {
        (Some((first, last)), Some(ring)) => {
            let _ = writeln!(
                to,
                "# The photos show marker tags {first} to {last}, {} on a ring of {:.2} times their size, as `tailor mat` lays them out.",
                ring.count, ring.ring
            );
        }
        (Some((first, last)), None) => {
            let _ = writeln!(
                to,
                "# The photos show marker tags {first} to {last} (family 36h11)."
            );
        }
        (None, _) => {
            to.push_str("# Of a marker mat on the disk (`tailor mat` prints one; none was seen):\n")
        }
    }
    let known = rig.mat.map(|m| m.tag_mm).or(rig.tag_mm);
    to.push_str(if known.is_some() {
        "[mat]\n"
    } else {
        "# [mat]\n"
    });
    fact(to, "mat.tag_size_mm", known.map(number));
    if let Some(mat) = rig.mat {
        let ids = format!("[{}, {}]", mat.first_id, mat.first_id + mat.count - 1);
        line(to, "ids", Some(ids), "", "first and last number");
        line(
            to,
            "count",
            Some(mat.count.to_string()),
            "",
            "how many tags",
        );
        fact(to, "mat.ring_radius_mm", Some(number(mat.ring_mm)));
    }
    if let Some(rim) = rig.rim {
        let last = rim.first_id + rim.count - 1;
        to.push_str("\n[rim]\n");
        fact(to, "rim.tag_size_mm", Some(number(rim.tag_mm)));
        let ids = format!("[{}, {last}]", rim.first_id);
        line(to, "ids", Some(ids), "", "first and last number");
        fact(to, "rim.radius_mm", Some(number(rim.radius_mm)));
    }
    if let Some(known) = &rig.reference {
        let kind = quoted(known.kind.as_str());
        let _ = writeln!(
            to,
            "\n[reference]\nkind = {kind}\nlength_mm = {:?}",
            known.length_mm
        );
        for ends in &known.seen {
            let photo = quoted(ends.photo.as_str());
            let _ = writeln!(to, "seen.{photo} = {:?}", ends.px.as_flattened());
        }
    }
}
