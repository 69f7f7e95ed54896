//! Colours from the photos: `stage` → `atlas` → `labels`.

pub mod atlas;
pub mod labels;
pub(crate) mod stage;
