//! Where each girth is taken: levels from features, and planes across limbs.

pub(crate) mod calf;
pub(crate) mod custom;
pub(crate) mod hidden;
pub(crate) mod joints;
pub(crate) mod limbs;
pub(crate) mod neck;
pub(crate) mod neck_level;
pub(crate) mod place;
pub(crate) mod thigh;
pub(crate) mod trunk;
pub(crate) mod wanted;
