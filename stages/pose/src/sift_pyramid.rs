//! Scale space: an image blurred more and more, and differences of neighbours (Lowe 2004, §3).

use shape::Gray;

/// Intervals an octave is cut into.
pub const INTERVALS: usize = 3;
/// Blur of the first image of an octave. \[px of the octave\]
pub const SIGMA: f32 = 1.6;
/// Blur that a photo is taken to have.
const CAMERA: f32 = 0.5;

/// The images of one octave.
pub struct Octave {
    /// Blurred images: `INTERVALS + 3`. Differences of neighbours are taken where they are needed.
    pub blurred: Vec<Gray>,
}

/// Blurs by a Gaussian, rows then columns; beyond the border the nearest pixel counts.
pub fn blur(image: &Gray, sigma: f32) -> Gray {
    let radius = (sigma * 3.2).ceil() as usize;
    let mut kernel: Vec<f32> = (0..=radius)
        .map(|i| (-((i * i) as f32) / (2.0 * sigma * sigma)).exp())
        .collect();
    let total = kernel[0] + 2.0 * kernel[1..].iter().sum::<f32>();
    kernel.iter_mut().for_each(|k| *k /= total);
    let (w, h) = (image.width, image.height);
    let mut rows = Gray::filled(w, h, 0.0);
    let mut padded = vec![0.0f32; w + 2 * radius];
    for y in 0..h {
        let row = image.row(y);
        padded[..radius].fill(row[0]);
        padded[radius..radius + w].copy_from_slice(row);
        padded[radius + w..].fill(row[w - 1]);
        let out = &mut rows.data[y * w..(y + 1) * w];
        weighted(&kernel, out, |i, x, n| {
            let at = radius + x;
            (&padded[at - i..at - i + n], &padded[at + i..at + i + n])
        });
    }
    let mut columns = Gray::filled(w, h, 0.0);
    for y in 0..h {
        let out = &mut columns.data[y * w..(y + 1) * w];
        weighted(&kernel, out, |i, x, n| {
            let (above, below) = (rows.row(y.saturating_sub(i)), rows.row((y + i).min(h - 1)));
            (&above[x..x + n], &below[x..x + n])
        });
    }
    columns
}

/// Sums what lies to both sides of each pixel of a row, weighted; `sides(i, x, n)` are the n pixels
/// from x on, i away. Sixteen at a time, so that sums stay in registers.
fn weighted<'a>(
    kernel: &[f32],
    out: &mut [f32],
    sides: impl Fn(usize, usize, usize) -> (&'a [f32], &'a [f32]),
) {
    const AT_ONCE: usize = 16;
    for (block, out) in out.chunks_mut(AT_ONCE).enumerate() {
        let (x, n) = (block * AT_ONCE, out.len());
        let mut sums = [0.0f32; AT_ONCE];
        for (s, v) in sums.iter_mut().zip(sides(0, x, n).0) {
            *s = v * kernel[0];
        }
        for (i, k) in kernel.iter().enumerate().skip(1) {
            let (a, b) = sides(i, x, n);
            if let (Ok(a), Ok(b)) = (
                <&[f32; AT_ONCE]>::try_from(a),
                <&[f32; AT_ONCE]>::try_from(b),
            ) {
                (0..AT_ONCE).for_each(|j| sums[j] += k * (a[j] + b[j]));
            } else {
                (0..n).for_each(|j| sums[j] += k * (a[j] + b[j]));
            }
        }
        out.copy_from_slice(&sums[..n]);
    }
}

/// The next octave's first image: every second pixel. Pixel (x, y) of it lies at (2x, 2y).
fn halved(image: &Gray) -> Gray {
    let (w, h) = (image.width.div_ceil(2), image.height.div_ceil(2));
    let mut half = Gray::filled(w, h, 0.0);
    for y in 0..h {
        for x in 0..w {
            *half.at_mut(x, y) = image.at(2 * x, 2 * y);
        }
    }
    half
}

/// An image of twice the size, linear between pixels. Pixel (x, y) of it lies at (x/2, y/2).
fn doubled(image: &Gray) -> Gray {
    let (w, h) = (image.width, image.height);
    let mut double = Gray::filled(2 * w, 2 * h, 0.0);
    for y in 0..2 * h {
        let (above, below) = (image.row(y / 2), image.row(y.div_ceil(2).min(h - 1)));
        let row = &mut double.data[2 * w * y..2 * w * (y + 1)];
        let mut last = 0.5 * (above[w - 1] + below[w - 1]);
        for x in (0..w).rev() {
            let here = 0.5 * (above[x] + below[x]);
            row[2 * x] = here;
            row[2 * x + 1] = 0.5 * (here + last);
            last = here;
        }
    }
    double
}

/// Calls `see` with each octave and the size of its pixels, from the image's own to coarser ones;
/// with `fine` at last with one of half pixels. Only one is in memory at a time.
pub fn octaves(image: &Gray, fine: bool, mut see: impl FnMut(f32, &Octave)) {
    let to_first = |had: f32| (SIGMA * SIGMA - had * had).sqrt();
    let mut first = blur(image, to_first(CAMERA));
    let mut pixel = 1.0;
    while first.width.min(first.height) >= 24 {
        let octave = octave(first);
        see(pixel, &octave);
        first = halved(&octave.blurred[INTERVALS]);
        pixel *= 2.0;
    }
    if fine && image.width.min(image.height) >= 12 {
        see(0.5, &octave(blur(&doubled(image), to_first(2.0 * CAMERA))));
    }
}

fn octave(first: Gray) -> Octave {
    let step = 2f32.powf(1.0 / INTERVALS as f32);
    let mut blurred = vec![first];
    for i in 1..INTERVALS + 3 {
        let before = SIGMA * step.powi(i as i32 - 1);
        blurred.push(blur(&blurred[i - 1], before * (step * step - 1.0).sqrt()));
    }
    Octave { blurred }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubled_slope_is_the_same_slope_at_half_the_step() {
        let mut image = Gray::filled(9, 7, 0.0);
        for (i, v) in image.data.iter_mut().enumerate() {
            *v = 3.0 * (i % 9) as f32 + 5.0 * (i / 9) as f32;
        }
        let double = doubled(&image);
        for (x, y) in (0..13).flat_map(|y| (0..17).map(move |x| (x, y))) {
            let want = 1.5 * x as f32 + 2.5 * y as f32;
            assert!((double.at(x, y) - want).abs() < 1e-5, "{x} {y}");
        }
    }
}
