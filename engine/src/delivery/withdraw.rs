//! A folder of results taken back: what was delivered there goes, as long as nobody changed it, and nothing else.

use super::{Delivery, DeliveryError, RUN, answer};
use serde_json::{Map, Value};
use std::io::{self, Read};
use std::path::Path;
use system::{self, FileKind, nofollow};

/// What became of a folder of results.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Withdrawn {
    /// How many files went.
    pub removed: usize,
    /// What still is there: changed since, put there by somebody else, or not removable.
    pub left: Vec<String>,
}

/// Whose the results in a folder are, if it holds some.
pub fn of(folder: &Path) -> Option<String> {
    Some(answer(folder)?.get("of")?.as_str()?.to_owned())
}

/// As [`of`].
///
/// # Errors
///
/// The disk refuses.
pub(crate) fn of_readable(folder: &Path) -> io::Result<Option<String>> {
    let mut bytes = Vec::new();
    let file = nofollow::folder(folder, &[]).and_then(|at| nofollow::open_file(&at, RUN));
    match file {
        Err(why) if nofollow::is_absent(&why) => return Ok(None),
        file => file?.read_to_end(&mut bytes)?,
    };
    let run: Option<Map<String, Value>> = serde_json::from_slice(&bytes).ok();
    Ok(run.and_then(|run| Some(run.get("of")?.as_str()?.to_owned())))
}

/// Removes what was delivered into a folder, what runs wrote down with it, and the folder itself if nothing else is in it.
/// No link is followed.
///
/// # Errors
///
/// It cannot be entered.
pub fn withdraw(folder: &Path) -> Result<Withdrawn, DeliveryError> {
    let delivery = Delivery::open(folder, "")?;
    let before = delivery.before.iter();
    let mut removed = before
        .filter(|(name, hash)| delivery.remove(name, hash))
        .count();
    let run = nofollow::folder(folder, &[]).is_ok_and(|at| nofollow::remove(&at, RUN));
    removed += usize::from(run);
    let mut left = Vec::new();
    removed += written_halfway(folder, &mut vec![]);
    rest(folder, "", &mut left);
    if left.is_empty() {
        // A folder that is a link stays, as an empty one.
        let _ = std::fs::remove_dir(folder);
    }
    Ok(Withdrawn { removed, left })
}

/// Removes what killed deliveries were writing, in a folder and below it, and folders that are empty without it; how
/// many files. Nobody else delivers now. No link is followed.
fn written_halfway(root: &Path, names: &mut Vec<String>) -> usize {
    let inner: Vec<&str> = names.iter().map(String::as_str).collect();
    let Ok(at) = nofollow::folder(root, &inner) else {
        return 0;
    };
    let mut removed = 0;
    let written = nofollow::inside(&at, FileKind::File, system::is_writing);
    for name in written.unwrap_or_default() {
        removed += usize::from(nofollow::remove(&at, &name));
    }
    let inner = nofollow::inside(&at, FileKind::Folder, |name| ![".", ".."].contains(&name));
    for name in inner.unwrap_or_default() {
        names.push(name);
        let below = written_halfway(root, names);
        let name = names.pop().expect("bug: pushed above");
        if below > 0 {
            nofollow::remove_empty(&at, &name);
        }
        removed += below;
    }
    removed
}

/// What is in a folder and below it; links are named and not entered.
fn rest(root: &Path, inner: &str, left: &mut Vec<String>) {
    let mut entries: Vec<_> = std::fs::read_dir(root.join(inner))
        .into_iter()
        .flatten()
        .flatten()
        .collect();
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let base = entry.file_name().to_string_lossy().into_owned();
        let name = match inner.is_empty() {
            true => base,
            false => format!("{inner}/{base}"),
        };
        match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            // Results of another run, as those of each capture beside the table of all.
            true if of(&entry.path()).is_some() => left.push(format!("{name}/")),
            true => {
                let count = left.len();
                rest(root, &name, left);
                if left.len() == count {
                    left.push(format!("{name}/"));
                }
            }
            false => left.push(name),
        }
    }
}
