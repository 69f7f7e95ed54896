//! What the user allowed: remembered by content in a folder of the user's own, outside of every cache and of all
//! that is downloaded. A program that was not allowed does not run, nor does its identity.

use super::listing::{self, programs};
use crate::graph::Graph;
use crate::store::Store;
use programs::{Program, leftover};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use system::{is_mine, nofollow, private_folder, user_state};

/// Where permissions are kept, below the folder of the program whose stages run.
const FOLDER: &str = "allowed";

/// Where else a host keeps them.
static ELSEWHERE: Mutex<Option<PathBuf>> = Mutex::new(None);

/// A permission that cannot be kept.
#[derive(Debug, thiserror::Error)]
pub enum PermitError {
    /// Nobody knows where the user's folder is.
    #[error("there is no folder to remember permissions in: set XDG_STATE_HOME or HOME")]
    Nowhere,
    /// The disk refuses, or other users may write there.
    #[error("permissions cannot be kept in {}: {why}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
}

/// Has this process keep permissions below a folder, and not below the user's.
pub fn keep_permissions_in(folder: PathBuf) {
    *ELSEWHERE.lock().expect("bug: poisoned") = Some(folder);
}

#[cfg(test)]
thread_local! {
    /// Where this thread keeps them, in a simulation.
    static HERE: std::cell::RefCell<Option<PathBuf>> = const { std::cell::RefCell::new(None) };
}

/// Has this thread keep permissions below a folder.
#[cfg(test)]
pub(crate) fn permissions_here(folder: Option<PathBuf>) {
    HERE.set(folder);
}

/// Where else than in the user's own folder they are kept.
fn elsewhere() -> Option<PathBuf> {
    #[cfg(test)]
    if let Some(folder) = HERE.with_borrow(Clone::clone) {
        return Some(folder);
    }
    ELSEWHERE.lock().expect("bug: poisoned").clone()
}

/// The folder of a user's state, and the name of the folder in it.
fn place(program: &Program) -> Option<(PathBuf, String)> {
    let own = elsewhere();
    let name = program.catalog.program.split(' ').next()?.to_owned();
    Some((own.or_else(user_state)?, name))
}

/// Where the permissions for a program are kept, if there is such a place.
pub fn permissions(program: &Program) -> Option<PathBuf> {
    let (state, name) = place(program)?;
    Some(state.join(name).join(FOLDER))
}

/// Whether a program was allowed by this user, where nobody else may write.
pub fn is_allowed(program: &Program) -> bool {
    let Some(folder) = permissions(program) else {
        return false;
    };
    counts(&folder, program.permission().to_hex().as_str())
}

/// Whether a permission is there, and it and the two folders above it are this user's, whom nobody else may
/// write for.
fn counts(folder: &Path, name: &str) -> bool {
    let above = folder.parent().unwrap_or(folder);
    [above, folder, &folder.join(name)].into_iter().all(is_mine)
}

/// Remembers that the programs of these nodes may run.
///
/// # Errors
///
/// There is no such folder, the disk refuses, or other users may write there.
pub fn allow(graph: &Graph, nodes: &[usize]) -> Result<(), PermitError> {
    for (i, program) in programs(graph, nodes) {
        if is_allowed(program) {
            continue;
        }
        let (state, name) = place(program).ok_or(PermitError::Nowhere)?;
        let reported = |why| PermitError::Folder {
            path: state.join(&name).join(FOLDER),
            why,
        };
        let text = listing::lines(&graph.nodes[i].name, program).join("\n") + "\n";
        let kept = || {
            private_folder(&state, true)?;
            let folder = nofollow::made(&state, &[&name, FOLDER])?;
            let file = program.permission().to_hex();
            nofollow::replace(&folder, file.as_str(), text.as_bytes())
        };
        kept().map_err(reported)?;
        if !is_allowed(program) {
            let why = "it is not yours alone: let nobody else write there (chmod 700)";
            return Err(reported(std::io::Error::other(why)));
        }
    }
    Ok(())
}

/// Which programs cannot run.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Settled {
    /// The places of the nodes whose programs nobody allowed.
    pub refused: Vec<usize>,
    /// The first node whose identity, or what it reads, cannot be found, and why.
    pub unknown: Option<(usize, String)>,
}

/// Tells the programs of these nodes whether they may run, and reads the identities of those that may,
/// once for all graphs of a pipeline.
pub fn settle(graph: &Graph, nodes: &[usize], store: &Store, stop: &dyn Fn() -> bool) -> Settled {
    let mut settled = Settled::default();
    let mut cleared = false;
    for (i, program) in programs(graph, nodes) {
        if let Some(wrong) = program.asked() {
            settled.note(i, wrong);
            continue;
        }
        if !is_allowed(program) {
            settled.refused.push(i);
            continue;
        }
        if !std::mem::replace(&mut cleared, true) {
            leftover::clear(store.root());
        }
        let folder = store.root().canonicalize();
        let folder = folder.unwrap_or_else(|_| store.root().to_owned());
        settled.note(i, program.ask(folder, stop));
    }
    settled
}

impl Settled {
    fn note(&mut self, node: usize, wrong: Option<&str>) {
        if let (None, Some(why)) = (&self.unknown, wrong) {
            self.unknown = Some((node, why.to_owned()));
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    #[test]
    fn a_permission_counts_only_where_nobody_else_may_write() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("texts/allowed");
        let file = folder.join("aa");
        private_folder(&folder, true).unwrap();
        std::fs::write(&file, "").unwrap();
        let set = |path: &Path, mode| {
            std::fs::set_permissions(path, PermissionsExt::from_mode(mode)).unwrap();
        };
        set(&file, 0o600);
        assert!(counts(&folder, "aa") && !counts(&folder, "ab"));
        let above = folder.parent().unwrap();
        for (path, open, closed) in [
            (&*file, 0o666, 0o600),
            (&folder, 0o777, 0o700),
            (above, 0o770, 0o700),
        ] {
            set(path, open);
            assert!(!counts(&folder, "aa"), "{}", path.display());
            set(path, closed);
            assert!(counts(&folder, "aa"));
        }
        let elsewhere = place.path().join("elsewhere");
        std::fs::rename(&file, &elsewhere).unwrap();
        symlink(&elsewhere, &file).unwrap();
        assert!(!counts(&folder, "aa"), "through a link");
    }
}
