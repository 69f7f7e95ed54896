//! What a mesh is, no matter what photos show: curvature, remeshing, large systems.

pub mod curvature;
pub mod gradients;
pub mod remesh;
#[cfg(test)]
pub(crate) mod solids;
