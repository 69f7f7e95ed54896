//! How well a pixel is explained by the background: negative log likelihoods.

use shape::Rgb;

/// Standard deviation of the sensor's noise in the file's values. \[levels\]
const NOISE: f32 = 4.0;
/// -ln of the Gaussian's norm for three channels of that noise.
const NORM: f32 = 6.92;
/// How far an edge of the background may move. \[px\]
const SLACK: f32 = 0.4;
/// A pixel that the background explains worse than by so much is not it, however much worse.
const CAP: f32 = 24.0;

/// -ln p(pixel | background) of every pixel.
///
/// The pixel may match what is expected there, or lie part of the way (`SLACK`) towards the
/// darkest and brightest of its eight neighbours (edges move by a part of a pixel), as it is or
/// darkened by a soft shadow: deep where `shadow` (column, row) says that one may fall, faint elsewhere.
pub fn background_cost(
    photo: &Rgb,
    expected: &Rgb,
    shadow: &dyn Fn(usize, usize) -> bool,
) -> Vec<f32> {
    let (w, h) = (photo.width, photo.height);
    let mut costs = Vec::with_capacity(w * h);
    for y in 0..h {
        let rows = y.saturating_sub(1)..(y + 2).min(h);
        for x in 0..w {
            let columns = x.saturating_sub(1)..(x + 2).min(w);
            let (mut lo, mut hi) = ([255u8; 3], [0u8; 3]);
            for row in rows.clone() {
                for p in &expected.row(row)[columns.clone()] {
                    (0..3).for_each(|c| (lo[c], hi[c]) = (lo[c].min(p[c]), hi[c].max(p[c])));
                }
            }
            let middle = expected.at(x, y);
            let darkest = if shadow(x, y) { 0.45 } else { 0.9 };
            costs.push(cost(photo.at(x, y), middle, lo, hi, darkest));
        }
    }
    costs
}

/// The cost of one pixel against a box of colours, bright or in shadow.
fn cost(pixel: [u8; 3], middle: [u8; 3], lo: [u8; 3], hi: [u8; 3], darkest: f32) -> f32 {
    let p = pixel.map(f32::from);
    let towards = |end: [u8; 3]| -> [f32; 3] {
        let part =
            |c: usize| f32::from(middle[c]) + SLACK * (f32::from(end[c]) - f32::from(middle[c]));
        [part(0), part(1), part(2)]
    };
    let (lo, hi) = (towards(lo), towards(hi));
    let beyond = |light: f32| -> f32 {
        (0..3)
            .map(|c| (lo[c] * light - p[c]).max(p[c] - hi[c] * light).max(0.0))
            .map(|d| d * d)
            .sum::<f32>()
            / (2.0 * NOISE * NOISE)
    };
    // The light that explains the pixel best, by its brightness.
    let sum = |c: [f32; 3]| c.iter().sum::<f32>() + 3.0;
    let light = (sum(p) / ((sum(lo) + sum(hi)) / 2.0)).clamp(darkest, 1.0);
    let shadow = beyond(light) + 7.0 * (1.0 - light);
    beyond(1.0).min(shadow).min(CAP) + NORM
}
