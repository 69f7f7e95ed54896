//! A motion from features: points of skin or clothes that several photos show, each in one place of the trunk. Points are
//! unknowns of their own and leave the equations at once (Schur complement).

use crate::joints::{Equations, median};
use crate::scene::{Motion, PER_STEP, seen};
use nalgebra::{DMatrix, Matrix2x3, Matrix3, Vector2, Vector3};
use rayon::prelude::*;

/// A point that several photos show.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    /// By which photos, and where on the plane z = 1.
    pub(crate) seen: Vec<(usize, Vector2<f64>)>,
    /// What it counts for: 1 on the trunk, less on a limb.
    pub(crate) counts: f64,
}

/// Cauchy's constant, for 95 % efficiency on normal errors (Holland and Welsch 1977).
const CAUCHY: f64 = 2.385;

/// What points come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// How far they are from where they should be seen, one standard deviation. \[on the plane z = 1\]
    pub(crate) spread: f64,
    /// In how many places points are seen.
    pub(crate) sights: usize,
}

/// A place where a point is seen: how far it is off, and how that moves with the point and with its step and the pitch.
struct Sight {
    photo: usize,
    miss: Vector2<f64>,
    by_point: Matrix2x3<f64>,
    by_step: [Vector2<f64>; PER_STEP],
    by_pitch: Vector2<f64>,
}

/// What points ask of steps and pitch, added to `to`; `weight` of all of a photo's points together, in sights of joints, and
/// how many times farther off than usual one may be.
pub(crate) fn equations(
    points: &[Point],
    motion: &Motion,
    (weight, lax): (f64, f64),
    to: &mut Equations,
) -> Option<Fit> {
    let all: Vec<(Vec<Sight>, f64)> = points
        .par_iter()
        .filter_map(|point| Some((sights(&point.seen, motion)?, point.counts)))
        .collect();
    // Limbs that move by themselves are off by more than the trunk, and so count for little.
    let trunk = all.iter().filter(|(_, counts)| *counts >= 1.0);
    let mut off: Vec<f64> = trunk
        .flat_map(|(point, _)| point)
        .flat_map(|s| [s.miss.x.abs(), s.miss.y.abs()])
        .collect();
    if off.is_empty() {
        return None;
    }
    let sights = off.len() / 2;
    let spread = (1.4826 * median(&mut off)).max(1e-6);
    let mut sums = vec![0.0; motion.steps.len()];
    for (point, counts) in &all {
        point.iter().for_each(|s| sums[s.photo] += counts);
    }
    for (point, counts) in &all {
        let weigh = |s: &Sight| {
            let share = s.miss.norm_squared() / (CAUCHY * lax * spread).powi(2);
            counts * (weight / sums[s.photo]).min(1.0) / (spread * spread * (1.0 + share))
        };
        let weights: Vec<f64> = point.iter().map(weigh).collect();
        without_point(point, &weights, motion.steps.len(), to);
    }
    Some(Fit { spread, sights })
}

/// What one point's sights ask of steps and pitch, wherever the point is.
fn without_point(point: &[Sight], weights: &[f64], photos: usize, to: &mut Equations) {
    let unknowns = PER_STEP * point.len() + 1;
    let mut inner = Matrix3::zeros();
    let mut side = DMatrix::<f64>::zeros(unknowns, 3);
    let mut pull = Vector3::zeros();
    for (k, (s, w)) in point.iter().zip(weights).enumerate() {
        inner += s.by_point.transpose() * s.by_point * *w;
        pull += s.by_point.transpose() * s.miss * *w;
        for (row, slope) in s.by_step.iter().enumerate() {
            let to_point = slope.transpose() * s.by_point * *w;
            (0..3).for_each(|c| side[(PER_STEP * k + row, c)] += to_point[c]);
        }
        let to_point = s.by_pitch.transpose() * s.by_point * *w;
        (0..3).for_each(|c| side[(unknowns - 1, c)] += to_point[c]);
    }
    let stiff = inner.trace();
    inner += Matrix3::identity() * (1e-9 * stiff + f64::MIN_POSITIVE);
    let Some(free) = inner.try_inverse() else {
        return;
    };
    let place = |at: usize| match at {
        at if at == unknowns - 1 => PER_STEP * photos,
        at => PER_STEP * point[at / PER_STEP].photo + at % PER_STEP,
    };
    for (s, w) in point.iter().zip(weights) {
        for c in 0..2 {
            let mut slopes: Vec<(usize, f64)> = (s.by_step.iter().enumerate())
                .map(|(row, slope)| (PER_STEP * s.photo + row, slope[c]))
                .collect();
            slopes.push((PER_STEP * photos, s.by_pitch[c]));
            to.add(&slopes, s.miss[c], *w);
        }
    }
    let moved = &side * free;
    for a in 0..unknowns {
        let row = [0, 1, 2].map(|c| moved[(a, c)]);
        to.vector[place(a)] += (0..3).map(|c| row[c] * pull[c]).sum::<f64>();
        for b in 0..unknowns {
            let both = (0..3).map(|c| row[c] * side[(b, c)]).sum::<f64>();
            to.matrix[(place(a), place(b))] -= both;
        }
    }
}

/// The point placed where its sights want it, and how far each is off; `None` where they want nothing that can be seen.
fn sights(point: &[(usize, Vector2<f64>)], motion: &Motion) -> Option<Vec<Sight>> {
    let mut at = placed(point, motion)?;
    for _ in 0..POLISHED {
        let (mut inner, mut pull) = (Matrix3::zeros(), Vector3::zeros());
        for s in seen_at(point, motion, &at)? {
            inner += s.by_point.transpose() * s.by_point;
            pull -= s.by_point.transpose() * s.miss;
        }
        at += inner.try_inverse()? * pull;
    }
    // Beyond arm's reach of the axis there is no trunk.
    (at.xy().norm() < 0.5).then_some(())?;
    seen_at(point, motion, &at)
}

/// Rounds in which a point settles, structural: from a start by rays it is there in two or three.
const POLISHED: usize = 3;

/// The point nearest to its rays.
fn placed(point: &[(usize, Vector2<f64>)], motion: &Motion) -> Option<Vector3<f64>> {
    let (mut matrix, mut vector) = (Matrix3::zeros(), Vector3::zeros());
    for (photo, sight) in point {
        let pose = motion.camera_from_body(*photo);
        for k in 0..2 {
            // x − u z = 0 in the camera's frame.
            let row = pose.0.row(k) - pose.0.row(2) * sight[k];
            let off = pose.1[k] - sight[k] * pose.1.z;
            matrix += row.transpose() * row;
            vector -= row.transpose() * off;
        }
    }
    Some(matrix.try_inverse()? * vector)
}

/// The sights of a point at a place.
fn seen_at(
    point: &[(usize, Vector2<f64>)],
    motion: &Motion,
    at: &Vector3<f64>,
) -> Option<Vec<Sight>> {
    let sight = |(photo, sight): &(usize, Vector2<f64>)| {
        let step = &motion.steps[*photo];
        let pose = step.pose();
        let there = pose.rotation * at + pose.translation;
        let (seen, by_place, by_pitch) = seen(motion.pitch, &there)?;
        Some(Sight {
            photo: *photo,
            miss: seen - sight,
            by_point: by_place * pose.rotation.matrix(),
            by_step: step.slopes(at).map(|s| by_place * s),
            by_pitch,
        })
    };
    point.iter().map(sight).collect()
}

#[cfg(test)]
#[path = "points_tests.rs"]
mod tests;
