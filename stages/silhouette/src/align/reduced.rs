//! Photos at the size at which they are compared and first cut.

use shape::Rgb;

/// By how much a photo is reduced so that its longest side is so long at most.
pub(crate) fn factor(pixels: &Rgb, coarse_px: usize) -> usize {
    let longest = pixels.width.max(pixels.height);
    longest.div_ceil(coarse_px.max(1)).max(1)
}
