//! Marker tags on photos: `find` (the stage) → `corners` (to a part of a pixel).

pub(crate) mod corners;
pub(crate) mod find;
