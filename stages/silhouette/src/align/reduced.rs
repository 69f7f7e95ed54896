//! Photos at the size at which they are compared and first cut.

use shape::Rgb;

/// An image reduced by a whole factor, pixels averaged.
pub fn reduced(image: &Rgb, factor: usize) -> Rgb {
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
