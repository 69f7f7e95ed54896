//! The section of a plane that belongs to one part of the body alone.

pub(crate) mod across_arm;
pub(crate) mod across_arm_of_hull;
pub(crate) mod across_leg;
pub(crate) mod arm_inferred;
pub(crate) mod beside_trunk;
pub(crate) mod bridge;
pub(crate) mod down_arm;
pub(crate) mod fold;
pub(crate) mod hands;
pub(crate) mod lobe;
pub(crate) mod narrowest;
pub(crate) mod one;
pub(crate) mod picked;
mod seams;
pub(crate) mod split;
pub(crate) mod taken;
