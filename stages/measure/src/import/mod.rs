//! What other programs found or measured, as JSON.

pub(crate) mod file;
pub(crate) mod girths;
pub(crate) mod landmarks;
