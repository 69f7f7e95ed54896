//! Extrema of scale space, to a part of a pixel (Lowe 2004, §3.1, §4, §5).

use crate::sift_describe::{faded, turn};
use crate::sift_pyramid::{INTERVALS, Octave, SIGMA};
use nalgebra::{Matrix3, Vector3};
use shape::Gray;

/// An extremum in an octave. \[px of the octave\]
#[derive(Debug, Clone, Copy)]
pub struct Extremum {
    /// Column.
    pub x: f32,
    /// Row.
    pub y: f32,
    /// Blur of the image it lies in, with fractions.
    pub scale: f32,
    /// The blurred image nearest to it.
    pub layer: usize,
    /// How strong.
    pub contrast: f32,
}

/// The extrema of an octave with at least this contrast (levels of 255), edges left out.
pub fn extrema(octave: &Octave, contrast: f32, edge: f32) -> Vec<Extremum> {
    let blurred = &octave.blurred;
    let (w, h) = (blurred[0].width, blurred[0].height);
    // Three rows of each difference, row y in place y % 3.
    let mut d = vec![[vec![0.0f32; w], vec![0.0; w], vec![0.0; w]]; INTERVALS + 2];
    let mut found = Vec::new();
    for y in 4..h - 4 {
        for (layer, rows) in d.iter_mut().enumerate() {
            let (finer, coarser) = (blurred[layer].row(y), blurred[layer + 1].row(y));
            for ((d, a), b) in rows[y % 3].iter_mut().zip(coarser).zip(finer) {
                *d = a - b;
            }
        }
        if y < 6 {
            continue;
        }
        let middle = y - 1;
        for layer in 1..=INTERVALS {
            let row = &d[layer][middle % 3];
            for (x, v) in row.iter().enumerate().take(w - 5).skip(5) {
                if v.abs() >= 0.5 * contrast && is_extremum(&d, layer, x, middle, *v) {
                    found.extend(refined(blurred, layer, x, middle, contrast, edge));
                }
            }
        }
    }
    found
}

fn is_extremum(d: &[[Vec<f32>; 3]], layer: usize, x: usize, y: usize, v: f32) -> bool {
    let sign = v.signum();
    for l in [layer, layer - 1, layer + 1] {
        for (i, row) in d[l].iter().enumerate() {
            for (k, n) in row[x - 1..=x + 1].iter().enumerate() {
                let itself = l == layer && i == y % 3 && k == 1;
                if !itself && n * sign >= v * sign {
                    return false;
                }
            }
        }
    }
    true
}

/// The extremum of the quadratic through the neighbours (Brown and Lowe 2002).
fn refined(
    blurred: &[Gray],
    mut layer: usize,
    mut x: usize,
    mut y: usize,
    contrast: f32,
    edge: f32,
) -> Option<Extremum> {
    let (w, h) = (blurred[0].width, blurred[0].height);
    for _ in 0..5 {
        let at = |l: i32, dx: i32, dy: i32| {
            let (x, y) = ((x as i32 + dx) as usize, (y as i32 + dy) as usize);
            let l = (layer as i32 + l) as usize;
            f64::from(blurred[l + 1].at(x, y) - blurred[l].at(x, y))
        };
        let v = at(0, 0, 0);
        let g = Vector3::new(
            at(0, 1, 0) - at(0, -1, 0),
            at(0, 0, 1) - at(0, 0, -1),
            at(1, 0, 0) - at(-1, 0, 0),
        ) / 2.0;
        let second = |a: f64, b: f64| a + b - 2.0 * v;
        let xx = second(at(0, 1, 0), at(0, -1, 0));
        let yy = second(at(0, 0, 1), at(0, 0, -1));
        let ss = second(at(1, 0, 0), at(-1, 0, 0));
        let xy = (at(0, 1, 1) + at(0, -1, -1) - at(0, 1, -1) - at(0, -1, 1)) / 4.0;
        let xs = (at(1, 1, 0) + at(-1, -1, 0) - at(1, -1, 0) - at(-1, 1, 0)) / 4.0;
        let ys = (at(1, 0, 1) + at(-1, 0, -1) - at(1, 0, -1) - at(-1, 0, 1)) / 4.0;
        let off = -(Matrix3::new(xx, xy, xs, xy, yy, ys, xs, ys, ss).try_inverse()? * g);
        if off.amax() > 0.6 {
            let move_by = |c: usize, o: f64| (c as f64 + o.round().clamp(-1.0, 1.0)) as usize;
            (x, y, layer) = (move_by(x, off.x), move_by(y, off.y), move_by(layer, off.z));
            if !(1..=INTERVALS).contains(&layer) || x < 5 || y < 5 || x + 5 >= w || y + 5 >= h {
                return None;
            }
            continue;
        }
        let peak = v + 0.5 * g.dot(&off);
        let (trace, det) = (xx + yy, xx * yy - xy * xy);
        let r = f64::from(edge);
        if peak.abs() < f64::from(contrast)
            || det <= 0.0
            || trace * trace * r >= (r + 1.0) * (r + 1.0) * det
        {
            return None;
        }
        let s = layer as f64 + off.z;
        return Some(Extremum {
            x: (x as f64 + off.x) as f32,
            y: (y as f64 + off.y) as f32,
            scale: SIGMA * 2f64.powf(s / INTERVALS as f64) as f32,
            layer: (s.round() as usize).clamp(0, INTERVALS + 2),
            contrast: peak.abs() as f32,
        });
    }
    None
}

/// The directions of a point: peaks of a histogram of gradients around it, at least four fifths of
/// the highest. \[rad\]
pub fn orientations(image: &Gray, e: &Extremum, fading: &[f32]) -> Vec<f32> {
    const BINS: usize = 36;
    let mut bins = [0f32; BINS];
    let sigma = 1.5 * e.scale;
    let radius = (3.0 * sigma).round() as i32;
    let (cx, cy) = (e.x.round() as i32, e.y.round() as i32);
    for dy in -radius..=radius {
        for dx in -radius..=radius {
            let (x, y) = (cx + dx, cy + dy);
            if x < 1 || y < 1 || x as usize + 1 >= image.width || y as usize + 1 >= image.height {
                continue;
            }
            let (x, y) = (x as usize, y as usize);
            let (gx, gy) = (
                image.at(x + 1, y) - image.at(x - 1, y),
                image.at(x, y + 1) - image.at(x, y - 1),
            );
            let weight = faded(fading, (dx * dx + dy * dy) as f32 / (2.0 * sigma * sigma));
            bins[(turn(gx, gy) * BINS as f32 + 0.5) as usize % BINS] +=
                weight * (gx * gx + gy * gy).sqrt();
        }
    }
    for _ in 0..2 {
        let b = bins;
        (0..BINS)
            .for_each(|i| bins[i] = (b[(i + BINS - 1) % BINS] + b[i] + b[(i + 1) % BINS]) / 3.0);
    }
    let most = bins.iter().copied().fold(0.0, f32::max);
    let peak = |i: usize| {
        let (l, c, r) = (bins[(i + BINS - 1) % BINS], bins[i], bins[(i + 1) % BINS]);
        let high = c > l && c > r && c >= 0.8 * most && c > 0.0;
        high.then(|| {
            (i as f32 + 0.5 * (l - r) / (l - 2.0 * c + r)) / BINS as f32 * std::f32::consts::TAU
        })
    };
    (0..BINS).filter_map(peak).collect()
}
