//! Which stores of this process are linked to shared ones: whoever opens a store opens its link, too.

use super::link::Link;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

static JOINED: Mutex<Vec<(PathBuf, Arc<Link>)>> = Mutex::new(Vec::new());

fn whole(root: &Path) -> PathBuf {
    std::path::absolute(root).unwrap_or_else(|_| root.into())
}

/// Links the store at `root`: as long as the link is not let go, who opens the store uses it.
pub(super) fn join(root: &Path, link: &Arc<Link>) {
    let mut joined = JOINED.lock().expect("bug: poisoned");
    joined.push((whole(root), link.clone()));
}

/// Lets go of the link of the store at `root`.
pub(super) fn part(root: &Path) {
    let root = whole(root);
    let mut joined = JOINED.lock().expect("bug: poisoned");
    joined.retain(|(at, _)| *at != root);
}

/// The link of the store at `root`.
pub(in crate::store) fn of(root: &Path) -> Option<Arc<Link>> {
    let joined = JOINED.lock().expect("bug: poisoned");
    if joined.is_empty() {
        return None;
    }
    let root = whole(root);
    let found = joined.iter().find(|(at, _)| *at == root);
    found.map(|(_, link)| link.clone())
}
