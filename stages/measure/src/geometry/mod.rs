//! Sections of a mesh as closed curves, and lengths around them.

pub(crate) mod crop;
pub(crate) mod halves;
pub(crate) mod peak;
pub(crate) mod rays;
pub(crate) mod section;
pub(crate) mod slices;
pub(crate) mod spline;
