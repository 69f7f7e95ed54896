//! Folders entered, and files listed, written and removed in them, without ever going through a link.

use super::entries::{FileKind, writing};
use rustix::fs::{
    AtFlags, CWD, Dir, FileType, Mode, OFlags, mkdirat, openat, renameat, statat, unlinkat,
};
use rustix::io::Errno;
use std::fs::File;
use std::io::{Read, Result, Write};
use std::os::fd::AsFd;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use below::FOLDER;
pub use below::{Folder, empty, fresh, has_hole, open_file, remove_all, same, walk};

#[path = "nofollow_below.rs"]
mod below;

/// A folder below another, one name after the next, none of them a link. Where the first one is the
/// user decides, by a link too.
///
/// # Errors
///
/// One is missing, is a link or no folder, or cannot be entered.
pub fn folder(root: &Path, names: &[&str]) -> Result<Folder> {
    let mut at = openat(CWD, root, FOLDER, Mode::empty())?;
    for name in names {
        at = openat(&at, *name, FOLDER | OFlags::NOFOLLOW, Mode::empty())?;
    }
    Ok(at)
}

/// As [`folder`]; what is missing below the first one is made, mode 0700.
///
/// # Errors
///
/// One cannot be made, or is a link or no folder.
pub fn made(root: &Path, names: &[&str]) -> Result<Folder> {
    let mut at = openat(CWD, root, FOLDER, Mode::empty())?;
    for name in names {
        match mkdirat(&at, *name, Mode::RWXU) {
            Ok(()) | Err(Errno::EXIST) => {}
            Err(why) => return Err(why.into()),
        }
        at = openat(&at, *name, FOLDER | OFlags::NOFOLLOW, Mode::empty())?;
    }
    Ok(at)
}

/// A folder in another one, no link.
///
/// # Errors
///
/// It is missing, is a link or no folder, or cannot be entered.
pub fn within(at: &Folder, name: &str) -> Result<Folder> {
    Ok(openat(at, name, FOLDER | OFlags::NOFOLLOW, Mode::empty())?)
}

/// What is in a folder, is of this kind and fits by its name; sorted.
///
/// # Errors
///
/// It cannot be read to its end.
pub fn inside(at: &Folder, wanted: FileKind, fits: impl Fn(&str) -> bool) -> Result<Vec<String>> {
    found(Dir::read_from(at)?, wanted, fits)
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
    found(Dir::new(at)?, wanted, fits)
}

fn found(mut dir: Dir, wanted: FileKind, fits: impl Fn(&str) -> bool) -> Result<Vec<String>> {
    let wanted = match wanted {
        FileKind::File => FileType::RegularFile,
        FileKind::Folder => FileType::Directory,
    };
    let mut found = Vec::new();
    while let Some(entry) = dir.read() {
        let entry = entry?;
        let Ok(name) = entry.file_name().to_str() else {
            continue;
        };
        let is = match entry.file_type() {
            FileType::Unknown => {
                let kind = dir.fd().ok().and_then(|at| self::kind(at, name));
                kind.unwrap_or(FileType::Unknown)
            }
            known => known,
        };
        if is == wanted && fits(name) {
            found.push(name.to_owned());
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Whether an error means that there is no such folder, but a link or something else, or nothing.
pub fn is_absent(why: &std::io::Error) -> bool {
    let none = [Errno::NOENT, Errno::NOTDIR, Errno::LOOP];
    none.iter()
        .any(|none| Some(none.raw_os_error()) == why.raw_os_error())
}

fn kind(at: impl AsFd, name: &str) -> Option<FileType> {
    let stat = statat(at, name, AtFlags::SYMLINK_NOFOLLOW).ok()?;
    Some(FileType::from_raw_mode(stat.st_mode))
}

/// Removes a plain file; whether it was there.
pub fn remove(at: &Folder, name: &str) -> bool {
    kind(at, name) == Some(FileType::RegularFile) && unlinkat(at, name, AtFlags::empty()).is_ok()
}

/// Removes a folder that is empty; whether it was there.
pub fn remove_empty(at: &Folder, name: &str) -> bool {
    unlinkat(at, name, AtFlags::REMOVEDIR).is_ok()
}

/// The bytes of a plain file.
pub fn read(at: &Folder, name: &str) -> Option<Vec<u8>> {
    kind(at, name).filter(|kind| *kind == FileType::RegularFile)?;
    let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::CLOEXEC;
    let mut file = File::from(openat(at, name, flags, Mode::empty()).ok()?);
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Puts a file into a folder, whole or not at all, over what is there; a link is replaced, not
/// followed. What has these bytes already is left as it is. Mode 0600.
///
/// # Errors
///
/// It cannot be written, or not be put in its place.
pub fn replace(at: &Folder, name: &str, bytes: &[u8]) -> Result<()> {
    let size = statat(at, name, AtFlags::SYMLINK_NOFOLLOW).map(|s| s.st_size as u64);
    if size.is_ok_and(|size| size == bytes.len() as u64)
        && read(at, name).is_some_and(|there| there == bytes)
    {
        return Ok(());
    }
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let tmp = writing(COUNT.fetch_add(1, Ordering::Relaxed));
    let flags = OFlags::WRONLY | OFlags::CREATE | OFlags::EXCL | OFlags::CLOEXEC;
    let mut file = File::from(openat(at, &tmp, flags, Mode::RUSR | Mode::WUSR)?);
    let written = file.write_all(bytes);
    let written = written.and_then(|()| Ok(renameat(at, &tmp, at, name)?));
    written.inspect_err(|_| _ = unlinkat(at, &tmp, AtFlags::empty()))
}

/// The names in a folder outlive a loss of power, once this is done.
///
/// # Errors
///
/// The disk refuses.
pub fn sync(folder: &Path) -> Result<()> {
    File::open(folder)?.sync_all()
}
