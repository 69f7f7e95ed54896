//! Files of a store that are to be gone: removed by single steps of its disk, never through a link, and looked at again.

use super::error::StoreError;
use super::files::at;
use super::folder::Store;
use crate::own;
use stage::Hash;
use std::fs::{File, TryLockError};
use std::path::Path;
use system::{is_alive, nofollow};

impl Store {
    /// Removes a plain file; whether it was there.
    ///
    /// # Errors
    ///
    /// It is still there.
    pub(super) fn gone(&self, folders: &[&str], name: &str) -> Result<bool, StoreError> {
        if self.disk.unlink(self.root(), folders, name) {
            return Ok(true);
        }
        let path = folders
            .iter()
            .fold(self.root().to_owned(), |at, f| at.join(f));
        let path = path.join(name);
        match std::fs::symlink_metadata(&path) {
            Err(why) if nofollow::is_absent(&why) => Ok(false),
            Ok(meta) if !meta.is_file() => Ok(false),
            _ => Err(StoreError::Left(path)),
        }
    }

    /// The plain files of one of its folders whose names fit, sorted.
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows what there is.
    pub(super) fn files(
        &self,
        folder: &str,
        fits: impl Fn(&str) -> bool,
    ) -> Result<Vec<String>, StoreError> {
        own::files(self.root(), folder, fits).map_err(at(&self.root().join(folder)))
    }

    /// All that is on a shelf under a hash.
    ///
    /// # Errors
    ///
    /// As [`Store::files`].
    pub(super) fn shelf(&self, shelf: &str) -> Result<Vec<Hash>, StoreError> {
        own::shelf(self.root(), shelf).map_err(at(&self.root().join(shelf)))
    }

    /// As [`Store::gone`], what is on a shelf under a hash.
    ///
    /// # Errors
    ///
    /// As [`Store::gone`].
    pub(super) fn gone_from(&self, shelf: &str, hash: Hash) -> Result<bool, StoreError> {
        let hex = hash.to_hex();
        self.gone(&[shelf, &hex[..2]], &hex)
    }
}

/// Whether nobody is writing a file of `tmp` now: who does holds a lock on it, so that the number of a killed process
/// that another has since proves nothing. Where the disk knows no locks, the number has to do.
pub(super) fn is_litter(root: &Path, name: &str) -> bool {
    let number = || name.split('-').next().is_none_or(is_alive);
    let Ok(file) = File::open(root.join("tmp").join(name)) else {
        return true;
    };
    match file.try_lock() {
        // Made a moment ago, and locked in the next.
        Ok(()) if file.metadata().is_ok_and(|meta| meta.len() == 0) => !number(),
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => !number(),
    }
}

impl Store {
    /// What was removed stays so after a loss of power: the names in all folders of the store are synced.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub(super) fn sync_removed(&self) -> Result<(), StoreError> {
        for folder in own::folders(self.root()).map_err(at(self.root()))? {
            self.disk.sync_names(&folder).map_err(at(&folder))?;
        }
        Ok(())
    }

    /// All plain files in a folder of the store whose names fit, removed.
    ///
    /// # Errors
    ///
    /// One is still there.
    pub(super) fn all_gone(
        &self,
        folder: &str,
        fits: impl Fn(&str) -> bool,
    ) -> Result<usize, StoreError> {
        let names = self.files(folder, fits)?;
        for name in &names {
            self.gone(&[folder], name)?;
        }
        Ok(names.len())
    }
}
