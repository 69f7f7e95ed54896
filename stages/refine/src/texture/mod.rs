//! Colours from the photos: `stage` → `ahead`, `atlas`, `labels` → `seams` → `charts`.

pub(crate) mod ahead;
pub mod atlas;
pub mod charts;
pub mod labels;
pub(crate) mod seams;
pub(crate) mod stage;
