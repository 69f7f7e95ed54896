//! A folder of results taken back: what was delivered there goes, as long as nobody changed it, and nothing else.

use super::{Delivery, DeliveryError, RUN, said};
use crate::system::nofollow;
use std::path::Path;

/// What became of a folder of results.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Withdrawn {
    /// How many files went.
    pub removed: usize,
    /// What still lies there: changed since, put there by somebody else, or not removable.
    pub left: Vec<String>,
}

/// Whose the results in a folder are, if it holds some.
pub fn of(folder: &Path) -> Option<String> {
    Some(said(folder)?.get("of")?.as_str()?.to_owned())
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
    rest(folder, "", &mut left);
    if left.is_empty() {
        // A folder that is a link stays, as an empty one.
        let _ = std::fs::remove_dir(folder);
    }
    Ok(Withdrawn { removed, left })
}

/// What lies in a folder and below it; links are named and not entered.
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
