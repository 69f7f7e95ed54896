//! What a surface shows: how the body stands, marks on its outline, arms, neck.

pub(crate) mod arms;
pub(crate) mod body;
pub(crate) mod marks;
pub(crate) mod neck;
pub(crate) mod neck_level;
pub(crate) mod reach;
pub(crate) mod whole;
