//! The empty scene by a photo of it.

pub(crate) mod expected;
pub(crate) mod stage;
