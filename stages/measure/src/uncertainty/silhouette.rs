//! A girth from silhouettes alone: each photo's two borders beside a level section are tangents,
//! and the length of a convex curve is the integral of its support function (Cauchy 1841):
//! L = ∫ h(θ) dθ.

use nalgebra::{DMatrix, DVector, Point2, Point3};
use shape::{Camera, Mask, bilinear};
use std::f64::consts::TAU;

/// A tangent of a level section: its outward normal's angle, and its distance from an origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    /// Angle of the outward normal. \[rad\]
    pub angle: f64,
    /// Distance from the origin. \[mm\]
    pub support: f64,
    /// Whether it is the body's left border in the picture.
    pub is_left: bool,
}

/// How far from the surface a border is looked for. By hand: not on record. \[mm\]
const REACH_MM: f64 = 30.0;
/// How near a line of sight may come to another limb, as a share of the section's half breadth: as limbs sway. By hand:
/// not on record.
const CLEARANCE_SHARE: f64 = 0.08;

/// How much of a pixel is body, between pixels. `None` outside the mask.
fn cover(mask: &Mask, at: Point2<f64>) -> Option<f64> {
    let (x, y) = (at.x.floor(), at.y.floor());
    if x < 0.0 || y < 0.0 || x + 1.0 >= mask.width as f64 || y + 1.0 >= mask.height as f64 {
        return None;
    }
    let (i, j, s, t) = (x as usize, y as usize, at.x - x, at.y - y);
    let v = |di, dj| f64::from(mask.at(i + di, j + dj));
    Some(bilinear([v(0, 0), v(1, 0), v(0, 1), v(1, 1)], [s, t]))
}

/// The two tangents that one photo gives of a level section, where its borders show and no other
/// limb's outline is near. `curve` and `beside` are at one height; `origin` is what supports are from.
pub fn tangents(
    curve: &[Point3<f64>],
    beside: &[&[Point3<f64>]],
    origin: Point3<f64>,
    camera: &Camera,
    mask: &Mask,
) -> Vec<Tangent> {
    let eye = camera.pose.centre();
    let wide = curve.iter().map(|p| (p - origin).norm());
    let clearance = CLEARANCE_SHARE * wide.fold(0.0, f64::max);
    let lens = camera.lens.resized(mask.width as u32, mask.height as u32);
    let side = |turn: f64| -> Option<Tangent> {
        // The outward normal of the line from the eye to a point, on this side.
        let normal = |p: &Point3<f64>| {
            let (dx, dy) = (p.x - eye.x, p.y - eye.y);
            let length = libm::hypot(dx, dy);
            (length > 1.0).then(|| (turn * dy / length, -turn * dx / length))
        };
        let axis = normal(&origin)?;
        let lean = |p: &Point3<f64>| {
            let (dx, dy) = (p.x - eye.x, p.y - eye.y);
            (axis.0 * dx + axis.1 * dy) / libm::hypot(dx, dy)
        };
        let touch = curve
            .iter()
            .max_by(|a, b| lean(a).total_cmp(&lean(b)))
            .copied()?;
        let n = normal(&touch)?;
        let out = |p: &Point3<f64>| n.0 * (p.x - touch.x) + n.1 * (p.y - touch.y);
        // The line of sight must pass every other limb, on one side or the other.
        let met = |other: &&[Point3<f64>]| {
            let (near, far) = other
                .iter()
                .map(out)
                .fold((f64::MAX, f64::MIN), |e, d| (e.0.min(d), e.1.max(d)));
            near < clearance && far > -clearance
        };
        if beside.iter().any(met) {
            return None;
        }
        let at = |d: f64| Point3::new(touch.x + n.0 * d, touch.y + n.1 * d, touch.z);
        let seen = |d: f64| cover(mask, lens.project(&camera.pose.apply(&at(d)))?);
        // Outward from within: the crossing nearest to the surface (structural: samples, between which it is straight).
        // \[mm\]
        const STEP_MM: f64 = 0.5;
        let count = (2.0 * REACH_MM / STEP_MM) as usize;
        let values: Vec<Option<f64>> = (0..=count)
            .map(|i| seen(-REACH_MM + STEP_MM * i as f64))
            .collect();
        let crossing = (0..count)
            .filter_map(|i| {
                let (a, b) = (values[i]?, values[i + 1]?);
                let falls = a > 127.5 && b <= 127.5;
                falls.then(|| -REACH_MM + STEP_MM * (i as f64 + (a - 127.5) / (a - b)))
            })
            .min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let border = at(crossing);
        let n = normal(&border)?;
        Some(Tangent {
            angle: libm::atan2(n.1, n.0),
            support: n.0 * (border.x - origin.x) + n.1 * (border.y - origin.y),
            is_left: turn < 0.0,
        })
    };
    [1.0, -1.0].into_iter().filter_map(side).collect()
}

/// A girth by Cauchy's formula, and its standard deviation from how the tangents disagree: each on its own, and all on the
/// left of the picture with all on its right. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// The girth.
    pub girth: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// How many tangents hold it.
    pub tangents: usize,
}

/// Fewer tangents give no girth: two for each unknown of the lower order (derived).
const MIN_TANGENTS: usize = 2 * (1 + 2 * 4);
/// Widest stretch of directions without a tangent. By hand: not on record. \[rad\]
const WIDEST_GAP_RAD: f64 = 60.0 * TAU / 360.0;

/// Fits the support function as a trigonometric polynomial (robustly: Huber weights) and
/// integrates it. `None` with fewer than 18 tangents or with a wide gap between them.
pub fn support_girth(tangents: &[Tangent]) -> Option<Support> {
    let n = tangents.len();
    if n < MIN_TANGENTS {
        return None;
    }
    let mut angles: Vec<f64> = tangents.iter().map(|t| t.angle.rem_euclid(TAU)).collect();
    angles.sort_by(f64::total_cmp);
    let gap = (0..n)
        .map(|i| (angles[(i + 1) % n] - angles[i]).rem_euclid(TAU))
        .fold(0.0, f64::max);
    if gap > WIDEST_GAP_RAD {
        return None;
    }
    let order = if n >= 28 && gap < WIDEST_GAP_RAD / 1.5 {
        6
    } else {
        4
    };
    let unknowns = 1 + 2 * order;
    let row = |t: &Tangent, j: usize| match j {
        0 => 1.0,
        j if j % 2 == 1 => libm::cos(j.div_ceil(2) as f64 * t.angle),
        j => libm::sin((j / 2) as f64 * t.angle),
    };
    let design = DMatrix::from_fn(n, unknowns, |i, j| row(&tangents[i], j));
    let want = DVector::from_iterator(n, tangents.iter().map(|t| t.support));
    let mut weights = vec![1.0; n];
    let mut fit = DVector::zeros(unknowns);
    let mut off = DVector::zeros(n);
    let mut spread = 0.0;
    for _ in 0..12 {
        let weighted = DMatrix::from_fn(n, unknowns, |i, j| weights[i] * design[(i, j)]);
        let mut normal = design.transpose() * &weighted;
        // High harmonics of a body are small: a faint pull to zero keeps sparse tangents tame.
        for j in 1..unknowns {
            normal[(j, j)] += 1e-4 * n as f64 * (j.div_ceil(2) as f64).powi(4) / 16.0;
        }
        fit = normal.cholesky()?.solve(&(weighted.transpose() * &want));
        off = &want - &design * &fit;
        let mut sizes: Vec<f64> = off.iter().map(|e| e.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        // Scatter by the median, freed of the unknowns fitted.
        spread = 1.4826 * sizes[n / 2] * (n as f64 / (n - unknowns) as f64).sqrt();
        let limit = (1.5 * spread).max(0.05);
        for (weight, e) in weights.iter_mut().zip(off.iter()) {
            *weight = (limit / e.abs().max(1e-12)).min(1.0);
        }
    }
    let random = spread / (n as f64).sqrt();
    Some(Support {
        girth: TAU * fit[0],
        sigma: TAU * libm::hypot(random, sides_apart(tangents, off.as_slice(), random)),
        tangents: n,
    })
}

/// By how much the mean support is off where one side of the picture has wrong borders, as before a background of the
/// body's colour: each direction is seen from both sides, so by half of what their means differ, less what chance makes of
/// it, which is the mean's own `random` deviation. \[mm\]
fn sides_apart(tangents: &[Tangent], off: &[f64], random: f64) -> f64 {
    let mean = |is_left: bool| {
        let side = tangents
            .iter()
            .zip(off)
            .filter(|(t, _)| t.is_left == is_left);
        let (sum, n) = side.fold((0.0, 0), |(sum, n), (_, e)| (sum + e, n + 1));
        sum / f64::from(n.max(1))
    };
    let half = (mean(true) - mean(false)) / 2.0;
    (half * half - random * random).max(0.0).sqrt()
}

/// How far borders are outside of a section, on the mean, and its standard deviation: for a section that no borders show all
/// around. A hull is what no border cuts off, so where borders err, it is too small by this. \[mm\]
pub(crate) fn beyond(
    tangents: &[Tangent],
    curve: &[Point3<f64>],
    origin: Point3<f64>,
) -> Option<(f64, f64)> {
    let n = tangents.len();
    if n < MIN_TANGENTS {
        return None;
    }
    let off = tangents.iter().map(|t| {
        let (s, c) = libm::sincos(t.angle);
        let out = curve
            .iter()
            .map(|p| c * (p.x - origin.x) + s * (p.y - origin.y));
        t.support - out.fold(f64::MIN, f64::max)
    });
    let off: Vec<f64> = off.collect();
    let mean = off.iter().sum::<f64>() / n as f64;
    let square: f64 = off.iter().map(|e| (e - mean) * (e - mean)).sum();
    let random = (square / (n * (n - 1)) as f64).sqrt();
    Some((
        mean,
        libm::hypot(random, sides_apart(tangents, &off, random)),
    ))
}
