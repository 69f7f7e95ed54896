//! What one picture shows of a patch: brightness at its points, made comparable, and its slope.
//!
//! The hottest loops of the refinement. They run over whole lanes of eight, each sum in the same
//! order on every machine, so that wider registers change the time and not the bytes.

use crate::evidence::patch::{Frame, LANES, MOST_POINTS, Window};
use crate::pictures::fixed::STEP;
use crate::pictures::picture::Picture;
use nalgebra::Vector3;

/// What one picture shows of a patch: brightness less its mean (and slope), of unit weighted norm, and how it
/// changes as the patch moves along `N` directions. \[1, 1/mm\]
#[derive(Clone, Copy)]
pub struct Look<const N: usize> {
    /// Brightness, square roots of the window's weights multiplied in.
    pub z: [f32; MOST_POINTS],
    /// Its derivative along each direction. \[1/mm\]
    pub slopes: [[f32; MOST_POINTS]; N],
    /// Weighted variance of the brightness before it was normalised. \[grey levels²\]
    pub variance: f32,
}

impl<const N: usize> Look<N> {
    /// Space for a look that is yet to be read.
    pub const EMPTY: Self = Look {
        z: [0.0; MOST_POINTS],
        slopes: [[0.0; MOST_POINTS]; N],
        variance: 0.0,
    };

    /// Reads a picture at a patch moved outward by `offset` mm; slopes are those of moving it
    /// along each of `toward`. False where it shows nothing.
    #[inline(always)]
    pub fn read(
        &mut self,
        picture: &Picture,
        frame: &Frame,
        offset: f64,
        toward: &[Vector3<f64>; N],
        window: &Window,
    ) -> bool {
        let x = frame.x + frame.normal * offset;
        let base = picture.projection * x.to_homogeneous();
        if base.z <= 0.0 {
            return false;
        }
        let at = [base.x / base.z, base.y / base.z];
        let rows: [Vector3<f64>; 3] =
            [0, 1, 2].map(|r| picture.projection.fixed_view::<1, 3>(r, 0).transpose());
        // Numerators less the base pixel times the denominator, so that f32 does.
        let along = |d: &Vector3<f64>, by: f64| -> [f32; 3] {
            let z = rows[2].dot(d) / base.z * by;
            let xy = |i: usize| rows[i].dot(d) / base.z * by - at[i] * z;
            [xy(0) as f32, xy(1) as f32, z as f32]
        };
        let s = frame.spacing;
        let (du, dv) = (along(&frame.tangents[0], s), along(&frame.tangents[1], s));
        let dn = along(&frame.normal, 1.0);
        let half = frame.shape.map(|k| (k * s * s * 0.5) as f32);
        let [ax, ay] = at.map(|a| a as f32);
        let image = &picture.gray;
        let (wide, tall) = (image.width, image.height);
        let (most_x, most_y) = (wide as f32 - 1.001, tall as f32 - 1.001);
        let count = window.len().min(MOST_POINTS);
        let (us, vs) = (&window.across[..count], &window.down[..count]);
        let mut far = [0.0f32; MOST_POINTS];
        let (mut px, mut py) = ([0.0f32; MOST_POINTS], [0.0f32; MOST_POINTS]);
        let mut outside = 0u32;
        for k in 0..count {
            let (u, v) = (us[k], vs[k]);
            let drop = half[0] * u * u + 2.0 * half[1] * u * v + half[2] * v * v;
            far[k] = 1.0 / (1.0 + u * du[2] + v * dv[2] - drop * dn[2]);
            px[k] = (u * du[0] + v * dv[0] - drop * dn[0]) * far[k];
            py[k] = (u * du[1] + v * dv[1] - drop * dn[1]) * far[k];
            let (x, y) = (ax + px[k], ay + py[k]);
            let within = (x >= 0.0) & (y >= 0.0) & (x < most_x) & (y < most_y);
            outside |= u32::from(!within);
        }
        if outside != 0 {
            return false;
        }
        // The pixel moves by (t.xy − p t.z) / depth as the patch moves along t.
        let moves = toward.map(|t| along(&t, 1.0));
        for k in (0..count).step_by(LANES) {
            let mut corners = [[0i16; LANES]; 4];
            for l in 0..LANES {
                let (x, y) = (ax + px[k + l], ay + py[k + l]);
                let i = y as i32 as usize * wide + x as i32 as usize;
                let (top, bottom) = (&image.data[i..i + 2], &image.data[i + wide..i + wide + 2]);
                (corners[0][l], corners[1][l]) = (top[0], top[1]);
                (corners[2][l], corners[3][l]) = (bottom[0], bottom[1]);
            }
            for l in 0..LANES {
                let (px, py) = (px[k + l], py[k + l]);
                let (x, y) = (ax + px, ay + py);
                let (fx, fy) = (x - (x as i32) as f32, y - (y as i32) as f32);
                let [tl, tr, bl, br] = [0, 1, 2, 3].map(|c| f32::from(corners[c][l]) * STEP);
                let (across_top, across_bottom) = (tr - tl, br - bl);
                let (upper, lower) = (tl + fx * across_top, bl + fx * across_bottom);
                self.z[k + l] = upper + fy * (lower - upper);
                let gx = across_top + fy * (across_bottom - across_top);
                let gy = lower - upper;
                for n in 0..N {
                    let [dx, dy, dz] = moves[n];
                    self.slopes[n][k + l] =
                        (gx * (dx - px * dz) + gy * (dy - py * dz)) * far[k + l];
                }
            }
        }
        self.normalise(window, count);
        true
    }

    /// Takes the mean (and slope across the patch) out, weights the brightness and makes its norm 1;
    /// the derivative follows.
    #[inline(always)]
    fn normalise(&mut self, window: &Window, count: usize) {
        flatten(&mut self.z[..count], window);
        // Weights go half to each factor: later products need none.
        let roots = &window.roots[..count];
        let z = &mut self.z[..count];
        z.iter_mut().zip(roots).for_each(|(z, r)| *z *= r);
        self.variance = dot(z, z);
        let inverse = 1.0 / self.variance.max(1e-4).sqrt();
        z.iter_mut().for_each(|z| *z *= inverse);
        for slope in &mut self.slopes {
            let slope = &mut slope[..count];
            flatten(slope, window);
            let scaled = slope.iter_mut().zip(roots);
            scaled.for_each(|(s, r)| *s *= inverse * r);
            let radial = dot(z, slope);
            let both = slope.iter_mut().zip(z.iter());
            both.for_each(|(s, z)| *s -= z * radial);
        }
    }

    /// Normalised cross-correlation of two looks.
    #[inline(always)]
    pub fn agrees(&self, other: &Self, count: usize) -> f32 {
        dot(&self.z[..count], &other.z[..count])
    }
}

/// Takes mean and, if the window wants it, slope across the patch out of a brightness.
#[inline(always)]
fn flatten(z: &mut [f32], window: &Window) {
    let count = z.len();
    let (us, vs) = (&window.across[..count], &window.down[..count]);
    let weights = &window.weights[..count];
    let mut lanes = [[0.0f32; LANES]; 3];
    for k in (0..count).step_by(LANES) {
        for l in 0..LANES {
            let wz = weights[k + l] * z[k + l];
            lanes[0][l] += wz;
            lanes[1][l] += wz * us[k + l];
            lanes[2][l] += wz * vs[k + l];
        }
    }
    let [mean, a, b] = lanes.map(|l| l.iter().sum::<f32>());
    let (a, b) = if window.level {
        (a / window.spread, b / window.spread)
    } else {
        (0.0, 0.0)
    };
    for k in 0..count {
        z[k] -= mean + a * us[k] + b * vs[k];
    }
}

/// Inner product in eight lanes.
#[inline(always)]
pub fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0f32; LANES];
    let (whole_a, whole_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let beside = whole_a.remainder().iter().zip(whole_b.remainder());
    let rest: f32 = beside.map(|(x, y)| x * y).sum();
    for (x, y) in whole_a.zip(whole_b) {
        (0..LANES).for_each(|i| lanes[i] += x[i] * y[i]);
    }
    lanes.iter().sum::<f32>() + rest
}
