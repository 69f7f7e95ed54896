//! Images of what is known of each pixel.

use shape::{Image, Mask};

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
