//! `--private`: a cache of a run's own, which is gone when the program ends.

use super::fault::Fault;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use system::is_alive;

/// It, and the lock that shows that it is in use.
static CACHE: Mutex<Option<(tempfile::TempDir, Option<File>)>> = Mutex::new(None);

const NAME: &str = "private-cache-";

/// Whether nobody uses one of these any more. The number in its name may be another process's by now: the lock decides,
/// and the number only where folders know no locks.
fn is_left(folder: &Path, process: &str) -> bool {
    match File::open(folder).map(|file| file.try_lock()) {
        // Made a moment ago, and locked in the next.
        Ok(Ok(())) => !is_alive(process) || folder.join("format").exists(),
        Ok(Err(TryLockError::WouldBlock)) => false,
        Ok(Err(TryLockError::Error(_))) | Err(_) => !is_alive(process),
    }
}

/// Removes what killed processes left of theirs.
pub(super) fn clear() {
    let above = std::env::temp_dir();
    for entry in std::fs::read_dir(above).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let process = name
            .to_str()
            .and_then(|n| n.strip_prefix(NAME)?.split('-').next());
        let number = |id: &&str| !id.is_empty() && id.bytes().all(|b| b.is_ascii_digit());
        let left = |id: &str| is_left(&entry.path(), id);
        let real = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if real && process.filter(number).is_some_and(left) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
}

/// Makes one, for the owner only; what killed processes left of theirs goes.
pub(super) fn cache() -> Result<PathBuf, Fault> {
    clear();
    let above = std::env::temp_dir();
    let prefix = format!("{NAME}{}-", std::process::id());
    let made = tempfile::Builder::new().prefix(&prefix).tempdir_in(&above);
    let made = made.map_err(|why| Fault::input(format!("{}: {why}", above.display())))?;
    let path = made.path().to_owned();
    let lock = File::open(&path).ok();
    let lock = lock.filter(|file| file.try_lock().is_ok());
    *CACHE.lock().expect("bug: poisoned") = Some((made, lock));
    Ok(path)
}

/// Removes it, if there is one.
pub(super) fn burn() {
    let made = CACHE.lock().map(|mut cache| cache.take());
    if let Ok(Some((made, _lock))) = made
        && let Err(why) = made.close()
    {
        crate::errln!("the private cache is not all gone: {why}");
    }
}
