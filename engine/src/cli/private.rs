//! `--private`: a cache of a run's own, which is gone when the program ends.

use super::fault::Fault;
use crate::system::is_alive;
use std::path::PathBuf;
use std::sync::Mutex;

static CACHE: Mutex<Option<tempfile::TempDir>> = Mutex::new(None);

const NAME: &str = "private-cache-";

/// Makes one, for the owner only; what killed processes left of theirs goes.
pub(super) fn cache() -> Result<PathBuf, Fault> {
    let above = std::env::temp_dir();
    for entry in std::fs::read_dir(&above).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let process = name
            .to_str()
            .and_then(|n| n.strip_prefix(NAME)?.split('-').next());
        let number = |id: &&str| !id.is_empty() && id.bytes().all(|b| b.is_ascii_digit());
        let dead = |id: &str| !is_alive(id);
        let real = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if real && process.filter(number).is_some_and(dead) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
    let prefix = format!("{NAME}{}-", std::process::id());
    let made = tempfile::Builder::new().prefix(&prefix).tempdir_in(&above);
    let made = made.map_err(|why| Fault::input(format!("{}: {why}", above.display())))?;
    let path = made.path().to_owned();
    *CACHE.lock().expect("bug: poisoned") = Some(made);
    Ok(path)
}

/// Removes it, if there is one.
pub(super) fn burn() {
    let made = CACHE.lock().map(|mut cache| cache.take());
    if let Ok(Some(made)) = made
        && let Err(why) = made.close()
    {
        crate::errln!("the private cache is not all gone: {why}");
    }
}
