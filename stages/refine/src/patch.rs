//! A patch of the surface, carried into the pictures that see it, and how well they agree there.
//!
//! The paper carries a patch of `I_j` onto the surface and from there into `I_i` (eq. 1). Here the
//! patch lives on the surface: each picture is read at the same points of it, which is the same
//! dual projection without preferring one picture's grid. The patch is not flat but bends as the
//! surface does, by its shape operator: a flat one would pull a limb inward.

use crate::picture::Picture;
use nalgebra::{Point3, Vector3};

/// Most points of a patch.
pub const MOST_POINTS: usize = 121;
/// Most pictures that are compared at a vertex.
pub const MOST_SIGHTS: usize = 10;

/// The points of a patch, in units of its spacing, and their weights, which sum to 1.
pub struct Window {
    /// Column, row.
    pub points: Vec<[f32; 2]>,
    /// A Gaussian, so that the patch has no edge.
    pub weights: Vec<f32>,
    /// Weighted mean square of a coordinate.
    spread: f32,
    /// Whether a linear change of brightness across the patch is taken out, like its mean: light
    /// that falls on a turning body shades it anew in each photo, and shade is nearly linear.
    pub level: bool,
}

impl Window {
    /// `2 half + 1` points a side, at most 11.
    pub fn new(half: usize, level: bool) -> Self {
        let half = half.clamp(1, 5) as i32;
        let sigma = half as f32 * 0.7;
        let side = -half..=half;
        let points: Vec<_> = side
            .clone()
            .flat_map(|v| side.clone().map(move |u| [u as f32, v as f32]))
            .collect();
        let raw = points
            .iter()
            .map(|p| (-(p[0] * p[0] + p[1] * p[1]) / (2.0 * sigma * sigma)).exp());
        let total: f32 = raw.clone().sum();
        let weights: Vec<f32> = raw.map(|w| w / total).collect();
        let squares = points.iter().zip(&weights).map(|(p, w)| w * p[0] * p[0]);
        let spread = squares.sum();
        Window {
            points,
            weights,
            spread,
            level,
        }
    }

    /// Takes mean and, if asked, slope across the patch out of a brightness.
    fn flatten(&self, z: &mut [f32]) {
        let mut sums = [0.0f32; 3];
        for ((z, w), p) in z.iter().zip(&self.weights).zip(&self.points) {
            let wz = w * z;
            sums[0] += wz;
            sums[1] += wz * p[0];
            sums[2] += wz * p[1];
        }
        let [mean, a, b] = sums;
        let (a, b) = if self.level {
            (a / self.spread, b / self.spread)
        } else {
            (0.0, 0.0)
        };
        for (z, p) in z.iter_mut().zip(&self.points) {
            *z -= mean + a * p[0] + b * p[1];
        }
    }
}

/// Where a patch lies and how it bends. Held while the vertex moves along the normal.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// The vertex. \[mm\]
    pub x: Point3<f64>,
    /// Its unit normal.
    pub normal: Vector3<f64>,
    /// Two tangents, right-handed with the normal.
    pub tangents: [Vector3<f64>; 2],
    /// The shape operator in the tangents: height is `−½(l u² + 2 m u v + n v²)`. \[1/mm\]
    pub shape: [f64; 3],
    /// Distance of the patch's points. \[mm\]
    pub spacing: f64,
}

/// One picture that sees a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Which.
    pub picture: u16,
    /// How much it counts.
    pub weight: f32,
    /// Unit vector towards the camera.
    pub toward: [f32; 3],
}

/// What one picture shows of a patch: brightness less its mean (and slope), of unit weighted norm, and how it
/// changes as the patch moves outward. \[1, 1/mm\]
#[derive(Clone, Copy)]
pub struct Look {
    /// Brightness, square roots of the window's weights multiplied in.
    pub z: [f32; MOST_POINTS],
    /// Its derivative. \[1/mm\]
    pub slope: [f32; MOST_POINTS],
    /// Weighted variance of the brightness before it was normalised. \[grey levels²\]
    pub variance: f32,
}

impl Look {
    /// Nothing yet.
    pub const EMPTY: Look = Look {
        z: [0.0; MOST_POINTS],
        slope: [0.0; MOST_POINTS],
        variance: 0.0,
    };

    /// Reads a picture at a patch moved outward by `offset` mm; slopes are those of moving it
    /// along `toward`. False where it shows nothing.
    pub fn read<const SLOPE: bool>(
        &mut self,
        picture: &Picture,
        frame: &Frame,
        offset: f64,
        toward: &Vector3<f64>,
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
        let dt = along(toward, 1.0);
        let half = frame.shape.map(|k| (k * s * s * 0.5) as f32);
        let [ax, ay] = at.map(|a| a as f32);
        let image = &picture.gray;
        let (wide, tall) = (image.width, image.height);
        let (most_x, most_y) = (wide as f32 - 1.001, tall as f32 - 1.001);
        let count = window.points.len();
        for k in 0..count {
            let [u, v] = window.points[k];
            let drop = half[0] * u * u + 2.0 * half[1] * u * v + half[2] * v * v;
            let far = 1.0 / (1.0 + u * du[2] + v * dv[2] - drop * dn[2]);
            let px = (u * du[0] + v * dv[0] - drop * dn[0]) * far;
            let py = (u * du[1] + v * dv[1] - drop * dn[1]) * far;
            let (x, y) = (ax + px, ay + py);
            if !(x >= 0.0 && y >= 0.0 && x < most_x && y < most_y) {
                return false;
            }
            let (cx, cy) = (x as usize, y as usize);
            let (fx, fy) = (x - cx as f32, y - cy as f32);
            let i = cy * wide + cx;
            let (top, bottom) = (&image.data[i..i + 2], &image.data[i + wide..i + wide + 2]);
            let (across_top, across_bottom) = (top[1] - top[0], bottom[1] - bottom[0]);
            let (upper, lower) = (top[0] + fx * across_top, bottom[0] + fx * across_bottom);
            let value = upper + fy * (lower - upper);
            self.z[k] = value;
            if SLOPE {
                // The pixel moves by (t.xy − p t.z) / depth as the patch moves along t.
                let gx = across_top + fy * (across_bottom - across_top);
                let gy = lower - upper;
                let moves = [dt[0] - px * dt[2], dt[1] - py * dt[2]];
                self.slope[k] = (gx * moves[0] + gy * moves[1]) * far;
            }
        }
        window.flatten(&mut self.z[..count]);
        if SLOPE {
            window.flatten(&mut self.slope[..count]);
        }
        let squares = self.z[..count].iter().zip(&window.weights);
        let variance: f32 = squares.map(|(z, w)| w * z * z).sum();
        self.variance = variance;
        let inverse = 1.0 / variance.max(1e-4).sqrt();
        let mut radial = 0.0f32;
        for k in 0..count {
            // Weights go half to each factor: later products need none.
            let root = window.weights[k].sqrt();
            self.z[k] *= inverse * root;
            if SLOPE {
                self.slope[k] *= inverse * root;
                radial += self.z[k] * self.slope[k];
            }
        }
        if SLOPE {
            (0..count).for_each(|k| self.slope[k] -= self.z[k] * radial);
        }
        true
    }

    /// Normalised cross-correlation of two looks.
    pub fn agrees(&self, other: &Look, count: usize) -> f32 {
        dot(&self.z[..count], &other.z[..count])
    }
}

/// Inner product in eight lanes.
pub fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0f32; 8];
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = a8
        .remainder()
        .iter()
        .zip(b8.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a8.zip(b8) {
        (0..8).for_each(|i| lanes[i] += x[i] * y[i]);
    }
    lanes.iter().sum::<f32>() + rest
}

/// How well the pictures agree at a vertex (paper, eq. 1), and how that changes outward.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Agreement {
    /// Weighted sum of the correlations of all pairs, Ω of eq. 1.
    pub score: f64,
    /// Sum of the pairs' weights: the greatest score there can be.
    pub weight: f64,
    /// Derivative of the score along the normal, ψ of eq. 4. \[1/mm\]
    pub slope: f64,
    /// Its stiffness by Gauss and Newton: `Σ w |dz_i − dz_j|²`. \[1/mm²\]
    pub stiffness: f64,
}

/// Which pairs are compared.
#[derive(Debug, Clone, Copy)]
pub struct Pairing {
    /// Least and greatest cosine of the angle between two lines of sight.
    pub cosine: [f32; 2],
}

impl Pairing {
    /// Whether two pictures are compared.
    #[inline]
    pub fn takes(&self, a: &Sight, b: &Sight) -> bool {
        let cosine: f32 = (0..3).map(|i| a.toward[i] * b.toward[i]).sum();
        cosine >= self.cosine[0] && cosine <= self.cosine[1]
    }
}

/// Compares all pairs of sights at a vertex moved outward by `offset` mm. With `SLOPE` the
/// derivative and the stiffness too: exact for this very score, weights, frame and sights held.
pub fn agreement<const SLOPE: bool>(
    pictures: &[Picture],
    sights: &[Sight],
    frame: &Frame,
    offset: f64,
    window: &Window,
    pairing: Pairing,
) -> Agreement {
    let mut looks = [Look::EMPTY; MOST_SIGHTS];
    let mut seen = [false; MOST_SIGHTS];
    for (i, sight) in sights.iter().enumerate().take(MOST_SIGHTS) {
        let picture = &pictures[sight.picture as usize];
        seen[i] = looks[i].read::<SLOPE>(picture, frame, offset, &frame.normal, window);
    }
    let mut sum = Agreement::default();
    let count = window.points.len();
    for i in 0..sights.len().min(MOST_SIGHTS) {
        for j in i + 1..sights.len().min(MOST_SIGHTS) {
            if !pairing.takes(&sights[i], &sights[j]) {
                continue;
            }
            let w = f64::from(sights[i].weight * sights[j].weight);
            sum.weight += w;
            if !(seen[i] && seen[j]) {
                continue;
            }
            let (a, b) = (&looks[i], &looks[j]);
            sum.score += w * f64::from(a.agrees(b, count));
            if SLOPE {
                let (sa, sb) = (&a.slope[..count], &b.slope[..count]);
                let (cross, turn) = (dot(sa, &b.z[..count]), dot(&a.z[..count], sb));
                sum.slope += w * f64::from(cross + turn);
                let square = dot(sa, sa) + dot(sb, sb) - 2.0 * dot(sa, sb);
                sum.stiffness += w * f64::from(square.max(0.0));
            }
        }
    }
    sum
}
