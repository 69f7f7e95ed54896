//! Geometry of few photos: the motion between two of them, where a camera is, where a point is.
//! Kernels that know nothing of this crate but `adjust/damped`; `epipolar` → `five_point`, `relative` → both
//! and `triangulate`.

pub(crate) mod background_shift;
pub(crate) mod descent;
pub(crate) mod epipolar;
pub(crate) mod five_point;
pub(crate) mod relative;
pub(crate) mod triangulate;
