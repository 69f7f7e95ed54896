//! The store's own files: known by the form of their names, listed and removed without ever going
//! through a link.

use stage::Hash;
use std::fs;
use std::io::Result;
use std::path::{Path, PathBuf};
use system::{FileKind, is_numbered, nofollow};

/// The user's folder by its whole path, without links where it is there.
pub fn whole(path: &Path) -> PathBuf {
    let real = path.canonicalize().or_else(|_| std::path::absolute(path));
    real.unwrap_or_else(|_| path.to_owned())
}

/// Whether a name is of a form.
type Form = fn(&str) -> bool;

/// The store's folders, and the form of the names in each.
const FOLDERS: [(&str, Form); 16] = [
    ("cas", is_prefix),
    ("ac", is_prefix),
    ("part", is_prefix),
    ("parts", is_prefix),
    ("lease", is_lease),
    ("runs", is_run),
    ("pins", is_pin),
    ("quarantine", is_hash),
    ("captures", is_hash),
    ("delivered", is_hash),
    ("tmp", is_numbered),
    ("allowed", is_hash),
    ("plans", is_hash),
    ("shared", is_tag),
    ("waiting", is_waiting),
    ("exec", is_numbered),
];

/// The store's files beside its folders.
const FILES: [&str; 7] = [
    "format",
    "in-use",
    "index",
    "origin",
    "files.json",
    "last-run",
    "noted",
];

/// What other programs put into any folder that is empty to people: systems, version control, backups.
const HARMLESS: [&str; 4] = ["lost+found", ".gitignore", ".gitkeep", "CACHEDIR.TAG"];

fn is_hex(text: &str) -> bool {
    let lower = |b: u8| b.is_ascii_digit() || (b'a'..=b'f').contains(&b);
    !text.is_empty() && text.bytes().all(lower)
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// Whether a name may be a file's, and is nobody else's.
pub(crate) fn is_pin(name: &str) -> bool {
    let first = name
        .bytes()
        .next()
        .is_some_and(|b| b.is_ascii_alphanumeric());
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-_.".contains(&b);
    first && name.len() <= 64 && name.bytes().all(plain) && !name.starts_with("last")
}

/// A folder of a shelf: the first two digits of a hash.
fn is_prefix(name: &str) -> bool {
    name.len() == 2 && is_hex(name)
}

/// What is named by a hash.
pub(crate) fn is_hash(name: &str) -> bool {
    name.len() == 64 && is_hex(name)
}

/// The file of a lease.
pub(crate) fn is_lease(name: &str) -> bool {
    name.len() == 3 && is_hex(name)
}

/// What names a shared store.
fn is_tag(name: &str) -> bool {
    name.len() == 16 && is_hex(name)
}

/// What waits to be uploaded: a key, and to which shared store.
pub(crate) fn is_waiting(name: &str) -> bool {
    name.split_once('-')
        .is_some_and(|(key, tag)| is_hash(key) && is_tag(tag))
}

/// The record or the event log of a run.
pub(crate) fn is_run(name: &str) -> bool {
    let id = name
        .strip_suffix(".json")
        .or_else(|| name.strip_suffix(".jsonl"));
    let words = id.and_then(|id| id.split_once('-'));
    let counts = |n: &str| is_number(n) && n.parse().is_ok_and(|n: u64| n < u64::MAX / 2);
    words.is_some_and(|(n, process)| n.len() == 20 && counts(n) && is_number(process))
}

/// The file of a hash under a shelf of the store at `root`.
pub(crate) fn place(root: &Path, shelf: &str, hash: Hash) -> PathBuf {
    let hex = hash.to_hex();
    let mut path = PathBuf::with_capacity(root.as_os_str().len() + shelf.len() + 70);
    path.push(root);
    path.push(shelf);
    path.push(&hex[..2]);
    path.push(hex.as_str());
    path
}

/// The same, as a name below the store.
pub(crate) fn name(shelf: &str, hash: Hash) -> String {
    let hex = hash.to_hex();
    format!("{shelf}/{}/{hex}", &hex[..2])
}

/// A folder of the store, `None` if it has none of this name.
fn entered(root: &Path, name: &str) -> Result<Option<nofollow::Folder>> {
    there(nofollow::folder(root, &[name]))
}

fn there(at: Result<nofollow::Folder>) -> Result<Option<nofollow::Folder>> {
    match at {
        Err(why) if nofollow::is_absent(&why) => Ok(None),
        at => at.map(Some),
    }
}

/// The plain files of a folder of the store whose names fit, sorted.
///
/// # Errors
///
/// It is there and cannot be read.
pub(crate) fn files(root: &Path, name: &str, fits: impl Fn(&str) -> bool) -> Result<Vec<String>> {
    match entered(root, name)? {
        Some(at) => nofollow::all_inside(at, FileKind::File, fits),
        None => Ok(vec![]),
    }
}

/// All that is on a shelf under a hash.
///
/// # Errors
///
/// It is there and cannot be read.
pub(crate) fn shelf(root: &Path, name: &str) -> Result<Vec<Hash>> {
    let mut hashes = Vec::new();
    let Some(at) = entered(root, name)? else {
        return Ok(hashes);
    };
    for prefix in nofollow::inside(&at, FileKind::Folder, is_prefix)? {
        let Some(within) = there(nofollow::within(&at, &prefix))? else {
            continue;
        };
        let fits = |file: &str| is_hash(file) && file.starts_with(&prefix);
        let files = nofollow::all_inside(within, FileKind::File, fits)?;
        hashes.extend(files.iter().filter_map(|file| Hash::from_hex(file).ok()));
    }
    Ok(hashes)
}

/// Removes a plain file of the store; whether it was there.
pub(crate) fn remove(root: &Path, folders: &[&str], name: &str) -> bool {
    nofollow::folder(root, folders).is_ok_and(|at| nofollow::remove(&at, name))
}

/// A folder of the store that is a link: nothing is removed through it.
pub(crate) fn link(root: &Path) -> Option<PathBuf> {
    let linked = |path: &PathBuf| fs::symlink_metadata(path).is_ok_and(|m| m.is_symlink());
    let mut all = FOLDERS.iter().map(|(name, _)| root.join(name));
    all.find(linked)
}

/// Something in a folder that is in no store.
///
/// # Errors
///
/// It is there and cannot be listed.
pub(crate) fn stranger(root: &Path) -> Result<Option<PathBuf>> {
    let names = |path: &Path| match fs::read_dir(path) {
        Err(why) if nofollow::is_absent(&why) => Ok(vec![]),
        names => names?.collect::<Result<Vec<_>>>(),
    };
    for entry in names(root)? {
        let path = entry.path();
        let name = entry.file_name();
        let name = name.to_str().unwrap_or("");
        if HARMLESS.contains(&name) {
            continue;
        }
        let fits = FOLDERS.iter().find(|(folder, _)| *folder == name);
        let Some((_, fits)) = fits.filter(|_| path.is_dir()) else {
            match FILES.contains(&name) && path.is_file() {
                true => continue,
                false => return Ok(Some(path)),
            }
        };
        let strange = |entry: &fs::DirEntry| !entry.file_name().to_str().is_some_and(fits);
        if let Some(entry) = names(&path)?.iter().find(|entry| strange(entry)) {
            return Ok(Some(entry.path()));
        }
    }
    Ok(None)
}

/// The folders of the store that are there, those within shelves first, the store itself last.
///
/// # Errors
///
/// One cannot be read.
pub(crate) fn folders(root: &Path) -> Result<Vec<PathBuf>> {
    let mut all = Vec::new();
    for (name, _) in FOLDERS {
        let Some(at) = entered(root, name)? else {
            continue;
        };
        let path = root.join(name);
        let within = nofollow::all_inside(at, FileKind::Folder, is_prefix)?;
        all.extend(within.iter().map(|name| path.join(name)));
        all.push(path);
    }
    all.push(root.to_owned());
    Ok(all)
}

/// The size of all that is on a shelf. \[bytes\]
///
/// # Errors
///
/// As [`shelf`].
pub(crate) fn size(root: &Path, shelf_name: &str) -> Result<u64> {
    let size = |hash: &Hash| fs::metadata(place(root, shelf_name, *hash)).map_or(0, |m| m.len());
    Ok(shelf(root, shelf_name)?.iter().map(size).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_ours_or_not() {
        assert!(is_run("00000000000000000007-12.json") && !is_run("notes.json"));
        assert!(is_lease("0af") && !is_lease("abcd") && !is_lease("0AF"));
        assert!(is_prefix("0a") && !is_prefix("..") && !is_hash("0a"));
    }
}
