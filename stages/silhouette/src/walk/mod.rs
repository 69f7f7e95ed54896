//! Silhouettes of a walk around a subject that is as still as its background.
//!
//! Campbell, Vogiatzis, Hernández and Cipolla, "Automatic 3D object segmentation in multiple views
//! using volumetric graph-cuts", Image and Vision Computing 28 (2010): what all cameras look at is the
//! subject; its colours and the background's are learned from photos, cells of a block are parted by a least
//! cut, and both again. That a cell is free where one photo sees the background through it: Djelouah et al.
//! (2013). Features behind the subject, which a walk gives for nothing, show it without colours.

mod colors;
mod doubt;
mod features;
mod find;
mod floor_cut;
mod full_size;
mod judged;
mod outline;
mod params;
mod passes;
mod space;
mod stage;
mod voxels;

pub use params::{WalkCutError, WalkParams};
pub use stage::{Walk, WalkInput};

/// Every kind of message of these files.
pub(crate) const MESSAGES: &[::stage::Template] = judged::MESSAGES;
