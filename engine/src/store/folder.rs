//! The folder of a store: its mark, its shelves, names of its files.

use super::disk::{Disk, Real};
use super::error::StoreError;
use super::files::{self, Care};
use super::index::Index;
use super::prefetch::Prefetch;
use super::remote::{self, Link};
use crate::own::{self, place};
use crate::past;
use stage::Hash;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock};

/// The text of the file `format`.
const FORMAT: &str = "stage store 1\n";

/// Its text before the engine was a crate of its own: the same layout, after the first program.
const FORMER: &str = "tailor store 1\n";

/// A store on disk.
pub struct Store {
    root: PathBuf,
    pub(super) disk: Box<dyn Disk>,
    /// Read when somebody asks it first.
    index: OnceLock<Mutex<Index>>,
    /// See [`super::origin`].
    pub(super) mark: OnceLock<Option<String>>,
    /// To a store that machines share, if there is one.
    pub(super) link: Option<Arc<Link>>,
}

impl Store {
    /// Opens a store; makes it if there is none.
    ///
    /// # Errors
    ///
    /// It cannot be made, is of another version, or somebody else's folder.
    pub fn open(root: &Path) -> Result<Store, StoreError> {
        Store::with(root, Box::new(Real), OnceLock::new())
    }

    /// As [`Store::open`], with what was read ahead of it.
    ///
    /// # Errors
    ///
    /// As [`Store::open`].
    pub fn open_after(root: &Path, prefetch: Prefetch) -> Result<Store, StoreError> {
        Store::with(root, Box::new(Real), Mutex::new(prefetch.index()).into())
    }

    /// On a disk of a simulation, linked to a shared store of one.
    #[cfg(test)]
    pub(crate) fn simulated(
        root: &Path,
        disk: Box<dyn Disk>,
        link: Option<Arc<Link>>,
    ) -> Result<Store, StoreError> {
        let mut store = Store::with(root, disk, OnceLock::new())?;
        store.link = link;
        Ok(store)
    }

    pub(super) fn with(
        root: &Path,
        disk: Box<dyn Disk>,
        index: OnceLock<Mutex<Index>>,
    ) -> Result<Store, StoreError> {
        let store = Store {
            root: root.to_owned(),
            disk,
            index,
            mark: OnceLock::new(),
            link: remote::of(root),
        };
        let mark = root.join("format");
        let found = files::read(&mark)?.unwrap_or_default();
        if [FORMAT, FORMER].iter().any(|mark| found == mark.as_bytes()) {
            return Ok(store);
        }
        // A loss of power may leave a file without all that was written, whose layout was this one.
        let zeros = found.iter().rev().take_while(|byte| **byte == 0).count();
        if !FORMAT.as_bytes().starts_with(&found[..found.len() - zeros]) {
            let found = String::from_utf8_lossy(&found);
            return Err(StoreError::Format {
                root: root.into(),
                found: found.trim().chars().take(40).collect(),
            });
        }
        // What killed processes and a loss of power leave is of our own form.
        if let Some(strange) = own::stranger(root).map_err(files::at(root))? {
            let root = root.to_owned();
            return Err(StoreError::Strange { root, strange });
        }
        files::folder(&*store.disk, root)?;
        // Whole or not there: its text decides over all else.
        let (tmp, care) = (store.fresh(), Care::Durable);
        files::publish(store.disk(), &tmp, &mark, FORMAT.as_bytes(), care)?;
        Ok(store)
    }

    pub(super) fn disk(&self) -> (&dyn Disk, &Path) {
        (&*self.disk, &self.root)
    }

    pub(super) fn index(&self) -> MutexGuard<'_, Index> {
        let load = || Mutex::new(Index::load(&self.root.join("index")));
        self.index.get_or_init(load).lock().expect("bug: poisoned")
    }

    /// Where it is.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Where the record of a key is, if there is one: a text that lists what a result was made of.
    pub fn record_file(&self, key: Hash) -> PathBuf {
        self.place("ac", key)
    }

    /// Where the blob of a content is, if it is there.
    pub fn blob_file(&self, content: Hash) -> PathBuf {
        self.place("cas", content)
    }

    /// Writes a file of the store by its name, over what was there. It is not synced: what is
    /// outside of the shelves is of use, but nothing depends on it.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        files::publish(
            self.disk(),
            &self.fresh(),
            &self.root.join(name),
            bytes,
            Care::Cheap,
        )
    }

    /// The id of a run that begins now.
    ///
    /// # Errors
    ///
    /// Earlier runs cannot be listed.
    pub(crate) fn next_run(&self) -> Result<String, StoreError> {
        past::next_id(&self.root).map_err(files::at(&self.root.join("runs")))
    }

    /// The file of a hash under a shelf: `cas/ab/abcdef…`.
    pub(super) fn place(&self, shelf: &str, hash: Hash) -> PathBuf {
        place(&self.root, shelf, hash)
    }

    /// A name in `tmp` that nobody else has.
    pub(super) fn fresh(&self) -> PathBuf {
        use std::sync::atomic::{AtomicU64, Ordering};
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let count = system::clock::simulated::count().map_or(count, |n| 1_000_000 + n);
        self.root.join("tmp").join(system::numbered(count))
    }

    /// Puts what is corrupt aside, so that it is a miss from now on.
    pub(super) fn quarantine(&self, path: &Path) {
        let folder = self.root.join("quarantine");
        let name = path.file_name().unwrap_or_default();
        let made = files::folder(&*self.disk, &folder).is_ok();
        if !made || self.disk.rename(path, &folder.join(name)).is_err() {
            let _ = self.disk.remove(path);
        }
    }
}
