//! Colours from the photos: `stage` → `ahead`, `atlas` → `labels`.

pub(crate) mod ahead;
pub mod atlas;
pub mod labels;
pub(crate) mod stage;
