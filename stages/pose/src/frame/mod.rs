//! The turntable frame: the circle of the cameras, the disk's edge, the subject's stature; and the
//! stage that gives cameras their millimetres and their ground. `stage` → all the rest.

pub(crate) mod circle;
pub(crate) mod disk_edge;
pub(crate) mod disk_exact;
pub(crate) mod disk_search;
mod disk_steps;
pub(crate) mod disk_tags;
pub(crate) mod edge_profile;
pub(crate) mod lengths;
pub(crate) mod placed_tag;
pub(crate) mod stage;
pub(crate) mod stature;
pub(crate) mod tag_scale;
pub(crate) mod two_points;
