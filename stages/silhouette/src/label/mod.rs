//! Body or background, reduced photo by reduced photo, by the evidence of all together.

pub(crate) mod between_photos;
pub(crate) mod by_colors;
pub(crate) mod color_cut;
pub(crate) mod parts;
pub(crate) mod squares;
pub(crate) mod stage;
