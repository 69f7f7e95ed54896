//! Images of what is known of each pixel, and what is known of one photo alone.

use shape::{ByPhoto, Image, Mask, PhotoId};

/// An image of `height * width` pixels, row-major.
pub(crate) fn raster<T>(width: usize, height: usize, data: Vec<T>) -> Image<T> {
    Image {
        width,
        height,
        data,
    }
}

/// Sides as a mask.
pub(crate) fn as_mask(sides: &Image<bool>) -> Mask {
    sides.map(|s| if *s { 255 } else { 0 })
}

/// What is of one photo alone, as a part of a stage's result is kept.
pub(crate) fn only<T>(value: T) -> ByPhoto<T> {
    [(PhotoId(0), value)].into_iter().collect()
}
