//! The folder or the video that somebody hands over, looked at before anything runs: what of it is the turn,
//! and what cannot be read.

use super::facts::Facts;
use super::source::Source;
use super::stated::Stated;
use crate::catalog::{READ, foreign, is_photo, is_plate};
use crate::graph::Graph;
use command::Fault;
use stage::{Message, message};
use std::path::Path;
use system::pattern::{natural, stays_inside};

stage::messages! {
    TOO_FEW = "fail-few-no-mat": "{folder} has {count} photos: without a marker mat features are followed from photo to photo, which needs a full turn at steps of 30° or less; take 18 to 36 photos, or lay a mat on the disk (`tailor mat`; then give --mat), or give the step between them, such as --step 20";
    UNREADABLE = "fail-folder": "{folder}: {why}; give a folder that is there and readable";
    NO_PHOTOS = "fail-no-photos": "there are no photos in {folder} (JPEG, PNG or TIFF): copy those of the turn there, or give --recursive where they are in folders below";
    LEADS_OUT = "cli-images-lead-out": "`images` is {pattern}, which leads out of {folder}: photos must be in the folder itself or in folders below";
    NOT_PHOTOS = "cli-convert": "{folder} holds no photo that can be read ({known}). Convert what is there:{ways}";
    WAY = "cli-convert-way": "\n  {files}: ({way}){more}";
    NOT_READ = "warn-not-read": "{files}: not read; if they belong to the turn: ({way})";
}

/// The folder of a capture that holds masks.
pub(super) const MASKS: &str = "masks";

/// What was seen.
pub(super) struct Looked {
    /// What is read, and how.
    pub(super) source: Source,
    /// Patterns of files that are read, besides those of the pipeline.
    pub(super) patterns: Vec<String>,
    /// The photos of the folder, by their names within it; those that only patterns name are not among them.
    pub(super) photos: Vec<String>,
    /// A plate that is named and may be in any folder below.
    plate: Option<String>,
    /// Whether there is a photo or video of the empty scene.
    pub(super) plate_there: bool,
    /// Whether the disk's size is given.
    pub(super) disk: bool,
    /// How many tags the mat has that is known of, as it was given; empty where that was not.
    pub(super) mat: Option<String>,
    /// What follows from the folder, as if it were given.
    pub(super) more: Vec<Stated>,
    /// What the user should know.
    pub(super) warnings: Vec<Message>,
    /// Why photos are too few to be measured, if they are.
    pub(super) few: Option<Message>,
}

/// Fewer photos than this and features cannot be followed from one to the next.
const FEWEST: usize = 8;
/// Nor can they over wider steps. \[°\]
const WIDEST_DEG: f64 = 45.0;

/// Looks at a capture: a folder, or a video. Of a folder with photos and a video its `video` may be wanted.
pub(super) fn look(
    capture: &Path,
    facts: &Facts,
    recursive: bool,
    video: bool,
) -> Result<Looked, Fault> {
    if let Some(source) = Source::file(capture)? {
        return Ok(Looked {
            source,
            patterns: vec![],
            photos: vec![],
            plate: None,
            plate_there: false,
            disk: false,
            mat: mat(facts, &toml::Table::new())?,
            more: vec![],
            warnings: vec![],
            few: None,
        });
    }
    let shown = capture.display().to_string();
    let mut names = Vec::new();
    let listed = list(capture, "", &["images"], recursive, &mut names);
    listed.map_err(|why| {
        let why = why.to_string();
        Fault::coded(&message!(UNREADABLE, folder = &shown, why = why))
    })?;
    let text = std::fs::read_to_string(capture.join("capture.toml")).unwrap_or_default();
    // The stage that reads it reports what is wrong with it.
    let file: toml::Table = text.parse().unwrap_or_default();
    let source = Source::of(capture, &names, video)?;
    let mut looked = Looked {
        source,
        patterns: wanted(facts.images(), &file),
        photos: names.iter().filter(|n| is_photo(n)).cloned().collect(),
        plate: plate(facts, &file)?,
        plate_there: names.iter().any(|n| is_plate(n)) || named_plate(facts, &file)?.is_some(),
        disk: facts.disk_given(&file)?,
        mat: mat(facts, &file)?,
        more: vec![],
        warnings: vec![],
        few: None,
    };
    if let Some(out) = looked.patterns.iter().find(|p| !stays_inside(p)) {
        let why = message!(LEADS_OUT, pattern = out, folder = shown);
        return Err(Fault::coded(&why));
    }
    if !matches!(looked.source, Source::Photos(_)) {
        looked.warnings.extend(looked.source.left_out(&names));
        return Ok(looked);
    }
    let photos: Vec<&String> = names.iter().filter(|n| is_photo(n)).collect();
    looked
        .warnings
        .extend(unread(capture, &names, photos.is_empty())?);
    if photos.is_empty() && looked.patterns.is_empty() {
        return Err(Fault::coded(&message!(NO_PHOTOS, folder = shown)));
    }
    if recursive && looked.patterns.is_empty() {
        looked.patterns = below(&photos);
        let list = looked.patterns.iter().cloned().map(toml::Value::from);
        let list = toml::Value::Array(list.collect());
        looked.more.push(Stated {
            flag: "--recursive".into(),
            set: format!("photos.facts.images={list}"),
        });
    }
    if looked.patterns.is_empty() {
        looked.few = too_few(capture, facts, &file, photos.len());
    }
    Ok(looked)
}

/// Why so many photos are too few, if they are.
fn too_few(capture: &Path, facts: &Facts, file: &toml::Table, photos: usize) -> Option<Message> {
    let number = |s: &toml::Value| s.as_float().or(s.as_integer().map(|i| i as f64));
    let step = facts.step_deg().or(file.get("step_deg").and_then(number));
    let near = step.is_some_and(|s| s.abs() <= WIDEST_DEG);
    let tagged = facts.tagged() || file.contains_key("mat");
    let folder = capture.display().to_string();
    let few = (3..FEWEST).contains(&photos) && !tagged && !near;
    few.then(|| message!(TOO_FEW, folder = folder, count = photos))
}

/// What is in the folder and is not read; an error where there is nothing else.
fn unread(capture: &Path, names: &[String], nothing_else: bool) -> Result<Vec<Message>, Fault> {
    let (shown, strange) = (capture.display().to_string(), foreign(names));
    if nothing_else && !strange.is_empty() {
        let ways = strange.iter().rfold(Message::default(), |more, f| {
            let way = format!("cd {shown} && {}", f.way);
            message!(WAY, files = f.words(), way = way, more = more)
        });
        let why = message!(NOT_PHOTOS, folder = &shown, known = READ, ways = ways);
        return Err(Fault::coded(&why));
    }
    let beside = strange.iter().map(|f| {
        let (files, way) = (f.words(), format!("cd {shown} && {}", f.way));
        message!(NOT_READ, files = files, way = way)
    });
    Ok(beside.collect())
}

/// Lets the graph read what was found.
pub(super) fn widen(graph: &mut Graph, looked: &Looked) {
    let only = looked.source.only();
    let read = |name: &str| ["photos", "video", "surface"].contains(&name) && !only.is_empty();
    for input in graph.inputs.iter_mut().filter(|i| read(&i.name)) {
        input.files.retain(|pattern| !pattern.starts_with("*."));
        input.files.extend(only.iter().cloned());
    }
    if matches!(looked.source, Source::Scan(..)) {
        return;
    }
    let input = graph.inputs.iter_mut().find(|i| i.name == "photos");
    let files = &mut input.expect("bug: a pipeline without photos").files;
    // Formats that this build reads beside those that every build does.
    let photos = matches!(looked.source, Source::Photos(_));
    let more = READ
        .iter()
        .filter(|e| photos && !files.iter().any(|f| f.contains(*e)));
    let more: Vec<String> = more
        .flat_map(|e| [format!("images/*.{e}"), format!("*.{e}")])
        .collect();
    for pattern in looked.patterns.iter().chain(&looked.plate).chain(&more) {
        if !files.contains(pattern) {
            files.push(pattern.clone());
        }
    }
}

/// What `images` has: the flag, else the file.
fn wanted(stated: &[String], file: &toml::Table) -> Vec<String> {
    if !stated.is_empty() {
        return stated.to_vec();
    }
    match file.get("images") {
        Some(toml::Value::String(one)) => vec![one.clone()],
        Some(toml::Value::Array(list)) => {
            let texts = list.iter().filter_map(toml::Value::as_str);
            texts.map(str::to_owned).collect()
        }
        _ => vec![],
    }
}

/// The plate that is named, the flag before the file.
fn named_plate(facts: &Facts, file: &toml::Table) -> Result<Option<String>, Fault> {
    let stated = facts.given("plate")?;
    let stated = stated.map(|text| text.trim_matches('"').to_owned());
    let file = file.get("plate").and_then(toml::Value::as_str);
    Ok(stated.or(file.map(str::to_owned)))
}

/// How many tags the mat has, the flag before the file; empty where that is not given.
fn mat(facts: &Facts, file: &toml::Table) -> Result<Option<String>, Fault> {
    let mat = file.get("mat");
    let count = mat.and_then(|mat| mat.get("count"));
    let count = facts.given("mat.count")?.or(count.map(ToString::to_string));
    Ok((facts.tagged() || mat.is_some()).then(|| count.unwrap_or_default()))
}

/// The same where it is in a folder below and is no pattern itself.
fn plate(facts: &Facts, file: &toml::Table) -> Result<Option<String>, Fault> {
    let named = named_plate(facts, file)?;
    let below =
        |name: &String| name.contains('/') && !name.contains(['*', '?', '{', '}', '[', ']']);
    Ok(named.filter(below).filter(|name| stays_inside(name)))
}

/// A pattern for each folder that holds photos, in natural order of their paths.
fn below(photos: &[&String]) -> Vec<String> {
    let folder = |name: &&String| name.rsplit_once('/').map_or("", |(f, _)| f).to_owned();
    let mut folders: Vec<String> = photos.iter().map(folder).collect();
    folders.sort_by_key(|f| natural(f));
    folders.dedup();
    let endings = READ.join(",");
    let pattern = |folder: &String| match folder.is_empty() {
        true => format!("*.{{{endings}}}"),
        false => format!("{folder}/*.{{{endings}}}"),
    };
    folders.iter().map(pattern).collect()
}

/// Names of files in a folder and in some of those below it; hidden ones, masks and results are passed over.
fn list(
    root: &Path,
    inner: &str,
    into: &[&str],
    recursive: bool,
    names: &mut Vec<String>,
) -> std::io::Result<()> {
    for entry in std::fs::read_dir(root.join(inner))? {
        let entry = entry?;
        let Ok(base) = entry.file_name().into_string() else {
            continue;
        };
        let name = match inner.is_empty() {
            true => base.clone(),
            false => format!("{inner}/{base}"),
        };
        let is_folder = std::fs::metadata(entry.path()).is_ok_and(|m| m.is_dir());
        let skipped = base.starts_with('.') || base == MASKS;
        match is_folder {
            false => names.push(name),
            true if skipped || entry.path().join("run.json").exists() => {}
            // A link may lead back to where it is.
            true if into.contains(&base.as_str())
                || recursive && !entry.file_type()?.is_symlink() =>
            {
                list(root, &name, &[], recursive, names)?;
            }
            true => {}
        }
    }
    names.sort_by_key(|n| natural(n));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_in_folders_below_are_taken_in_the_order_of_their_paths() {
        let names = [
            "b/1.jpg",
            "a.jpg",
            "DCIM/101/2.jpg",
            "DCIM/100/9.jpg",
            "b/2.png",
        ];
        let names = names.map(str::to_owned);
        let patterns = below(&names.iter().collect::<Vec<_>>());
        let folders: Vec<&str> = patterns
            .iter()
            .map(|p| p.split("*.").next().unwrap())
            .collect();
        assert_eq!(folders, ["", "b/", "DCIM/100/", "DCIM/101/"]);
    }
}
