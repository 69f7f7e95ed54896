//! The empty scene: what is still, and the top of the disk, which turns.

pub(crate) mod backdrop;
pub(crate) mod disk_map;
pub(crate) mod disk_plane;
pub(crate) mod still_and_disk;
