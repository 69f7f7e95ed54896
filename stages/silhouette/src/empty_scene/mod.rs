//! The empty scene without a photo of it: out of all photos of the turn, in rounds with the body's outlines.

pub(crate) mod background_patches;
pub(crate) mod doubtful_patches;
pub(crate) mod full_size;
pub(crate) mod means;
pub(crate) mod message_passing;
pub(crate) mod recurring;
pub(crate) mod recurring_levels;
pub(crate) mod rounds;
pub(crate) mod scene_labelling;
pub(crate) mod stage;
