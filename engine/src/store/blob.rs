//! Blobs: bytes named by their hash.

use super::error::StoreError;
use super::files::{self, Care};
use super::folder::Store;
use stage::Hash;

/// The bytes of a blob, whole and verified.
pub struct Blob(Vec<u8>);

impl std::ops::Deref for Blob {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        &self.0
    }
}

impl Store {
    /// Keeps bytes that took so long to make; returns their hash. Bytes that are there already
    /// are not written again. \[s\]
    ///
    /// # Errors
    ///
    /// The disk refuses.
    pub fn keep(&self, bytes: &[u8], seconds: f64) -> Result<Hash, StoreError> {
        let hash = blake3::hash(bytes);
        let (path, care) = (self.place("cas", hash), Care::worth(seconds));
        match (self.blob_here(hash).is_some(), care) {
            (false, care) => files::publish(self.disk(), &self.fresh(), &path, bytes, care)?,
            // Somebody who took less time may have made it, and left it to the system.
            (true, Care::Durable) => files::secure(self.disk(), &path)?,
            (true, Care::Cheap) => {}
        }
        Ok(hash)
    }

    /// Whether there is a blob of a hash; it is not read.
    pub(crate) fn holds(&self, hash: Hash) -> bool {
        self.place("cas", hash).is_file()
    }

    /// The bytes of a hash, verified. What is corrupt goes into quarantine and is a miss; what is not here
    /// and is in a shared store is brought here.
    pub fn blob(&self, hash: Hash) -> Option<Blob> {
        let here = self.blob_here(hash);
        here.or_else(|| self.fetch(hash).then(|| self.blob_here(hash)).flatten())
    }

    /// The bytes of a hash, if they are here.
    pub(super) fn blob_here(&self, hash: Hash) -> Option<Blob> {
        self.blob_on_disk(hash).ok().flatten()
    }

    /// As [`Store::blob_here`].
    ///
    /// # Errors
    ///
    /// The disk refuses: then nobody knows whether they are here.
    pub(super) fn blob_on_disk(&self, hash: Hash) -> Result<Option<Blob>, StoreError> {
        let path = self.place("cas", hash);
        // Read, not mapped: a map of a file that somebody cuts short kills the process.
        let Some(bytes) = files::read(&path)? else {
            return Ok(None);
        };
        if blake3::hash(&bytes) == hash {
            return Ok(Some(Blob(bytes)));
        }
        self.quarantine(&path);
        Ok(None)
    }
}
