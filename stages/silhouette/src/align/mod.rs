//! Photos are brought to one place and one exposure, and to one size.

pub(crate) mod alignment;
pub(crate) mod cameras;
pub(crate) mod exposure;
pub(crate) mod rectangle;
pub(crate) mod reduced;
pub(crate) mod stage;
