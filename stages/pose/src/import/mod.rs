//! Cameras that somebody else calibrated: `stage` → `colmap`, `text` → `foreign`; the world they come
//! out in is `frame`'s. What other programs found on photos: `tags`, `tracks` → `found`.

pub(crate) mod colmap;
pub(crate) mod foreign;
pub(crate) mod found;
pub(crate) mod stage;
pub(crate) mod tags;
pub(crate) mod text;
pub(crate) mod tracks;
