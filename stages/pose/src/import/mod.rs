//! Cameras that somebody else calibrated: `stage` → `colmap`, `text` → `foreign`; the world they come
//! out in is `frame`'s.

pub(crate) mod colmap;
pub(crate) mod foreign;
pub(crate) mod stage;
pub(crate) mod text;
