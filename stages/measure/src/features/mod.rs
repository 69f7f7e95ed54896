//! What a surface shows: where and how the body is, marks on its outline, arms, neck.

pub(crate) mod arms;
pub(crate) mod body;
pub(crate) mod extent;
pub(crate) mod flat;
pub(crate) mod ground;
pub(crate) mod limb;
pub(crate) mod marks;
pub(crate) mod neck;
pub(crate) mod neck_tube;
pub(crate) mod readings;
pub(crate) mod soles;
pub(crate) mod standing;
pub(crate) mod throat;
pub(crate) mod upright;
pub(crate) mod whole;
