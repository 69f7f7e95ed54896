//! Folders entered, and files listed, written and removed in them, where a system cannot open a folder
//! by its parent: each name on the way is looked at first. A link that somebody puts there between the look
//! and the use is not seen; a folder that only its owner writes into has no such somebody.

use super::entries::{FileKind, writing};
use std::fs::{self, OpenOptions};
use std::io::{Error, ErrorKind, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A folder that was entered.
pub(crate) struct Folder(PathBuf);

fn entered(path: PathBuf) -> Result<PathBuf> {
    let meta = fs::symlink_metadata(&path)?;
    match meta.is_dir() && !meta.is_symlink() {
        true => Ok(path),
        false => Err(Error::from(ErrorKind::NotADirectory)),
    }
}

/// A folder below another, one name after the next, none of them a link. Where the first one lies is
/// the user's to say, by a link too.
pub(crate) fn folder(root: &Path, names: &[&str]) -> Result<Folder> {
    let mut at = root.canonicalize()?;
    for name in names {
        at = entered(at.join(name))?;
    }
    Ok(Folder(at))
}

/// As [`folder`]; what is missing below the first one is made.
pub(crate) fn made(root: &Path, names: &[&str]) -> Result<Folder> {
    let mut at = root.canonicalize()?;
    for name in names {
        at.push(name);
        match fs::create_dir(&at) {
            Err(why) if why.kind() != ErrorKind::AlreadyExists => return Err(why),
            _ => at = entered(at)?,
        }
    }
    Ok(Folder(at))
}

fn kind(path: &Path) -> Option<FileKind> {
    let kind = fs::symlink_metadata(path).ok()?.file_type();
    match (kind.is_file(), kind.is_dir()) {
        (true, _) => Some(FileKind::File),
        (_, true) => Some(FileKind::Folder),
        _ => None,
    }
}

/// What lies in a folder, is of this kind and fits by its name; sorted.
pub(crate) fn inside(at: &Folder, wanted: FileKind, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(&at.0).into_iter().flatten().flatten() {
        if let Ok(name) = entry.file_name().into_string()
            && fits(&name)
            && kind(&entry.path()) == Some(wanted)
        {
            found.push(name);
        }
    }
    found.sort_unstable();
    found
}

/// Removes a plain file; whether it was there.
pub(crate) fn remove(at: &Folder, name: &str) -> bool {
    let path = at.0.join(name);
    kind(&path) == Some(FileKind::File) && fs::remove_file(path).is_ok()
}

/// Removes a folder that is empty; whether it was there.
pub(crate) fn remove_empty(at: &Folder, name: &str) -> bool {
    fs::remove_dir(at.0.join(name)).is_ok()
}

/// The bytes of a plain file.
pub(crate) fn read(at: &Folder, name: &str) -> Option<Vec<u8>> {
    let path = at.0.join(name);
    kind(&path).filter(|kind| *kind == FileKind::File)?;
    fs::read(path).ok()
}

/// Puts a file into a folder, whole or not at all, over what is there; a link is replaced, not
/// followed. What has these bytes already is left as it is.
pub(crate) fn replace(at: &Folder, name: &str, bytes: &[u8]) -> Result<()> {
    if read(at, name).is_some_and(|there| there == bytes) {
        return Ok(());
    }
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let tmp = at.0.join(writing(COUNT.fetch_add(1, Ordering::Relaxed)));
    let mut open = OpenOptions::new();
    let mut file = open.write(true).create_new(true).open(&tmp)?;
    let written = file.write_all(bytes);
    drop(file);
    let written = written.and_then(|()| fs::rename(&tmp, at.0.join(name)));
    written.inspect_err(|_| _ = fs::remove_file(&tmp))
}

/// Whatever was written into a folder outlives a loss of power: systems without folders as files see to
/// that themselves.
pub(crate) fn sync(_folder: &Path) -> Result<()> {
    Ok(())
}
