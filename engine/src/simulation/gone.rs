//! What was forgotten.

use std::collections::BTreeSet;

/// What a machine forgot, and nobody made since.
pub(super) struct Gone {
    pub(super) machine: usize,
    /// The contents of the capture and of all that came of it, hexadecimal.
    pub(super) contents: BTreeSet<String>,
    /// What was left in the shared store then.
    pub(super) left: BTreeSet<String>,
}
