//! What surrounds a point: histograms of gradients in its own direction (Lowe 2004, §6), as square
//! roots (Arandjelović and Zisserman 2012).

use crate::sift_detect::Extremum;
use shape::Gray;

const CELLS: usize = 4;
const BINS: usize = 8;
/// Width of a cell in scales.
const CELL_SCALES: f32 = 3.0;

/// The descriptor of a point with a direction. \[rad\]
pub fn describe(image: &Gray, e: &Extremum, angle: f32, fading: &[f32]) -> [u8; 128] {
    let (sin, cos) = angle.sin_cos();
    let cell = CELL_SCALES * e.scale;
    let half = CELLS as f32 / 2.0;
    let radius = (cell * std::f32::consts::SQRT_2 * (half + 0.5)).round() as i32;
    let mut bins = [0f32; CELLS * CELLS * BINS];
    let (cx, cy) = (e.x.round() as i32, e.y.round() as i32);
    for y in (cy - radius).max(1)..=(cy + radius).min(image.height as i32 - 2) {
        for x in (cx - radius).max(1)..=(cx + radius).min(image.width as i32 - 2) {
            let (dx, dy) = ((x as f32 - e.x) / cell, (y as f32 - e.y) / cell);
            let (u, v) = (cos * dx + sin * dy, cos * dy - sin * dx);
            let (bu, bv) = (u + half - 0.5, v + half - 0.5);
            if bu <= -1.0 || bv <= -1.0 || bu >= CELLS as f32 || bv >= CELLS as f32 {
                continue;
            }
            let (px, py) = (x as usize, y as usize);
            let gx = image.at(px + 1, py) - image.at(px - 1, py);
            let gy = image.at(px, py + 1) - image.at(px, py - 1);
            let weight =
                faded(fading, (u * u + v * v) / (2.0 * half * half)) * (gx * gx + gy * gy).sqrt();
            let from = turn(gx, gy) - angle / std::f32::consts::TAU;
            let bo = (if from < 0.0 { from + 1.0 } else { from }) * BINS as f32;
            spread(&mut bins, bu, bv, bo, weight);
        }
    }
    let norm = |b: &[f32]| b.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-12);
    let length = norm(&bins);
    bins.iter_mut().for_each(|b| *b = (*b / length).min(0.2));
    let total = bins.iter().sum::<f32>().max(1e-12);
    let mut out = [0; 128];
    for (o, b) in out.iter_mut().zip(&bins) {
        *o = ((b / total).sqrt() * 512.0).round().min(255.0) as u8;
    }
    out
}

/// The direction of a gradient in turns, 0..=1 (Abramowitz and Stegun 4.4.49: to 2e-6 of a turn).
pub(crate) fn turn(gx: f32, gy: f32) -> f32 {
    let (ax, ay) = (gx.abs(), gy.abs());
    let (low, high) = if ax < ay { (ax, ay) } else { (ay, ax) };
    let a = low / (high + 1e-20);
    let s = a * a;
    let arc =
        a * (0.999_866 + s * (-0.330_299_5 + s * (0.180_141 + s * (-0.085_133 + s * 0.020_835_1))));
    let first = arc * (1.0 / std::f32::consts::TAU);
    let half = if ax < ay { 0.25 - first } else { first };
    let upper = if gx < 0.0 { 0.5 - half } else { half };
    if gy < 0.0 { 1.0 - upper } else { upper }
}

/// exp(-x) for 0 <= x < 8 in steps of 1/128.
pub fn fading() -> Vec<f32> {
    (0..1024)
        .map(|i| (-(i as f32 + 0.5) / 128.0).exp())
        .collect()
}

/// Looks up [`fading`]; nothing beyond its end.
pub(crate) fn faded(table: &[f32], x: f32) -> f32 {
    table.get((x * 128.0) as usize).copied().unwrap_or(0.0)
}

/// Adds a gradient to the eight bins around it.
fn spread(bins: &mut [f32], u: f32, v: f32, o: f32, weight: f32) {
    // Truncation of what is at least -1, moved by one, is the floor.
    let (u0, v0, o0) = ((u + 1.0) as i32 - 1, (v + 1.0) as i32 - 1, o as usize);
    let (fu, fv, fo) = (u - u0 as f32, v - v0 as f32, o - o0 as f32);
    for (du, wu) in [(0, 1.0 - fu), (1, fu)] {
        for (dv, wv) in [(0, 1.0 - fv), (1, fv)] {
            let (cu, cv) = (u0 + du, v0 + dv);
            if cu < 0 || cv < 0 || cu >= CELLS as i32 || cv >= CELLS as i32 {
                continue;
            }
            for (d, wo) in [(0, 1.0 - fo), (1, fo)] {
                let bin = (o0 + d) % BINS;
                bins[(cv as usize * CELLS + cu as usize) * BINS + bin] += weight * wu * wv * wo;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_those_of_the_arc_tangent() {
        for k in 0..1000 {
            let angle = (k as f32 + 0.3) / 1000.0 * std::f32::consts::TAU;
            let (sin, cos) = angle.sin_cos();
            let got = turn(7.0 * cos, 7.0 * sin) * std::f32::consts::TAU;
            assert!((got - angle).abs() < 2e-5, "{got} {angle}");
        }
        assert!((0.0..=1.0).contains(&turn(0.0, 0.0)));
    }
}
