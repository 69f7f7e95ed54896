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
    /// Blurred images: `INTERVALS + 3`.
    pub blurred: Vec<Gray>,
    /// Differences of neighbours: `INTERVALS + 2`.
    pub differences: Vec<Gray>,
}

/// Blurs by a Gaussian, rows then columns; beyond the border the nearest pixel counts.
pub fn blur(image: &Gray, sigma: f32) -> Gray {
    let radius = (sigma * 4.0).ceil() as usize;
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
        for (o, v) in out.iter_mut().zip(&padded[radius..]) {
            *o = v * kernel[0];
        }
        for (i, k) in kernel.iter().enumerate().skip(1) {
            let (left, right) = (
                &padded[radius - i..radius - i + w],
                &padded[radius + i..radius + i + w],
            );
            for ((o, a), b) in out.iter_mut().zip(left).zip(right) {
                *o += k * (a + b);
            }
        }
    }
    let mut columns = Gray::filled(w, h, 0.0);
    for y in 0..h {
        let out = &mut columns.data[y * w..(y + 1) * w];
        for (o, v) in out.iter_mut().zip(rows.row(y)) {
            *o = v * kernel[0];
        }
        for (i, k) in kernel.iter().enumerate().skip(1) {
            let (above, below) = (rows.row(y.saturating_sub(i)), rows.row((y + i).min(h - 1)));
            for ((o, a), b) in out.iter_mut().zip(above).zip(below) {
                *o += k * (a + b);
            }
        }
    }
    columns
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

/// Calls `see` with each octave and its number, the finest first; only one is in memory at a time.
pub fn octaves(image: &Gray, mut see: impl FnMut(usize, &Octave)) {
    let mut first = blur(image, (SIGMA * SIGMA - CAMERA * CAMERA).sqrt());
    let step = 2f32.powf(1.0 / INTERVALS as f32);
    for number in 0.. {
        if first.width.min(first.height) < 24 {
            return;
        }
        let mut blurred = vec![first];
        for i in 1..INTERVALS + 3 {
            let before = SIGMA * step.powi(i as i32 - 1);
            blurred.push(blur(&blurred[i - 1], before * (step * step - 1.0).sqrt()));
        }
        let difference = |i: usize| {
            let pairs = blurred[i + 1].data.iter().zip(&blurred[i].data);
            Gray {
                data: pairs.map(|(a, b)| a - b).collect(),
                ..blurred[i]
            }
        };
        let differences = (0..INTERVALS + 2).map(difference).collect();
        let octave = Octave {
            blurred,
            differences,
        };
        see(number, &octave);
        first = halved(&octave.blurred[INTERVALS]);
    }
}
