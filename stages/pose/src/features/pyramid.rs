//! Scale space: an image blurred more and more, and differences of neighbours (Lowe 2004, §3).

use shape::Gray;
use stage::machine::widest;

/// Intervals an octave is cut into (Lowe 2004, §3.2).
pub const INTERVALS: usize = 3;
/// Blur of the first image of an octave (Lowe 2004, §3.3). \[px of the octave\]
pub const SIGMA: f32 = 1.6;
/// Blur that a photo is taken to have (Lowe 2004, §3.3).
const CAMERA: f32 = 0.5;

/// The images of one octave.
pub struct Octave {
    /// Blurred images: `INTERVALS + 3`. Differences of neighbours are taken where they are needed.
    pub blurred: Vec<Gray>,
}

impl Octave {
    /// Lets go of the images that are not asked for again.
    pub fn keep(&mut self, wanted: impl Fn(usize) -> bool) {
        let images = self.blurred.iter_mut().enumerate();
        let unwanted = images.filter(|(layer, _)| !wanted(*layer));
        unwanted.for_each(|(_, image)| *image = Gray::filled(0, 0, 0.0));
    }
}

/// Blurs by a Gaussian, rows then columns; beyond the border the nearest pixel counts.
pub fn blur(image: &Gray, sigma: f32) -> Gray {
    blurred(image.width, image.height, sigma, |y, row| {
        row.copy_from_slice(image.row(y));
    })
}

/// The blur of an image of which `source` gives the rows. Only as many rows as the Gaussian is high
/// are kept between the passes, so that they stay in the cache.
fn blurred(w: usize, h: usize, sigma: f32, mut source: impl FnMut(usize, &mut [f32])) -> Gray {
    let radius = (sigma * 3.2).ceil() as usize;
    let mut kernel: Vec<f32> = (0..=radius)
        .map(|i| libm::expf(-((i * i) as f32) / (2.0 * sigma * sigma)))
        .collect();
    let total = kernel[0] + 2.0 * kernel[1..].iter().sum::<f32>();
    kernel.iter_mut().for_each(|k| *k /= total);
    let kept = 2 * radius + 1;
    let mut rows = vec![0.0f32; kept * w];
    let mut padded = vec![0.0f32; w + 2 * radius];
    let mut next = 0;
    let mut out = Gray::filled(w, h, 0.0);
    for (y, out) in out.data.chunks_exact_mut(w).enumerate() {
        while next <= (y + radius).min(h - 1) {
            source(next, &mut padded[radius..radius + w]);
            let (first, last) = (padded[radius], padded[radius + w - 1]);
            padded[..radius].fill(first);
            padded[radius + w..].fill(last);
            let row = &mut rows[(next % kept) * w..][..w];
            let sides = |i: usize| (&padded[radius - i..][..w], &padded[radius + i..][..w]);
            widest(
                #[inline(always)]
                || weighted(&kernel, row, sides),
            );
            next += 1;
        }
        let row = |y: usize| &rows[(y % kept) * w..][..w];
        let sides = |i: usize| (row(y.saturating_sub(i)), row((y + i).min(h - 1)));
        widest(
            #[inline(always)]
            || weighted(&kernel, out, sides),
        );
    }
    out
}

/// Sums what is to both sides of each pixel of a row, weighted; `sides(i)` are what is i away.
/// Sixteen pixels at a time, so that sums stay in registers.
#[inline(always)]
fn weighted<'a>(kernel: &[f32], out: &mut [f32], sides: impl Fn(usize) -> (&'a [f32], &'a [f32])) {
    /// Columns that are worked on side by side (structural: speed alone).
    const AT_ONCE: usize = 16;
    type Lanes = [f32; AT_ONCE];
    let middle = sides(0).0;
    let all: Vec<(f32, &[Lanes], &[Lanes])> = (1..kernel.len())
        .map(|i| {
            let (a, b) = sides(i);
            (kernel[i], a.as_chunks().0, b.as_chunks().0)
        })
        .collect();
    let (whole, rest) = out.as_chunks_mut::<AT_ONCE>();
    for (x, (out, at)) in whole.iter_mut().zip(middle.as_chunks().0).enumerate() {
        let at: &Lanes = at;
        let mut sums = at.map(|v| v * kernel[0]);
        for (k, a, b) in &all {
            let (a, b) = (&a[x], &b[x]);
            for j in 0..AT_ONCE {
                sums[j] += k * (a[j] + b[j]);
            }
        }
        *out = sums;
    }
    let from = middle.len() - rest.len();
    for (x, out) in rest.iter_mut().enumerate() {
        let x = from + x;
        *out = middle[x] * kernel[0];
        for (i, k) in kernel.iter().enumerate().skip(1) {
            let (a, b) = sides(i);
            *out += k * (a[x] + b[x]);
        }
    }
}

/// The next octave's first image: every second pixel. Pixel (x, y) of it is at (2x, 2y).
fn halved(image: &Gray) -> Gray {
    let (w, h) = (image.width.div_ceil(2), image.height.div_ceil(2));
    let mut half = Gray::filled(w, h, 0.0);
    for (y, row) in half.data.chunks_exact_mut(w).enumerate() {
        for (to, from) in row.iter_mut().zip(image.row(2 * y).iter().step_by(2)) {
            *to = *from;
        }
    }
    half
}

/// A row of an image of twice the size, linear between pixels. Pixel (x, y) of it is at (x/2, y/2).
fn doubled(image: &Gray, y: usize, row: &mut [f32]) {
    let (w, h) = (image.width, image.height);
    let (above, below) = (image.row(y / 2), image.row(y.div_ceil(2).min(h - 1)));
    let here = |x: usize| 0.5 * (above[x] + below[x]);
    let pairs = row.as_chunks_mut::<2>().0;
    for (x, pair) in pairs.iter_mut().enumerate().take(w - 1) {
        let (a, b) = (here(x), here(x + 1));
        *pair = [a, 0.5 * (a + b)];
    }
    let last = here(w - 1);
    pairs[w - 1] = [last, 0.5 * (last + last)];
}

/// What `each` makes of the octaves and the size of their pixels, from the image's own to coarser ones; with `fine` at
/// last of one of half pixels. That one is the largest by far and is made first, while there is no other.
pub fn octaves<T>(image: &Gray, fine: bool, mut each: impl FnMut(f32, Octave) -> T) -> Vec<T> {
    let to_first = |had: f32| (SIGMA * SIGMA - had * had).sqrt();
    let (w, h) = (image.width, image.height);
    let finest = (fine && w.min(h) >= 12).then(|| {
        let blur = to_first(2.0 * CAMERA);
        let first = blurred(2 * w, 2 * h, blur, |y, row| doubled(image, y, row));
        each(0.5, octave(first))
    });
    let mut all = Vec::new();
    let mut first = blur(image, to_first(CAMERA));
    let mut pixel = 1.0;
    while first.width.min(first.height) >= 24 {
        let octave = octave(first);
        first = halved(&octave.blurred[INTERVALS]);
        all.push(each(pixel, octave));
        pixel *= 2.0;
    }
    all.extend(finest);
    all
}

fn octave(first: Gray) -> Octave {
    let step = libm::powf(2f32, 1.0 / INTERVALS as f32);
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
        let mut row = [0.0; 18];
        for y in 0..13 {
            doubled(&image, y, &mut row);
            for (x, v) in row.iter().enumerate().take(17) {
                let want = 1.5 * x as f32 + 2.5 * y as f32;
                assert!((v - want).abs() < 1e-5, "{x} {y}");
            }
        }
    }

    /// Sums over all neighbours at once, pixel by pixel.
    #[test]
    fn a_blur_is_the_weighted_mean_of_the_neighbourhood() {
        let mut dice = proof::Dice(3);
        let mut image = Gray::filled(37, 23, 0.0);
        image
            .data
            .iter_mut()
            .for_each(|v| *v = dice.within(0.0, 255.0) as f32);
        let (sigma, radius) = (1.5f64, 5i32);
        let weight = |i: i32| libm::exp(-f64::from(i * i) / (2.0 * sigma * sigma));
        let total: f64 = (-radius..=radius).map(weight).sum();
        let got = blur(&image, sigma as f32);
        for (x, y) in (0..23).flat_map(|y| (0..37).map(move |x| (x, y))) {
            let mut want = 0.0;
            for (i, j) in (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| (i, j))) {
                let (a, b) = ((x + i).clamp(0, 36) as usize, (y + j).clamp(0, 22) as usize);
                want += weight(i) * weight(j) * f64::from(image.at(a, b));
            }
            let off = f64::from(got.at(x as usize, y as usize)) - want / (total * total);
            assert!(off.abs() < 1e-3, "{x} {y}: {off}");
        }
    }
}
