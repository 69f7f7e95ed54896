//! The empty scene without a photo of it: out of all photos of the turn, with the body's outlines.

pub(crate) mod doubtful_patches;
pub(crate) mod full_size;
pub(crate) mod means;
pub(crate) mod mended;
pub(crate) mod recurring;
pub(crate) mod stage;
pub(crate) mod without_plate;
