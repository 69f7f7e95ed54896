//! What programs left whose run was killed: ended, and their folders removed.

use crate::family;
use crate::places::{ETC, READ, SHM, TAKEN, TMP, WORK, WRITE};
use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::time::Duration;
use system::{FileKind, is_alive, is_numbered, nofollow};

/// Where a store keeps the folders of programs that run.
pub(crate) const FOLDER: &str = "exec";

/// The file in each that is locked while its program may run.
pub(crate) const LOCK: &str = "lock";

/// How often it is tried to remove what a program that is just ending still writes to.
const TRIES: usize = 20;

/// Removes a folder of ours in another one (by the names that lead there), whatever modes a program gave to what it left
/// in it, and never through a link.
pub(crate) fn remove(root: &Path, above: &[&str], name: &str) {
    for _ in 0..TRIES {
        let at = nofollow::folder(root, above);
        let removed = at.and_then(|at| nofollow::remove_all(&at, name));
        match removed {
            Err(why) if why.kind() != ErrorKind::NotFound => {
                std::thread::sleep(Duration::from_millis(10));
            }
            _ => return,
        }
    }
}

/// As [`remove`], a program's folder: its lock goes last, so that who is killed meanwhile leaves what shows that nobody
/// holds it.
pub(crate) fn remove_program(root: &Path, name: &str) {
    for inner in [READ, WORK, TMP, SHM, ETC, WRITE, TAKEN] {
        remove(root, &[name], inner);
    }
    remove(root, &[], name);
}

/// The folders of programs in a store, as far as they are ours.
///
/// # Errors
///
/// They cannot be listed.
pub fn there(store: &Path) -> Result<Vec<PathBuf>> {
    let root = store.join(FOLDER);
    let names = match nofollow::folder(store, &[FOLDER]) {
        Err(why) if nofollow::is_absent(&why) => vec![],
        at => nofollow::inside(&at?, FileKind::Folder, is_numbered)?,
    };
    Ok(names.into_iter().map(|name| root.join(name)).collect())
}

/// Ends programs that outlived the process that started them, and removes their folders. Never
/// through a link: what is not a folder of ours stays.
pub fn clear(store: &Path) {
    let root = store.join(FOLDER);
    if !std::fs::symlink_metadata(&root).is_ok_and(|m| m.is_dir()) {
        return;
    }
    for entry in std::fs::read_dir(&root).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let Some(name) = name.to_str().filter(|name| is_numbered(name)) else {
            continue;
        };
        let folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        // The number of a killed process may be another's by now: the lock shows whose the folder is, and the number
        // only where the disk knows no locks, or there is none yet.
        let number = || name.split('-').next().is_none_or(is_alive);
        let locked = match File::open(entry.path().join(LOCK)).map(|file| file.try_lock()) {
            Ok(Ok(())) => false,
            Ok(Err(TryLockError::WouldBlock)) => true,
            Ok(Err(TryLockError::Error(_))) | Err(_) => number(),
        };
        if folder && !locked {
            let path = entry.path().canonicalize().unwrap_or(entry.path());
            family::end(&path, None);
            remove_program(&root, name);
        }
    }
}
