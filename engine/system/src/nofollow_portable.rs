//! Folders entered, and files listed, written and removed in them, where a system cannot open a folder
//! by its parent: each name on the way is looked at first. A link that somebody puts there between the look
//! and the use is not seen; a folder that only its owner writes into has no such somebody.

use super::entries::{DEEPEST_FOLDERS, FileKind, Met, too_deep, writing};
use crate::Stamp;
use std::fs::{self, File, OpenOptions};
use std::io::{Error, ErrorKind, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A folder that was entered.
pub struct Folder(PathBuf);

fn entered(path: PathBuf) -> Result<PathBuf> {
    let meta = fs::symlink_metadata(&path)?;
    match meta.is_dir() && !meta.is_symlink() {
        true => Ok(path),
        false => Err(Error::from(ErrorKind::NotADirectory)),
    }
}

/// A folder below another, one name after the next, none of them a link. Where the first one is the
/// user decides, by a link too.
///
/// # Errors
///
/// One is missing, is a link or no folder, or cannot be entered.
pub fn folder(root: &Path, names: &[&str]) -> Result<Folder> {
    let mut at = root.canonicalize()?;
    for name in names {
        at = entered(at.join(name))?;
    }
    Ok(Folder(at))
}

/// As [`folder`]; what is missing below the first one is made.
///
/// # Errors
///
/// One cannot be made, or is a link or no folder.
pub fn made(root: &Path, names: &[&str]) -> Result<Folder> {
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

/// What is in a folder, is of this kind and fits by its name; sorted.
///
/// # Errors
///
/// It cannot be read to its end.
pub fn inside(at: &Folder, wanted: FileKind, fits: impl Fn(&str) -> bool) -> Result<Vec<String>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(&at.0)? {
        let entry = entry?;
        if let Ok(name) = entry.file_name().into_string()
            && fits(&name)
            && kind(&entry.path()) == Some(wanted)
        {
            found.push(name);
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Whether an error means that there is no such folder, but a link or something else, or nothing.
pub fn is_absent(why: &Error) -> bool {
    [ErrorKind::NotFound, ErrorKind::NotADirectory].contains(&why.kind())
}

/// A folder in another one, no link.
///
/// # Errors
///
/// It is missing, is a link or no folder, or cannot be entered.
pub fn within(at: &Folder, name: &str) -> Result<Folder> {
    entered(at.0.join(name)).map(Folder)
}

/// As [`inside`], of a folder of which nothing else is wanted.
///
/// # Errors
///
/// As [`inside`].
pub fn all_inside(
    at: Folder,
    wanted: FileKind,
    fits: impl Fn(&str) -> bool,
) -> Result<Vec<String>> {
    inside(&at, wanted, fits)
}

/// Removes a plain file; whether it was there.
pub fn remove(at: &Folder, name: &str) -> bool {
    let path = at.0.join(name);
    kind(&path) == Some(FileKind::File) && fs::remove_file(path).is_ok()
}

/// Removes a folder that is empty; whether it was there.
pub fn remove_empty(at: &Folder, name: &str) -> bool {
    fs::remove_dir(at.0.join(name)).is_ok()
}

/// The bytes of a plain file.
pub fn read(at: &Folder, name: &str) -> Option<Vec<u8>> {
    let path = at.0.join(name);
    kind(&path).filter(|kind| *kind == FileKind::File)?;
    fs::read(path).ok()
}

/// Puts a file into a folder, whole or not at all, over what is there; a link is replaced, not
/// followed. What has these bytes already is left as it is.
///
/// # Errors
///
/// It cannot be written, or not be put in its place.
pub fn replace(at: &Folder, name: &str, bytes: &[u8]) -> Result<()> {
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
///
/// # Errors
///
/// The disk refuses.
pub fn sync(_folder: &Path) -> Result<()> {
    Ok(())
}

/// A folder that is made in another one, where nothing of the name is yet.
///
/// # Errors
///
/// Something of that name is there, or it cannot be made.
pub fn fresh(at: &Folder, name: &str) -> Result<Folder> {
    let path = at.0.join(name);
    fs::create_dir(&path)?;
    Ok(Folder(path))
}

/// Whether two are the same folder.
pub fn same(a: &Folder, b: &Folder) -> bool {
    a.0 == b.0
}

/// Meets all that is below a folder, as long as `meet` goes on; what goes away meanwhile is passed over.
///
/// # Errors
///
/// A folder cannot be looked into, or is too deep.
pub fn walk(at: &Folder, meet: &mut dyn FnMut(&Met) -> bool) -> Result<()> {
    let mut open = vec![(String::new(), at.0.clone(), 1)];
    while let Some((above, folder, deep)) = open.pop() {
        for entry in fs::read_dir(&folder)? {
            let entry = entry?;
            let Ok(meta) = fs::symlink_metadata(entry.path()) else {
                continue;
            };
            let raw = entry.file_name();
            let met = Met {
                path: format!("{above}{}", raw.to_string_lossy()),
                named: raw.to_str().is_some(),
                kind: kind(&entry.path()),
                link: meta.is_symlink(),
                stamp: Stamp::of(&meta),
            };
            if !meet(&met) {
                return Ok(());
            }
            if met.kind == Some(FileKind::Folder) {
                if deep > DEEPEST_FOLDERS {
                    return Err(too_deep());
                }
                open.push((format!("{}/", met.path), entry.path(), deep + 1));
            }
        }
    }
    Ok(())
}

/// A plain file below a folder.
///
/// # Errors
///
/// It is missing, is a link or no plain file, or cannot be read.
pub fn open_file(at: &Folder, path: &str) -> Result<File> {
    let path = at.0.join(path);
    match kind(&path) {
        Some(FileKind::File) => File::open(path),
        _ => Err(Error::new(ErrorKind::InvalidInput, "is no plain file")),
    }
}

/// Whether less of a file is on the disk than its size promises; the system is not asked.
pub fn has_hole(_file: &File, _size: u64) -> bool {
    false
}

fn writable(path: &Path) -> Result<()> {
    let mut permissions = fs::symlink_metadata(path)?.permissions();
    permissions.set_readonly(false);
    fs::set_permissions(path, permissions)
}

/// Removes all that is in a folder; what may not be written to is first made so.
///
/// # Errors
///
/// Something in it cannot be removed.
pub fn empty(top: &Folder) -> Result<()> {
    let mut below = Vec::new();
    walk(top, &mut |met| {
        below.push((met.path.clone(), met.kind));
        true
    })?;
    for (path, kind) in below.iter().rev() {
        let path = top.0.join(path);
        let _ = writable(&path);
        match kind {
            Some(FileKind::Folder) => fs::remove_dir(&path)?,
            _ => fs::remove_file(&path).or_else(|_| fs::remove_dir(&path))?,
        }
    }
    Ok(())
}

/// Removes a folder with all that is in it; one that is not there is as good.
///
/// # Errors
///
/// Some of it cannot be removed.
pub fn remove_all(at: &Folder, name: &str) -> Result<()> {
    let path = at.0.join(name);
    match kind(&path) {
        None => Ok(()),
        Some(FileKind::File) => fs::remove_file(path),
        Some(FileKind::Folder) => {
            empty(&Folder(path.clone()))?;
            fs::remove_dir(path)
        }
    }
}
