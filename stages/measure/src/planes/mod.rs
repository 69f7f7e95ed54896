//! Where each girth is taken: levels from features, and planes across limbs.

pub(crate) mod levels;
pub(crate) mod limbs;
