//! Looking at the blobs of an index ahead of a walk, on several threads.

use super::index::{Entry, Index, Stamp};
use stage::Hash;
use std::path::{Path, PathBuf};
use std::thread::{Builder, JoinHandle};

/// From so many entries on it is worth to look at their blobs on several threads.
const MANY: usize = 2000;

/// The index of a store, read and checked against its blobs on threads of its own: for whoever reads
/// a pipeline meanwhile.
pub struct Prefetch(Result<JoinHandle<Index>, Index>);

impl Prefetch {
    /// Of the store at a place, if there is one, for a pipeline file of so many bytes: a large
    /// index of which a small pipeline asks little is read only.
    pub fn of(root: &Path, pipeline_bytes: u64) -> Prefetch {
        let root: PathBuf = root.into();
        let read = move || {
            let mut index = Index::load(&root.join("index"));
            index.look_around(&root, pipeline_bytes as usize / LEAST_NODE_BYTES);
            index
        };
        // Where the system gives no thread, it is read at once.
        Prefetch(Builder::new().spawn(read.clone()).map_err(|_| read()))
    }

    pub(super) fn index(self) -> Index {
        match self.0 {
            Ok(thread) => thread.join().unwrap_or_default(),
            Err(index) => index,
        }
    }
}

/// `[node.a]` and its stage take no less.
const LEAST_NODE_BYTES: usize = 30;

impl Index {
    /// Looks at the blobs of all entries on several threads, for a walk of so many nodes that is
    /// going to ask for most of them.
    pub(super) fn look_around(&mut self, root: &Path, nodes: usize) {
        let n = self.entries.len();
        if self.looked || n < MANY || n > 2 * nodes {
            return;
        }
        self.looked = true;
        let mut entries: Vec<&mut Entry> = self.entries.values_mut().collect();
        // By folder: neighbours are found faster.
        entries.sort_unstable_by_key(|entry| entry.content);
        let look = |entry: &mut Entry| {
            let content = Hash::from_bytes(entry.content);
            entry.seen = Some(Stamp::of(&crate::own::place(root, "cas", content)));
        };
        let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
        std::thread::scope(|scope| {
            for chunk in entries.chunks_mut(n.div_ceil(cores.min(4))) {
                // What no thread looks at is looked at when it is asked for.
                let look = move || chunk.iter_mut().for_each(|entry| look(entry));
                let _ = Builder::new().spawn_scoped(scope, look);
            }
        });
    }
}
