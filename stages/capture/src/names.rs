//! Which of the user's files are the turn, and which is the plate, by their names.

use crate::error::CaptureError;
use crate::folder::{is_raw, is_video};
use crate::rig::RigFile;
use stage::{FileEntry, Files};
use std::path::Path;

/// The turn, in turning order, and the plate.
pub(crate) type Sorted<'a> = (Vec<&'a FileEntry>, Option<&'a FileEntry>);

/// Which files are the turn, and which is the plate: those that `images` names, in its order; else those in
/// `images/`, which goes before the folder itself.
pub(crate) fn sorted<'a>(files: &'a Files, known: &RigFile) -> Result<Sorted<'a>, CaptureError> {
    let pictures: Vec<_> = files
        .entries
        .iter()
        .filter(|e| e.name != "capture.toml")
        .collect();
    let plate = plate_of(files, known)?;
    let other = |e: &&FileEntry| Some(&e.name) != plate.map(|p| &p.name) && !is_plate(&e.name);
    if !known.images.is_empty() {
        return Ok((listed(&pictures, &known.images, other)?, plate));
    }
    let inner = |e: &FileEntry| e.name.starts_with("images/");
    let within = pictures.iter().any(|e| inner(e) && !is_plate(&e.name));
    let of_turn = |e: &&FileEntry| other(e) && inner(e) == within;
    Ok((pictures.into_iter().filter(of_turn).collect(), plate))
}

/// The photo of the empty scene: the one that is named, else the one that is called `plate`.
pub(crate) fn plate_of<'a>(
    files: &'a Files,
    known: &RigFile,
) -> Result<Option<&'a FileEntry>, CaptureError> {
    let entries = files.entries.iter();
    // Of a video, or raw, it is read where the turn is.
    let file = |e: &&FileEntry| !is_video(&e.name) && !is_raw(&e.name);
    match &known.plate {
        Some(name) => Ok(Some(named(files, name)?).filter(file)),
        None => Ok(entries.filter(file).find(|e| is_plate(&e.name))),
    }
}

/// A file's name without folders.
fn base(e: &FileEntry) -> &str {
    e.name.rsplit('/').next().unwrap_or(&e.name)
}

/// The file that is named as the plate; without its folder where no other is called so.
fn named<'a>(files: &'a Files, name: &str) -> Result<&'a FileEntry, CaptureError> {
    if let Some(found) = files.entries.iter().find(|e| e.name == name) {
        return Ok(found);
    }
    let alike = files.entries.iter().filter(|e| base(e) == name);
    let alike: Vec<&FileEntry> = alike.collect();
    if let [one] = alike[..] {
        return Ok(one);
    }
    let all: Vec<&str> = files.entries.iter().map(|e| &*e.name).collect();
    let plates = files.entries.iter().filter(|e| is_plate(&e.name));
    let mut near: Vec<&str> = alike.into_iter().chain(plates).map(|e| &*e.name).collect();
    let base = name.rsplit('/').next().unwrap_or(name);
    near.extend(stage::nearest(name, &all).or_else(|| stage::nearest(base, &all)));
    near.sort_unstable();
    near.dedup();
    let near = near.into_iter().map(str::to_owned).collect();
    Err(CaptureError::no_plate(name, near))
}

/// The files that `images` names, in its order, none twice.
fn listed<'a>(
    pictures: &[&'a FileEntry],
    images: &[String],
    other: impl Fn(&&FileEntry) -> bool,
) -> Result<Vec<&'a FileEntry>, CaptureError> {
    let mut turn: Vec<&FileEntry> = Vec::new();
    for pattern in images {
        let fit = |e: &&&FileEntry| other(e) && fits(pattern, &e.name);
        let fitting: Vec<_> = pictures.iter().filter(fit).copied().collect();
        if fitting.is_empty() {
            let first = pictures.iter().take(3).map(|e| e.name.clone());
            let first = first.collect();
            return Err(CaptureError::no_images(pattern, first, pictures.len()));
        }
        for entry in fitting {
            if !turn.iter().any(|e| e.name == entry.name) {
                turn.push(entry);
            }
        }
    }
    Ok(turn)
}

/// Whether a file is of the empty scene by its name: `plate` before its ending, letters of either case.
pub fn is_plate(name: &str) -> bool {
    let stem = Path::new(name).file_stem();
    stem.is_some_and(|s| s.to_string_lossy().to_lowercase() == "plate")
}

/// Whether a name fits a pattern, letters of either case: `*` is any run of characters within a folder,
/// `{a,b}` either.
fn fits(pattern: &str, name: &str) -> bool {
    if let (Some(open), Some(close)) = (pattern.find('{'), pattern.find('}'))
        && open < close
    {
        let (head, tail) = (&pattern[..open], &pattern[close + 1..]);
        let mut words = pattern[open + 1..close].split(',');
        return words.any(|w| fits(&format!("{head}{w}{tail}"), name));
    }
    let Some((head, rest)) = pattern.split_once('*') else {
        return pattern.eq_ignore_ascii_case(name);
    };
    let begins = name
        .get(..head.len())
        .is_some_and(|n| n.eq_ignore_ascii_case(head));
    if !begins {
        return false;
    }
    let name = &name[head.len()..];
    let run = name.find('/').unwrap_or(name.len());
    let mut ends = (0..=run).filter(|at| name.is_char_boundary(*at));
    ends.any(|at| fits(rest, &name[at..]))
}

/// Files that hold the same bytes as one before them, with that one; they go out of the turn.
pub(crate) fn twins(turn: &mut Vec<&FileEntry>) -> Vec<(String, String)> {
    let mut kept: Vec<&FileEntry> = Vec::new();
    let mut twins = Vec::new();
    for entry in turn.drain(..) {
        match kept.iter().find(|k| k.content == entry.content) {
            Some(first) => twins.push((entry.name.clone(), first.name.clone())),
            None => kept.push(entry),
        }
    }
    *turn = kept;
    twins
}

/// What photos are called: their files' names; with their folders where two would be called alike.
pub(crate) fn names(turn: &[&FileEntry]) -> Vec<String> {
    let plain: Vec<String> = turn.iter().map(|e| base(e).to_owned()).collect();
    let mut sorted = plain.clone();
    sorted.sort();
    match sorted.windows(2).any(|w| w[0] == w[1]) {
        true => turn.iter().map(|e| e.name.replace('/', "_")).collect(),
        false => plain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(names: &[&str]) -> Files {
        let entry = |name: &&str| FileEntry {
            name: (*name).into(),
            content: stage::hash(name.trim_start_matches("copy of ").as_bytes()),
            size: 1,
        };
        Files {
            root: "".into(),
            entries: names.iter().map(entry).collect(),
        }
    }

    fn turn(names: &[&str], images: &[&str]) -> Result<Vec<String>, String> {
        let known = RigFile {
            images: images.iter().map(|i| (*i).into()).collect(),
            ..RigFile::default()
        };
        let files = files(names);
        let sorted = sorted(&files, &known).map_err(|e| e.to_string())?;
        Ok(sorted.0.iter().map(|e| e.name.clone()).collect())
    }

    #[test]
    fn images_are_taken_in_their_order_and_what_is_not_there_is_refused() {
        let names = ["a1.jpg", "a2.JPG", "b/c1.png", "plate.jpg", "selfie.jpg"];
        assert_eq!(turn(&names, &["a*.jpg"]).unwrap(), ["a1.jpg", "a2.JPG"]);
        let chosen = turn(&names, &["b/*.{png,jpg}", "a2.jpg", "a*.jpg"]).unwrap();
        assert_eq!(chosen, ["b/c1.png", "a2.JPG", "a1.jpg"]);
        assert_eq!(
            turn(&names, &["*.jpg"]).unwrap(),
            ["a1.jpg", "a2.JPG", "selfie.jpg"]
        );
        let error = turn(&names, &["a*.jpg", "z*.jpg"]).unwrap_err();
        assert!(
            error.contains("z*.jpg") && error.contains("a1.jpg"),
            "{error}"
        );
    }

    #[test]
    fn a_plate_is_found_by_its_name_alone_unless_two_are_called_so() {
        let plate = |names: &[&str], named: &str| {
            let known = RigFile {
                plate: Some(named.into()),
                ..RigFile::default()
            };
            let files = files(names);
            let found = plate_of(&files, &known).map_err(|e| e.to_string())?;
            Ok::<_, String>(found.unwrap().name.clone())
        };
        let names = ["images/1.jpg", "images/empty.jpg"];
        assert_eq!(plate(&names, "empty.jpg").unwrap(), "images/empty.jpg");
        assert_eq!(
            plate(&names, "images/empty.jpg").unwrap(),
            "images/empty.jpg"
        );
        let names = ["a/empty.jpg", "b/empty.jpg", "b/1.jpg", "b/plate.jpg"];
        assert_eq!(plate(&names, "b/empty.jpg").unwrap(), "b/empty.jpg");
        let error = plate(&names, "empty.jpg").unwrap_err();
        let part = "there is a/empty.jpg, b/empty.jpg, b/plate.jpg";
        assert!(error.contains(part), "{error}");
        let error = plate(&["1.jpg", "background.jpg"], "backgruond.jpg").unwrap_err();
        assert!(error.contains("there is background.jpg"), "{error}");
        let error = plate(&["1.jpg"], "backgruond.jpg").unwrap_err();
        assert!(error.contains("no such file: correct it"), "{error}");
    }

    #[test]
    fn a_copy_goes_out_and_is_named_with_the_first() {
        let files = files(&["1.jpg", "2.jpg", "copy of 1.jpg"]);
        let mut turn: Vec<_> = files.entries.iter().collect();
        assert_eq!(twins(&mut turn), [("copy of 1.jpg".into(), "1.jpg".into())]);
        assert_eq!(turn.len(), 2);
    }
}
