//! Blobs: bytes named by their hash, mapped into memory when read.

use super::files::{self, Care};
use super::{Store, StoreError};
use stage::Hash;
use std::fs::File;

/// The bytes of a blob, whole and verified.
pub struct Blob(memmap2::Mmap);

impl std::ops::Deref for Blob {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        &self.0
    }
}

impl Store {
    /// Keeps bytes that took so long to make; returns their hash. Bytes that are there already
    /// are not written again. \[s\]
    pub fn keep(&self, bytes: &[u8], seconds: f64) -> Result<Hash, StoreError> {
        let hash = blake3::hash(bytes);
        if self.blob(hash).is_none() {
            files::publish(
                &self.fresh(),
                &self.place("cas", hash),
                bytes,
                Care::worth(seconds),
            )?;
        }
        Ok(hash)
    }

    /// The bytes of a hash, verified. What is corrupt goes into quarantine and is a miss.
    pub fn blob(&self, hash: Hash) -> Option<Blob> {
        let path = self.place("cas", hash);
        let file = File::open(&path).ok()?;
        // Blobs are only ever renamed into place whole and removed whole, never written to, so the
        // map cannot change; a file truncated by somebody else is caught by the hash unless it
        // happens during the read, which the owner-only mode leaves to the owner.
        #[expect(unsafe_code, reason = "the one audited map: see the comment above")]
        let map = unsafe { memmap2::Mmap::map(&file) }.ok()?;
        if blake3::hash(&map) == hash {
            return Some(Blob(map));
        }
        self.quarantine(&path);
        None
    }
}
