//! Results by key, written whole or not at all.
//!
//! ```text
//! format                one line: the version of this layout
//! cas/ab/abcdef…        blobs, named by the hash of their bytes; never changed
//! ac/ab/abcdef…         records by key: what was made, from what, how long it took
//! parts/ab/abcdef…      parts and checkpoints of unfinished work
//! lease/…               held while a result is made; see `lease.rs`
//! runs/…                one record a run
//! pins/…                names of runs whose results stay
//! in-use                locked by whoever runs, and by who sweeps; see `lease.rs`
//! index                 what was verified; see `index.rs`; may go at any time
//! captures/…            which folders had files of this content; see `forget.rs`
//! quarantine/…          what was found corrupt
//! tmp/…                 what is being written
//! ```
//!
//! A blob is written to `tmp` and renamed; a record likewise, and after its blob. So a kill
//! at any moment leaves whole files or litter in `tmp`. Nothing persisted says "running" or "locked".
//! What is read is verified; what is corrupt or missing is a miss. What took long enough to be
//! worth it is synced to the disk before it gets its name.

mod ahead;
mod blob;
mod disk;
mod files;
mod forget;
mod index;
pub mod keeper;
mod lease;
#[cfg(test)]
mod losses;
mod part;
mod pins;
mod record;
#[cfg(test)]
mod simulated;

pub use ahead::Ahead;
pub use forget::{Forgotten, forget};
pub use index::Found;
pub use lease::{Claim, InUse, Lease};
pub use pins::PinError;
pub use record::Record;

use crate::own::{self, place};
use disk::{Disk, Real};
use files::Care;
use index::Index;

use stage::Hash;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock};

const FORMAT: &str = "tailor store 1\n";

/// A store on disk.
pub struct Store {
    root: PathBuf,
    disk: Box<dyn Disk>,
    /// Read when somebody asks it first.
    index: OnceLock<Mutex<Index>>,
}

/// A store that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The disk says no.
    #[error("the cache at {}: {why}; make room or make it writable, or give another with --cache", path.display())]
    Disk {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        why: std::io::Error,
    },
    /// Written by another version of the program.
    #[error("the cache at {} has another layout ({found}): another version of the program made it, use that or give another folder with --cache", root.display())]
    Format {
        /// The store.
        root: PathBuf,
        /// What it says of itself.
        found: String,
    },
    /// Somebody else's folder.
    #[error(
        "{} is not empty and is no cache ({} is not of one): nothing was written; \
         give another folder, or an empty one, with --cache", root.display(), strange.display()
    )]
    Strange {
        /// The folder.
        root: PathBuf,
        /// What no store has.
        strange: PathBuf,
    },
    /// A folder of the store that lies elsewhere.
    #[error("{} is a link, and nothing is removed through a link: nothing was removed; put the folder itself there", .0.display())]
    Link(PathBuf),
    /// Not to be swept now.
    #[error("a run is using the cache at {}: nothing was removed; say it again when the run is done", .0.display())]
    Busy(PathBuf),
}

impl Store {
    /// Opens a store; makes it if there is none.
    pub fn open(root: &Path) -> Result<Store, StoreError> {
        Store::with(root, Box::new(Real), OnceLock::new())
    }

    /// As [`Store::open`], with what was read ahead of it.
    pub fn open_after(root: &Path, ahead: Ahead) -> Result<Store, StoreError> {
        Store::with(root, Box::new(Real), Mutex::new(ahead.index()).into())
    }

    fn with(
        root: &Path,
        disk: Box<dyn Disk>,
        index: OnceLock<Mutex<Index>>,
    ) -> Result<Store, StoreError> {
        let store = Store {
            root: root.to_owned(),
            disk,
            index,
        };
        let mark = root.join("format");
        let found = std::fs::read(&mark).unwrap_or_default();
        if found == FORMAT.as_bytes() {
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
        if let Some(strange) = own::stranger(root) {
            let root = root.to_owned();
            return Err(StoreError::Strange { root, strange });
        }
        files::folder(&*store.disk, root)?;
        // Whole or not there: what it says decides over all else.
        let (tmp, care) = (store.fresh(), Care::Durable);
        files::publish(store.disk(), &tmp, &mark, FORMAT.as_bytes(), care)?;
        Ok(store)
    }

    fn disk(&self) -> (&dyn Disk, &Path) {
        (&*self.disk, &self.root)
    }

    fn index(&self) -> MutexGuard<'_, Index> {
        let load = || Mutex::new(Index::load(&self.root.join("index")));
        self.index.get_or_init(load).lock().expect("bug: poisoned")
    }

    /// Where it lies.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Writes a file of the store by its name, over what was there. It is not synced: what lies
    /// outside of the shelves is of use, but nothing depends on it.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        files::publish(
            self.disk(),
            &self.fresh(),
            &self.root.join(name),
            bytes,
            Care::Cheap,
        )
    }

    /// The file of a hash under a shelf: `cas/ab/abcdef…`.
    fn place(&self, shelf: &str, hash: Hash) -> PathBuf {
        place(&self.root, shelf, hash)
    }

    /// A name in `tmp` that nobody else has.
    fn fresh(&self) -> PathBuf {
        use std::sync::atomic::{AtomicU64, Ordering};
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let (id, now) = (std::process::id(), crate::clock::now_ns());
        self.root.join("tmp").join(format!("{id}-{count}-{now:x}"))
    }

    /// Puts what is corrupt aside, so that it is a miss from now on.
    fn quarantine(&self, path: &Path) {
        let folder = self.root.join("quarantine");
        let name = path.file_name().unwrap_or_default();
        let made = files::folder(&*self.disk, &folder).is_ok();
        if !made || self.disk.rename(path, &folder.join(name)).is_err() {
            let _ = self.disk.remove(path);
        }
    }
}
