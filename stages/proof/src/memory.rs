//! Folders in memory: no test waits for a disk that has nothing to do with what it asks.

use std::path::Path;

/// What must be free there (derived: tests side by side write some 500 MB; a container's usual 64 MiB are too few). \[bytes\]
#[cfg(unix)]
const FREE: u64 = 2 << 30;

/// A new folder, in memory where the system has a place for that with enough free; otherwise where temporary files are.
///
/// # Panics
/// No folder can be made.
pub fn in_memory() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    let place = match has_space(memory) {
        true => tempfile::tempdir_in(memory),
        false => tempfile::tempdir(),
    };
    place.expect("a folder")
}

#[cfg(unix)]
fn has_space(memory: &Path) -> bool {
    let free = rustix::fs::statvfs(memory).map(|place| place.f_bavail * place.f_frsize);
    memory.is_dir() && free.is_ok_and(|free| free >= FREE)
}

#[cfg(not(unix))]
fn has_space(_: &Path) -> bool {
    false
}
