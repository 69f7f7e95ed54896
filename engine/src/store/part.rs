//! Parts and checkpoints of work that is not finished: found again after a kill.

use super::error::StoreError;
use super::files::{self, Care};
use super::folder::Store;
use stage::Hash;

impl Store {
    /// Remembers bytes under a key, over what was there: first a hash of the key and them, to distinguish
    /// whole from torn, and this key's from another's.
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn remember(&self, key: Hash, bytes: &[u8]) -> Result<(), StoreError> {
        let mut file = bound(key, bytes).as_bytes().to_vec();
        file.extend_from_slice(bytes);
        let path = self.place("parts", key);
        files::publish(self.disk(), &self.fresh(), &path, &file, Care::Cheap)
    }

    /// What was remembered, if it is whole.
    pub fn recall(&self, key: Hash) -> Option<Vec<u8>> {
        self.recall_on_disk(key).ok().flatten()
    }

    /// As [`Store::recall`].
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub(super) fn recall_on_disk(&self, key: Hash) -> Result<Option<Vec<u8>>, StoreError> {
        let path = self.place("parts", key);
        let Some(mut file) = files::read(&path)? else {
            return Ok(None);
        };
        if file.len() >= 32 && *bound(key, &file[32..]).as_bytes() == file[..32] {
            return Ok(Some(file.split_off(32)));
        }
        self.quarantine(&path);
        Ok(None)
    }
}

/// One hash of a key and what is under it.
fn bound(key: Hash, bytes: &[u8]) -> Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(key.as_bytes());
    hasher.update(bytes);
    hasher.finalize()
}
