//! What identities print, read once for all graphs of a pipeline.

use stage::Hash;
use std::collections::HashMap;
use std::sync::Mutex;

/// What each identity printed, or why that is not known.
#[derive(Default)]
pub struct Identities(Mutex<HashMap<[u8; 32], Result<String, String>>>);

impl Identities {
    /// What is known for a permission; else what `read` gives.
    pub(crate) fn get(
        &self,
        of: Hash,
        read: impl FnOnce() -> Result<String, String>,
    ) -> Result<String, String> {
        let mut known = self.0.lock().expect("bug: poisoned");
        known.entry(*of.as_bytes()).or_insert_with(read).clone()
    }
}
