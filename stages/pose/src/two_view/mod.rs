//! Geometry of few photos: the motion between two of them, where a camera stands, where a point lies.
//! Kernels that know nothing of the rest of this room; `epipolar` → `five_point`, `resection` → both
//! and `triangulate`.

pub(crate) mod descent;
pub(crate) mod epipolar;
pub(crate) mod five_point;
pub(crate) mod resection;
pub(crate) mod room_shift;
pub(crate) mod triangulate;
