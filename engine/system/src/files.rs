//! Files and folders for the owner only, and what the system knows of a file.
//!
//! Where a system has no modes, what is made has the rights of the folder that it is in: those of the
//! user's own profile, as a rule.

use std::fs::{DirBuilder, File, Metadata, OpenOptions};
use std::io::Result;
use std::path::Path;

/// Makes a folder for the owner only; with all above it if asked to.
///
/// # Errors
///
/// It cannot be made, or its rights not be set.
pub fn private_folder(path: &Path, with_above: bool) -> Result<()> {
    let mut builder = DirBuilder::new();
    system::for_owner(builder.recursive(with_above));
    builder.create(path)
}

/// Has a file be made for the owner only.
pub fn private_file(open: &mut OpenOptions) -> &mut OpenOptions {
    system::file_for_owner(open)
}

/// What a file may be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Its owner reads it.
    Read,
    /// Its owner reads and starts it.
    Start,
}

/// Has the owner, and nobody else, use a file.
///
/// # Errors
///
/// Its rights cannot be set.
pub fn permit(path: &Path, what: Use) -> Result<()> {
    system::permit(path, what)
}

/// Whether its owner may start a file; everything may be where the system has no modes.
pub fn can_start(meta: &Metadata) -> bool {
    system::can_start(meta)
}

/// Whether it is the user's own, no link, and nobody else may write to it.
pub fn is_mine(path: &Path) -> bool {
    std::fs::symlink_metadata(path).is_ok_and(|m| !m.is_symlink() && system::is_mine(&m))
}

/// The numbers of the user and the group of this process; 0 where there are none.
pub fn user() -> (u32, u32) {
    system::user()
}

/// Whether nobody but its owner may read a file, as far as the system has modes.
pub fn is_private(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|m| system::is_private(&m))
}

/// Makes the folders of a file in a folder that machines share: for their owner, and for those who may write into that
/// folder.
pub fn shared_folders(folder: &Path, name: &str) {
    let mut at = folder.to_owned();
    let names: Vec<&str> = name.split('/').collect();
    for name in &names[..names.len() - 1] {
        at.push(name);
        if private_folder(&at, false).is_ok() {
            system::share(&at, folder, true);
        }
    }
}

/// Has a file in a folder that machines share be its owner's, and of those who may write into that folder.
pub fn shared_file(folder: &Path, name: &str) {
    system::share(&folder.join(name), folder, false);
}

/// Whether a folder can be entered and written into.
///
/// # Errors
///
/// They may not, or it is not there.
pub fn may_write(folder: &Path) -> Result<()> {
    system::may_write(folder)
}

/// Fills a buffer from a place in a file.
///
/// # Errors
///
/// The file ends before, or cannot be read.
pub fn read_exact_at(file: &File, buffer: &mut [u8], start: u64) -> Result<()> {
    system::read_exact_at(file, buffer, start)
}

/// By what it is seen that a file is another one than before. \[bytes, ns, ns, 1\]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// Its size.
    pub size: u64,
    /// When it was written.
    pub modified_ns: i128,
    /// When anything about it was changed; when it was written where the system keeps nothing else.
    pub changed_ns: i128,
    /// Its number on its disk; 0 where the system gives none.
    pub inode: u64,
}

impl Stamp {
    /// Of a file.
    pub fn of(meta: &Metadata) -> Stamp {
        system::stamp(meta)
    }
}

#[cfg(unix)]
mod system {
    use super::{Stamp, Use};
    use std::fs::{DirBuilder, File, Metadata, OpenOptions, Permissions};
    use std::io::Result;
    use std::os::unix::fs::{DirBuilderExt, FileExt, MetadataExt, OpenOptionsExt, PermissionsExt};
    use std::path::Path;

    pub(super) fn for_owner(builder: &mut DirBuilder) {
        builder.mode(0o700);
    }

    pub(super) fn file_for_owner(open: &mut OpenOptions) -> &mut OpenOptions {
        open.mode(0o600)
    }

    pub(super) fn permit(path: &Path, what: Use) -> Result<()> {
        let mode = match what {
            Use::Read => 0o400,
            Use::Start => 0o500,
        };
        std::fs::set_permissions(path, Permissions::from_mode(mode))
    }

    pub(super) fn can_start(meta: &Metadata) -> bool {
        meta.mode() & 0o111 != 0
    }

    pub(super) fn user() -> (u32, u32) {
        let (user, group) = (rustix::process::geteuid(), rustix::process::getegid());
        (user.as_raw(), group.as_raw())
    }

    pub(super) fn is_mine(meta: &Metadata) -> bool {
        meta.uid() == rustix::process::geteuid().as_raw() && meta.mode() & 0o022 == 0
    }

    pub(super) fn is_private(meta: &Metadata) -> bool {
        meta.mode() & 0o077 == 0
    }

    pub(super) fn share(path: &Path, like: &Path, folder: bool) {
        let above = std::fs::metadata(like).map_or(0, |meta| meta.mode());
        let group = if above & 0o020 != 0 { 0o060 } else { 0 };
        let all = if above & 0o002 != 0 { 0o006 } else { 0 };
        let mode = 0o600 | group | all;
        let enter = if folder { (mode & 0o222) >> 1 } else { 0 };
        let _ = std::fs::set_permissions(path, Permissions::from_mode(mode | enter));
    }

    pub(super) fn may_write(folder: &Path) -> Result<()> {
        let wanted = rustix::fs::Access::WRITE_OK | rustix::fs::Access::EXEC_OK;
        Ok(rustix::fs::access(folder, wanted)?)
    }

    pub(super) fn read_exact_at(file: &File, buffer: &mut [u8], start: u64) -> Result<()> {
        file.read_exact_at(buffer, start)
    }

    pub(super) fn stamp(meta: &Metadata) -> Stamp {
        let ns = |s: i64, ns: i64| i128::from(s) * 1_000_000_000 + i128::from(ns);
        Stamp {
            size: meta.size(),
            modified_ns: ns(meta.mtime(), meta.mtime_nsec()),
            changed_ns: ns(meta.ctime(), meta.ctime_nsec()),
            inode: meta.ino(),
        }
    }
}

#[cfg(not(unix))]
mod system {
    use super::{Stamp, Use};
    use std::fs::{DirBuilder, File, Metadata, OpenOptions};
    use std::io::{Error, ErrorKind, Read, Result, Seek, SeekFrom};
    use std::path::Path;
    use std::time::UNIX_EPOCH;

    pub(super) fn for_owner(_builder: &mut DirBuilder) {}

    pub(super) fn file_for_owner(open: &mut OpenOptions) -> &mut OpenOptions {
        open
    }

    pub(super) fn permit(path: &Path, _what: Use) -> Result<()> {
        let mut permissions = std::fs::metadata(path)?.permissions();
        permissions.set_readonly(true);
        std::fs::set_permissions(path, permissions)
    }

    pub(super) fn can_start(_meta: &Metadata) -> bool {
        true
    }

    pub(super) fn user() -> (u32, u32) {
        (0, 0)
    }

    pub(super) fn is_mine(_meta: &Metadata) -> bool {
        true
    }

    pub(super) fn is_private(_meta: &Metadata) -> bool {
        true
    }

    pub(super) fn share(_path: &Path, _like: &Path, _folder: bool) {}

    pub(super) fn may_write(folder: &Path) -> Result<()> {
        match std::fs::metadata(folder)?.permissions().readonly() {
            true => Err(Error::from(ErrorKind::PermissionDenied)),
            false => Ok(()),
        }
    }

    pub(super) fn read_exact_at(file: &File, buffer: &mut [u8], start: u64) -> Result<()> {
        let mut file = file;
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(buffer)
    }

    pub(super) fn stamp(meta: &Metadata) -> Stamp {
        let modified = meta.modified().ok();
        let since = modified.and_then(|at| at.duration_since(UNIX_EPOCH).ok());
        let modified_ns = since.map_or(0, |since| since.as_nanos() as i128);
        Stamp {
            size: meta.len(),
            modified_ns,
            changed_ns: modified_ns,
            inode: 0,
        }
    }
}
