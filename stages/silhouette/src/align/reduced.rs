//! Photos at the size at which they are compared and first cut.

use shape::Rgb;

/// An image reduced by a whole factor, pixels averaged.
pub(crate) fn reduced(image: &Rgb, factor: usize) -> Rgb {
    let (width, height) = (image.width / factor, image.height / factor);
    let mut small = Rgb::filled(width, height, [0; 3]);
    let area = (factor * factor) as u32;
    for y in 0..height {
        for x in 0..width {
            let mut sum = [area / 2; 3];
            for row in y * factor..(y + 1) * factor {
                for p in &image.row(row)[x * factor..(x + 1) * factor] {
                    (0..3).for_each(|c| sum[c] += u32::from(p[c]));
                }
            }
            *small.at_mut(x, y) = sum.map(|s| (s / area) as u8);
        }
    }
    small
}

/// By how much a photo is reduced so that its longest side is so long at most.
pub(crate) fn factor(pixels: &Rgb, coarse_px: usize) -> usize {
    let longest = pixels.width.max(pixels.height);
    longest.div_ceil(coarse_px.max(1)).max(1)
}
