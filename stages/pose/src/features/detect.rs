//! Extrema of scale space, to a part of a pixel (Lowe 2004, §3.1, §4, §5).

use crate::features::gradients::{AT_ONCE, Row, faded};
use crate::features::pyramid::{INTERVALS, Octave, SIGMA};
use nalgebra::{Matrix3, Vector3};
use shape::Gray;
use stage::machine::widest;

/// An extremum in an octave. \[px of the octave\]
#[derive(Debug, Clone, Copy)]
pub struct Extremum {
    /// Column.
    pub x: f32,
    /// Row.
    pub y: f32,
    /// Blur of the image it is in, with fractions.
    pub scale: f32,
    /// The blurred image nearest to it.
    pub layer: usize,
    /// How strong.
    pub contrast: f32,
}

/// The extrema of an octave with at least this contrast (levels of 255), edges left out.
pub fn extrema(octave: &Octave, contrast: f32, edge: f32) -> Vec<Extremum> {
    widest(
        #[inline(always)]
        || search(octave, contrast, edge),
    )
}

#[inline(always)]
fn search(octave: &Octave, contrast: f32, edge: f32) -> Vec<Extremum> {
    let blurred = &octave.blurred;
    let (w, h) = (blurred[0].width, blurred[0].height);
    // Three rows of each difference, row y in place y % 3.
    let mut d = vec![[vec![0.0f32; w], vec![0.0; w], vec![0.0; w]]; INTERVALS + 2];
    let mut around = Around {
        high: vec![0.0; w],
        low: vec![0.0; w],
    };
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
            around.look(&d[layer], middle % 3);
            let row = &d[layer][middle % 3];
            around.standing_out(row, 0.5 * contrast, |x| {
                if (5..w - 5).contains(&x) && is_extremum(&d, layer, x, middle, row[x]) {
                    found.extend(refined(blurred, layer, x, middle, contrast, edge));
                }
            });
        }
    }
    found
}

/// The highest and lowest of the eight neighbours of each pixel of a row in its own layer.
struct Around {
    high: Vec<f32>,
    low: Vec<f32>,
}

impl Around {
    #[inline(always)]
    fn look(&mut self, rows: &[Vec<f32>; 3], middle: usize) {
        let max = |a: f32, b: f32| if a > b { a } else { b };
        let min = |a: f32, b: f32| if a < b { a } else { b };
        let [a, m, b] = [middle, (middle + 1) % 3, (middle + 2) % 3].map(|i| &rows[i][..]);
        // The row itself is `a`; its neighbours are above and below it.
        let n = a.len() - 2;
        let (a0, a2) = (&a[..n], &a[2..]);
        let (m0, m1, m2) = (&m[..n], &m[1..=n], &m[2..]);
        let (b0, b1, b2) = (&b[..n], &b[1..=n], &b[2..]);
        let (high, low) = (&mut self.high[1..=n], &mut self.low[1..=n]);
        for i in 0..n {
            let side = max(max(a0[i], a2[i]), max(m1[i], b1[i]));
            let corner = max(max(m0[i], m2[i]), max(b0[i], b2[i]));
            high[i] = max(side, corner);
            let side = min(min(a0[i], a2[i]), min(m1[i], b1[i]));
            let corner = min(min(m0[i], m2[i]), min(b0[i], b2[i]));
            low[i] = min(side, corner);
        }
    }

    /// Calls `see` with the extremes among those, at least so far from 0, left to right.
    #[inline(always)]
    fn standing_out(&self, row: &[f32], least: f32, mut see: impl FnMut(usize)) {
        /// Columns that are worked on side by side (structural: speed alone).
        const AT_ONCE: usize = 16;
        let out =
            |v: f32, high: f32, low: f32| (v >= least) & (v > high) | (v <= -least) & (v < low);
        let blocks = row.chunks(AT_ONCE).zip(self.high.chunks(AT_ONCE));
        for (k, ((v, high), low)) in blocks.zip(self.low.chunks(AT_ONCE)).enumerate() {
            let mut any = false;
            for i in 0..v.len() {
                any |= out(v[i], high[i], low[i]);
            }
            if any {
                let some = (0..v.len()).filter(|i| out(v[*i], high[*i], low[*i]));
                some.for_each(|i| see(k * AT_ONCE + i));
            }
        }
    }
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
            scale: SIGMA * libm::pow(2f64, s / INTERVALS as f64) as f32,
            layer: (s.round() as usize).clamp(0, INTERVALS + 2),
            contrast: peak.abs() as f32,
        });
    }
    None
}

/// The directions of a point: peaks of a histogram of gradients around it, at least four fifths of
/// the highest. \[rad\]
pub fn orientations(image: &Gray, e: &Extremum, fading: &[f32]) -> Vec<f32> {
    /// Directions are counted in bins of 10° (Lowe 2004, §5).
    const BINS: usize = 36;
    let mut bins = [0f32; BINS];
    let sigma = 1.5 * e.scale;
    let radius = (3.0 * sigma).round() as i32;
    let (cx, cy) = (e.x.round() as i32, e.y.round() as i32);
    let mut row = Row::default();
    let (least, most) = (
        (cx - radius).max(1),
        (cx + radius).min(image.width as i32 - 2),
    );
    for y in (cy - radius).max(1)..=(cy + radius).min(image.height as i32 - 2) {
        for start in (least..=most).step_by(AT_ONCE) {
            let count = AT_ONCE.min((most - start + 1) as usize);
            row.look(image, start as usize, y as usize, count);
            for i in 0..count {
                let (dx, dy) = (start + i as i32 - cx, y - cy);
                let weight = faded(fading, (dx * dx + dy * dy) as f32 / (2.0 * sigma * sigma));
                bins[(row.turn[i] * BINS as f32 + 0.5) as usize % BINS] += weight * row.steep[i];
            }
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
