//! A girth from silhouettes alone: each photo's two borders beside a level section are tangents,
//! and the length of a convex curve is the integral of its support function (Cauchy 1841):
//! L = ∫ h(θ) dθ.

use crate::uncertainty::periodic::spline;
use nalgebra::{Point2, Point3};
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

/// How far from the surface a border is looked for. By hand: looked at five captures, at 0.7 and 1.4 of it: one interval changes by 24
/// %, three by at most 12 %. \[mm\]
const REACH_MM: f64 = 30.0;
/// How near a line of sight may come to another limb, as a share of the section's half breadth: as limbs sway. By hand:
/// looked at five captures, at 0.7 and 1.4 of it: intervals change by at most 2 and 24 %.
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

/// A girth by Cauchy's formula, and its standard deviation from how the tangents disagree and what is between them: each on
/// its own, and all on the left of the picture with all on its right. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// The girth.
    pub girth: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// How many tangents hold it.
    pub tangents: usize,
}

/// Fewer tangents give no girth: how much they scatter shows in two for each of a mean's and an ellipse's unknowns (derived).
const MIN_TANGENTS: usize = 2 * (1 + 2 * 2);
/// Rounds of weights (structural: later ones hardly change them).
const ROUNDS: usize = 12;

/// The girth of a section by its tangents, whose support functions are about that of a curve (`base`, of such a length) as a
/// periodic smoothing spline, weighed robustly (Huber). Between tangents it is as unsure as it bends where they are.
/// `None` with fewer than ten. \[mm\]
pub fn support_girth(
    tangents: &[Tangent],
    base: impl Fn(f64) -> f64,
    length: f64,
) -> Option<Support> {
    let n = tangents.len();
    if n < MIN_TANGENTS {
        return None;
    }
    let angles: Vec<f64> = tangents.iter().map(|t| t.angle).collect();
    let off: Vec<f64> = tangents.iter().map(|t| t.support - base(t.angle)).collect();
    let mut weights = vec![1.0; n];
    let mut fit = spline(&angles, &off, &weights)?;
    for _ in 0..ROUNDS {
        let middle = shape::upper_median(fit.left.iter().map(|e| e.abs()))?;
        let limit = (1.5 * 1.4826 * middle).max(0.05);
        for (weight, e) in weights.iter_mut().zip(&fit.left) {
            *weight = (limit / e.abs().max(1e-12)).min(1.0);
        }
        fit = spline(&angles, &off, &weights)?;
    }
    let sides = sides_apart(tangents, &fit.left, fit.sigma);
    Some(Support {
        girth: length + TAU * fit.mean,
        sigma: TAU * libm::hypot(fit.sigma, sides),
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
