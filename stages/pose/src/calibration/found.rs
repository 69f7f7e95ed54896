//! Cameras, with how they were found.

use crate::adjust::bundle::Fit;
use shape::Cameras;
use stage::Message;

/// Cameras, and how they were found.
pub(crate) struct Found {
    pub(crate) cameras: Cameras,
    pub(crate) fit: Fit,
    pub(crate) warnings: Vec<Message>,
    pub(crate) used_tracks: usize,
    /// Tags on the disk's rim that were used.
    pub(crate) rim_tags: usize,
}
