//! Leases: of all processes on a store, one makes a result while the rest wait for it or do
//! something else.
//!
//! A lease is a lock of the operating system on a file, so it vanishes with its process however
//! that ends: there is nothing to unlock. Nothing depends on leases but the saving of work: on a
//! disk that knows no locks two processes may make the same result, and one is published.
//!
//! What is dropped is unlocked by name, not only closed: a process that is being started by another
//! thread has copies of all open files for some milliseconds, and a lock lives as long as a copy.
//!
//! The files stay: to make and remove one a result costs more than all else around a cheap stage.
//! There are 4096 of them, so that two results in the making seldom wait for each other's lease.

use super::remote::Paused;
use super::{Store, files};
use stage::Hash;
use std::fs::{File, OpenOptions, TryLockError};
use std::path::Path;
use system::private_file;

/// The lock on a result while it is made.
#[derive(Debug)]
pub struct Lease(File);

impl Drop for Lease {
    fn drop(&mut self) {
        // Where it fails, closing the file does it.
        let _ = self.0.unlock();
    }
}

/// What came of asking for a lease.
#[derive(Debug)]
pub enum Claim {
    /// Nobody else makes it now. `None` where the disk knows no locks.
    Mine(Option<Lease>),
    /// Somebody else makes it, or a result that has the same lease, now.
    Busy,
}

/// A file to be locked, made if there is none.
fn lock_file(path: &Path) -> Option<File> {
    let mut open = OpenOptions::new();
    let open = open.create(true).truncate(false).write(true);
    private_file(open).open(path).ok()
}

impl Store {
    /// Asks for the lease of a key; does not wait.
    pub fn claim(&self, key: Hash) -> Claim {
        let folder = self.root().join("lease");
        let path = folder.join(&key.to_hex()[..3]);
        let made = || files::folder(&*self.disk, &folder).ok();
        let make = || made().and_then(|()| lock_file(&path));
        let Some(file) = lock_file(&path).or_else(make) else {
            return Claim::Mine(None);
        };
        match file.try_lock() {
            Ok(()) => Claim::Mine(Some(Lease(file))),
            Err(TryLockError::WouldBlock) => Claim::Busy,
            Err(TryLockError::Error(_)) => Claim::Mine(None),
        }
    }
}

/// The lock on a store while a run uses it, or while it is swept. It goes with its process.
#[derive(Debug)]
pub struct InUse {
    file: Option<File>,
    _paused: Option<Paused>,
}

impl Drop for InUse {
    fn drop(&mut self) {
        let _ = self.file.as_ref().map(File::unlock);
    }
}

impl Store {
    fn in_use(&self) -> Option<File> {
        lock_file(&self.root().join("in-use"))
    }

    /// For a run or an upload: side by side with other users, but not while somebody sweeps, which is waited for.
    /// On a disk that knows no locks nothing is waited for; what is swept is made again.
    pub fn using(&self) -> InUse {
        let file = self.in_use().filter(|file| file.lock_shared().is_ok());
        InUse {
            file,
            _paused: None,
        }
    }

    /// For a sweep: `None` while a run is using the store, or another process uploads what is in it.
    pub fn alone(&self) -> Option<InUse> {
        let _paused = self.link.as_ref().map(Paused::new);
        let file = match self.in_use() {
            None => None,
            Some(file) => match file.try_lock() {
                Ok(()) => Some(file),
                Err(TryLockError::WouldBlock) => return None,
                Err(TryLockError::Error(_)) => None,
            },
        };
        Some(InUse { file, _paused })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_use_a_store_side_by_side_and_a_sweep_is_alone() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (one, two) = (store.using(), store.using());
        assert!(store.alone().is_none());
        drop(one);
        assert!(store.alone().is_none());
        drop(two);
        let alone = store.alone();
        assert!(alone.is_some() && store.alone().is_none());
    }

    #[test]
    fn what_is_given_back_is_free_while_a_starting_process_has_a_copy_of_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let using = store.using();
        let _copy_of_using = using.file.as_ref().map(|file| file.try_clone().unwrap());
        assert!(store.alone().is_none());
        drop(using);
        let alone = store.alone().expect("nobody uses it");
        let _copy_of_alone = alone.file.as_ref().map(|file| file.try_clone().unwrap());
        assert!(store.alone().is_none());
        drop(alone);
        assert!(store.alone().is_some());
        let key = Hash::from_bytes([1; 32]);
        let Claim::Mine(Some(lease)) = store.claim(key) else {
            panic!("nobody has it")
        };
        let _copy_of_lease = lease.0.try_clone().unwrap();
        drop(lease);
        assert!(matches!(store.claim(key), Claim::Mine(Some(_))));
    }

    #[test]
    fn a_lease_is_for_one_and_comes_back_when_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let key = |n: u8| Hash::from_bytes([n; 32]);
        let Claim::Mine(Some(lease)) = store.claim(key(1)) else {
            panic!("nobody has it")
        };
        assert!(matches!(store.claim(key(1)), Claim::Busy));
        assert!(matches!(store.claim(key(2)), Claim::Mine(Some(_))));
        drop(lease);
        assert!(matches!(store.claim(key(1)), Claim::Mine(Some(_))));
    }
}
