//! What is known of the records that a shared store has.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::Instant;

/// What is known of the records there.
#[derive(Default)]
pub(super) struct Inventory {
    pub(super) absent: HashMap<[u8; 32], Instant>,
    pub(super) missed: usize,
    pub(super) listed: Option<Arc<HashSet<[u8; 32]>>>,
    /// When it was tried, whatever came of it.
    pub(super) tried: Option<Instant>,
}
