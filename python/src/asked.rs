//! What Python hands over to every verb.

use command::{Fault, GlobalArgs, Host};
use std::path::PathBuf;

/// Folders of inputs by name.
pub(crate) type Folders = Vec<(String, PathBuf)>;

/// The arguments of every verb, without a host.
pub(crate) fn global(cache: PathBuf, threads: Option<usize>) -> Result<GlobalArgs, Fault> {
    let mut global = GlobalArgs::of(tailor::program(), cache, Host::default());
    global.threads = match threads.map(std::num::NonZeroUsize::try_from) {
        None => None,
        Some(Ok(threads)) => Some(threads),
        Some(Err(_)) => {
            return Err(Fault::input(
                "threads=0: give 1 or more, or None for one per core",
            ));
        }
    };
    Ok(global)
}
