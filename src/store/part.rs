//! Parts and checkpoints of work that is not finished: found again after a kill.

use super::files::{self, Care};
use super::{Store, StoreError};
use stage::Hash;

impl Store {
    /// Remembers bytes under a key, over what was there: their hash first, to tell whole from torn.
    pub fn remember(&self, key: Hash, bytes: &[u8]) -> Result<(), StoreError> {
        let mut file = blake3::hash(bytes).as_bytes().to_vec();
        file.extend_from_slice(bytes);
        files::publish(&self.fresh(), &self.place("part", key), &file, Care::Cheap)
    }

    /// What was remembered, if it is whole.
    pub fn recall(&self, key: Hash) -> Option<Vec<u8>> {
        let path = self.place("part", key);
        let mut file = std::fs::read(&path).ok()?;
        if file.len() >= 32 && *blake3::hash(&file[32..]).as_bytes() == file[..32] {
            return Some(file.split_off(32));
        }
        self.quarantine(&path);
        None
    }
}
