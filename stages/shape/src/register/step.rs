//! One step of laying a picture on another: what is left, and the normal equations.

use crate::{Gray, Placed};
use nalgebra::{SMatrix, SVector};

/// What a grid of pixels, `rim` away from the border, shows on the picture beyond what the other foresees. \[levels\]
#[inline(always)]
pub(super) fn residuals(
    [picture, other]: [&Gray; 2],
    from: &Placed,
    (rim, every): (usize, usize),
) -> Vec<f64> {
    let (w, h) = (other.width, other.height);
    let mut residuals = Vec::with_capacity((w * h).div_ceil(every * every));
    for y in (rim..h - rim).step_by(every) {
        for x in (rim..w - rim).step_by(every) {
            let at = from.of([x as f64, y as f64], [w, h]);
            let seen = f64::from(picture.sample(at[0] as f32, at[1] as f32));
            residuals.push(seen - from.gain * f64::from(other.at(x, y)) - from.bias);
        }
    }
    residuals
}

/// The normal equations of a step, in their lower triangle.
pub(super) struct Sums {
    pub(super) normal: SMatrix<f64, 5, 5>,
    pub(super) right: SVector<f64, 5>,
    /// How many pixels have half their weight.
    pub(super) kept: usize,
}

/// The middle of a picture, and how far a corner is from it. \[px\]
pub(super) fn middle(width: usize, height: usize) -> ([f64; 2], f64) {
    let middle = [width, height].map(|size| (size as f64 - 1.0) / 2.0);
    (middle, libm::hypot(middle[0], middle[1]))
}

/// The same grid's sums, weighed by how far within a bound residuals are.
#[inline(always)]
pub(super) fn sums(
    residuals: &[f64],
    (other, gain): (&Gray, f64),
    (rim, every): (usize, usize),
    bound: f64,
) -> Sums {
    let (w, h) = (other.width, other.height);
    let (middle, half) = middle(w, h);
    let (mut normal, mut right, mut kept) = ([[0.0; 5]; 5], [0.0; 5], 0);
    let mut residuals = residuals.iter();
    for y in (rim..h - rim).step_by(every) {
        let [above, here, below] = [y - 1, y, y + 1].map(|y| other.row(y));
        for (x, r) in (rim..w - rim).step_by(every).zip(&mut residuals) {
            let u = r / bound;
            if u.abs() >= 1.0 {
                continue;
            }
            let weight = (1.0 - u * u) * (1.0 - u * u);
            kept += usize::from(weight > 0.5);
            let slope = |a: f32, b: f32| gain * f64::from(a - b) / 2.0;
            let (gx, gy) = (slope(here[x + 1], here[x - 1]), slope(below[x], above[x]));
            let (dx, dy) = (x as f64 - middle[0], y as f64 - middle[1]);
            // The roll is given by the way of a corner, so that all columns are of one size.
            let row = [
                gx,
                gy,
                (gy * dx - gx * dy) / half,
                -f64::from(here[x]) / 100.0,
                -1.0,
            ];
            for (i, a) in row.iter().enumerate() {
                for (sum, b) in normal[i][..=i].iter_mut().zip(&row) {
                    *sum += a * b * weight;
                }
                right[i] -= a * (weight * r);
            }
        }
    }
    Sums {
        normal: SMatrix::from_fn(|i, j| normal[i][j]),
        right: SVector::from(right),
        kept,
    }
}
