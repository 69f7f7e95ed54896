//! Leases: of all processes on a store, one makes a result while the others wait for it or do
//! something else.
//!
//! A lease is a lock of the operating system on a file, so it vanishes with its process however
//! that ends: there is nothing to unlock. Nothing depends on leases but the saving of work: on a
//! disk that knows no locks two processes may make the same result, and one is published.

use super::{Store, files};
use stage::Hash;
use std::fs::{File, OpenOptions, TryLockError};
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

/// Held while a result is made.
#[derive(Debug)]
pub struct Lease {
    path: PathBuf,
    _file: File,
}

/// What came of asking for a lease.
#[derive(Debug)]
pub enum Claim {
    /// Nobody else makes it now. `None` where the disk knows no locks.
    Mine(Option<Lease>),
    /// Somebody else makes it now.
    Busy,
}

impl Store {
    /// Asks for the lease of a key; does not wait.
    pub fn claim(&self, key: Hash) -> Claim {
        let folder = self.root().join("lease");
        let path = folder.join(key.to_hex().as_str());
        if files::folder(&folder).is_err() {
            return Claim::Mine(None);
        }
        loop {
            let open = OpenOptions::new()
                .create(true)
                .truncate(false)
                .write(true)
                .mode(0o600)
                .open(&path);
            let Ok(file) = open else {
                return Claim::Mine(None);
            };
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Claim::Busy,
                Err(TryLockError::Error(_)) => return Claim::Mine(None),
            }
            // Who held it last may have removed the file between our opening and our locking.
            if is_at(&file, &path) {
                return Claim::Mine(Some(Lease { path, _file: file }));
            }
        }
    }
}

/// Whether the file that is open is the one that lies at the path.
fn is_at(file: &File, path: &Path) -> bool {
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(a), Ok(b)) => (a.dev(), a.ino()) == (b.dev(), b.ino()),
        _ => false,
    }
}

impl Drop for Lease {
    fn drop(&mut self) {
        // Removed while still locked: nobody can hold the file that is about to be without a name.
        let _ = std::fs::remove_file(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lease_is_for_one_and_comes_back_when_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let key = stage::hash(b"a key");
        let Claim::Mine(Some(lease)) = store.claim(key) else {
            panic!("nobody has it")
        };
        assert!(matches!(store.claim(key), Claim::Busy));
        assert!(matches!(
            store.claim(stage::hash(b"another")),
            Claim::Mine(Some(_))
        ));
        drop(lease);
        assert!(matches!(store.claim(key), Claim::Mine(Some(_))));
        let left = std::fs::read_dir(folder.path().join("lease")).unwrap();
        assert_eq!(left.count(), 0, "no litter");
    }
}
