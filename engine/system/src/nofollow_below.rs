//! All that is below a folder, met, opened and removed by descriptors: never through a link, whatever is put
//! in the place of what was there.

use crate::Stamp;
use crate::entries::{DEEPEST_FOLDERS, FileKind, Met, too_deep};
use rustix::fs::{
    AtFlags, Dir, FileType, Mode, OFlags, SeekFrom, Stat, fchmod, fstat, mkdirat, openat, renameat,
    seek, statat, unlinkat,
};
use rustix::io::Errno;
use std::ffi::CString;
use std::fs::File;
use std::io::{Error, ErrorKind, Result};

/// A folder that was entered.
pub type Folder = std::os::fd::OwnedFd;

/// How a folder is opened.
pub(super) const FOLDER: OFlags = OFlags::RDONLY
    .union(OFlags::DIRECTORY)
    .union(OFlags::CLOEXEC);

/// A folder that is made in another one, where nothing of the name is yet.
///
/// # Errors
///
/// Something of that name is there, or it cannot be made.
pub fn fresh(at: &Folder, name: &str) -> Result<Folder> {
    mkdirat(at, name, Mode::RWXU)?;
    Ok(openat(at, name, FOLDER | OFlags::NOFOLLOW, Mode::empty())?)
}

/// Whether two are the same folder.
pub fn same(a: &Folder, b: &Folder) -> bool {
    let of = |folder: &Folder| fstat(folder).map(|s| (s.st_dev, s.st_ino)).ok();
    of(a).is_some() && of(a) == of(b)
}

fn stamp(stat: &Stat) -> Stamp {
    let ns = |s: i128, ns: i128| s * 1_000_000_000 + ns;
    Stamp {
        size: stat.st_size as u64,
        modified_ns: ns(stat.st_mtime as i128, stat.st_mtime_nsec as i128),
        changed_ns: ns(stat.st_ctime as i128, stat.st_ctime_nsec as i128),
        inode: stat.st_ino,
    }
}

/// Meets all that is below a folder, as long as `meet` goes on; what goes away meanwhile is passed over.
///
/// # Errors
///
/// A folder cannot be looked into, or is too deep.
pub fn walk(at: &Folder, meet: &mut dyn FnMut(&Met) -> bool) -> Result<()> {
    let mut open = vec![(String::new(), Dir::read_from(at)?, at.try_clone()?)];
    while let Some((above, dir, folder)) = open.last_mut() {
        let Some(entry) = dir.next() else {
            open.pop();
            continue;
        };
        let entry = entry?;
        let raw = entry.file_name();
        if [&b"."[..], b".."].contains(&raw.to_bytes()) {
            continue;
        }
        let stat = match statat(&*folder, raw, AtFlags::SYMLINK_NOFOLLOW) {
            Err(Errno::NOENT) => continue,
            stat => stat?,
        };
        let kind = FileType::from_raw_mode(stat.st_mode);
        let met = Met {
            path: format!("{above}{}", raw.to_string_lossy()),
            named: raw.to_str().is_ok(),
            kind: match kind {
                FileType::RegularFile => Some(FileKind::File),
                FileType::Directory => Some(FileKind::Folder),
                _ => None,
            },
            link: kind == FileType::Symlink,
            stamp: stamp(&stat),
        };
        if !meet(&met) {
            return Ok(());
        }
        if kind != FileType::Directory {
            continue;
        }
        let reported = |why: Error| Error::new(why.kind(), format!("{}: {why}", met.path));
        let inner = match openat(&*folder, raw, FOLDER | OFlags::NOFOLLOW, Mode::empty()) {
            Err(Errno::NOENT | Errno::NOTDIR | Errno::LOOP) => continue,
            inner => inner.map_err(|why| reported(why.into()))?,
        };
        if open.len() > DEEPEST_FOLDERS {
            return Err(too_deep());
        }
        let dir = Dir::read_from(&inner).map_err(|why| reported(why.into()))?;
        open.push((format!("{}/", met.path), dir, inner));
    }
    Ok(())
}

/// A plain file below a folder, none of the names on the way a link. Nothing is waited for.
///
/// # Errors
///
/// It is missing, is a link or no plain file, or cannot be read.
pub fn open_file(at: &Folder, path: &str) -> Result<File> {
    let mut names = path.split('/');
    let last = names.next_back().unwrap_or_default();
    let mut folder = at.try_clone()?;
    for name in names {
        folder = openat(&folder, name, FOLDER | OFlags::NOFOLLOW, Mode::empty())?;
    }
    let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let file = File::from(openat(&folder, last, flags, Mode::empty())?);
    match file.metadata()?.is_file() {
        true => Ok(file),
        false => Err(Error::new(ErrorKind::InvalidInput, "is no plain file")),
    }
}

/// Whether less of a file is on the disk than its size promises; false where the system has no answer.
pub fn has_hole(file: &File, size: u64) -> bool {
    let hole = seek(file, SeekFrom::Hole(0));
    let back = seek(file, SeekFrom::Start(0));
    size > 0 && back.is_ok() && hole.is_ok_and(|hole| hole < size)
}

/// A folder in another one, made its owner's to use.
fn entered(at: &Folder, name: &std::ffi::CStr) -> Result<Folder> {
    let open = || openat(at, name, FOLDER | OFlags::NOFOLLOW, Mode::empty());
    let folder = match open() {
        Err(Errno::ACCESS) => {
            opened_up(at, name)?;
            open()
        }
        folder => folder,
    }?;
    let _ = fchmod(&folder, Mode::RWXU);
    Ok(folder)
}

#[cfg(target_os = "linux")]
fn opened_up(at: &Folder, name: &std::ffi::CStr) -> Result<()> {
    use std::os::fd::AsRawFd;
    use std::os::unix::fs::PermissionsExt;
    let flags = OFlags::PATH | OFlags::DIRECTORY | OFlags::NOFOLLOW | OFlags::CLOEXEC;
    let folder = openat(at, name, flags, Mode::empty())?;
    let path = format!("/proc/self/fd/{}", folder.as_raw_fd());
    std::fs::set_permissions(path, PermissionsExt::from_mode(0o700))
}

#[cfg(not(target_os = "linux"))]
fn opened_up(at: &Folder, name: &std::ffi::CStr) -> Result<()> {
    Ok(rustix::fs::chmodat(
        at,
        name,
        Mode::RWXU,
        AtFlags::SYMLINK_NOFOLLOW,
    )?)
}

fn names(at: &Folder) -> Result<Vec<CString>> {
    let mut names = Vec::new();
    for entry in Dir::read_from(at)? {
        let name = entry?.file_name().to_owned();
        if ![&b"."[..], b".."].contains(&name.to_bytes()) {
            names.push(name);
        }
    }
    Ok(names)
}

/// Removes a file, a link, a device; whether it was one.
fn unlinked(at: &Folder, name: &std::ffi::CStr) -> Result<bool> {
    match statat(at, name, AtFlags::SYMLINK_NOFOLLOW) {
        Err(Errno::NOENT) => Ok(true),
        stat if FileType::from_raw_mode(stat?.st_mode) == FileType::Directory => Ok(false),
        _ => Ok(unlinkat(at, name, AtFlags::empty()).map(|()| true)?),
    }
}

/// Removes all that is in a folder, whatever its modes and however deep: folders are moved up, one level
/// after the other, so that no depth needs more open files.
///
/// # Errors
///
/// Something in it cannot be removed.
pub fn empty(top: &Folder) -> Result<()> {
    let mut moved = 0usize;
    loop {
        let all = names(top)?;
        if all.is_empty() {
            return Ok(());
        }
        for name in all {
            if unlinked(top, &name)? {
                continue;
            }
            let inner = entered(top, &name)?;
            for below in names(&inner)? {
                if unlinked(&inner, &below)? {
                    continue;
                }
                drop(entered(&inner, &below)?);
                loop {
                    moved += 1;
                    match renameat(&inner, &below, top, format!(".removed-{moved}")) {
                        Err(Errno::NOTEMPTY | Errno::EXIST | Errno::NOTDIR) => {}
                        done => break done?,
                    }
                }
            }
            unlinkat(top, &name, AtFlags::REMOVEDIR)?;
        }
    }
}

/// Removes a folder with all that is in it; one that is not there is as good.
///
/// # Errors
///
/// Some of it cannot be removed.
pub fn remove_all(at: &Folder, name: &str) -> Result<()> {
    let name = CString::new(name).map_err(Error::other)?;
    if unlinked(at, &name)? {
        return Ok(());
    }
    empty(&entered(at, &name)?)?;
    Ok(unlinkat(at, &name, AtFlags::REMOVEDIR)?)
}
