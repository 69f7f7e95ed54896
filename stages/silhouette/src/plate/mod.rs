//! The empty scene by a photo of it.

pub(crate) mod expected;
