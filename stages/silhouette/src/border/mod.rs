//! The border of the body at full size.

pub(crate) mod by_colors;
pub(crate) mod full_size;
pub(crate) mod light;
pub(crate) mod mixed;
pub(crate) mod narrow_gaps;
pub(crate) mod returned;
pub(crate) mod soft_border;
pub(crate) mod stage;
pub(crate) mod tiles;
