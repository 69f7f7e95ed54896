//! The section across an upper arm, freed of the trunk and of the filled fold of the armpit.
//!
//! Where arm and trunk are one outline they are parted at their folds (`beside_trunk`). On an outline of the arm's own,
//! a clear section farther down, grown and shifted so that its support function agrees with the outer half, which always
//! shows, tells how far the inner half may reach.

use crate::features::body::Body;
use crate::features::limb::away;
use crate::geometry::crop::slab;
use crate::geometry::section::{axes, clipped, flat, hull, length, tape};
use crate::geometry::slices::{Ring, rings};
use crate::geometry::spline::closed_spline_length;
use crate::sections::beside_trunk::{FreedArm, freed_of_trunk};
use crate::sections::one::{FUSED, SectionMeasurement, Why, nearest, plain};
use nalgebra::{Matrix3, Point3, Vector3};
use shape::{Landmark, Mesh, Plane};
use std::f64::consts::{PI, TAU};

/// How round an arm's own section is at least: its area against a circle's of the same tape.
pub(super) const ROUND: f64 = 0.93;
/// As round as this, nothing hangs on it.
pub(super) const CLEAN: f64 = 0.96;
/// How far beyond the grown section an inner half may reach, as a share of the arm's radius.
pub(super) const LOOSE: f64 = 0.03;
/// Directions of support functions.
pub(super) const WAYS: usize = 180;
/// Doubt of a girth whose inner half is told by another section, as a share of what is told.
pub(super) const DOUBT: f64 = 0.04;

pub(super) fn way(k: usize) -> [f64; 2] {
    let (s, c) = libm::sincos(TAU * k as f64 / WAYS as f64);
    [c, s]
}

/// Farthest of points in a direction.
pub(super) fn support(points: &[[f64; 2]], n: [f64; 2]) -> f64 {
    let reach = points.iter().map(|p| n[0] * p[0] + n[1] * p[1]);
    reach.fold(f64::MIN, f64::max)
}

/// Frees an arm's own outline of what hangs on its inner half, by a clear section. Both lie about their middles; `outward`
/// points away from the trunk. `None` if the two disagree in size.
pub(crate) fn freed(here: &[[f64; 2]], clear: &[[f64; 2]], outward: [f64; 2]) -> Option<FreedArm> {
    let radius = tape(clear) / TAU;
    let inner = |n: [f64; 2]| n[0] * outward[0] + n[1] * outward[1] < 0.0;
    // Shift and growth of the clear section, by least squares over the outer half.
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for n in (0..WAYS).map(way).filter(|n| !inner(*n)) {
        let row = Vector3::new(n[0], n[1], support(clear, n));
        normal += row * row.transpose();
        right += row * support(here, n);
    }
    let fit = normal.cholesky()?.solve(&right);
    if !(0.8..=1.3).contains(&fit.z) {
        return None;
    }
    let mut outline = hull(here);
    let mut told = 0;
    for n in (0..WAYS).map(way).filter(|n| inner(*n)) {
        let most = fit.x * n[0] + fit.y * n[1] + fit.z * support(clear, n);
        if support(&outline, n) > most + LOOSE * radius {
            outline = clipped(&outline, n, most);
            told += 1;
        }
    }
    let share = f64::from(told) / WAYS as f64;
    (outline.len() >= 8).then(|| FreedArm {
        share,
        sigma_mm: DOUBT * share * tape(&outline),
        outline,
    })
}

/// How far down the arm a clear section is looked for, as a share of stature: above the elbow, which is
/// a tenth of it from the middle of the upper arm.
pub(super) const DOWN: f64 = 0.078;

/// Takes the section of an upper arm; the plane's normal points down the arm.
pub(crate) fn across_arm(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    let plane = &landmark.plane;
    let down = Vector3::from(plane.normal).normalize();
    let step = 0.004 * body.stature;
    let last = (DOWN / 0.004) as i32;
    let part = slab(mesh, plane, -step, f64::from(last + 1) * step);
    let middle = Point3::from(plane.point_mm);
    let level = body.crotch.unwrap_or(body.ground + 0.5 * body.stature) + 0.08 * body.stature;
    let trunk = body.trunk(level).map_or(f64::MAX, |r| r.area);
    let round = |ring: &Ring| 4.0 * PI * ring.area / (ring.tape * ring.tape);
    // Sections down the arm that are small and about the axis; if round, too, the arm's alone.
    let small = |k: i32| {
        if k > last {
            return None;
        }
        let point = middle + down * (f64::from(k) * step);
        let there = Plane {
            point_mm: point.into(),
            ..*plane
        };
        let ring = nearest(&part, &there)?;
        let near = (ring.centre - point).norm() < 0.02 * body.stature;
        (ring.area < 0.25 * trunk && near).then_some((k, ring))
    };
    let alone = |k: i32| small(k).filter(|(_, ring)| round(ring) > ROUND);
    let own = small(0).map(|(_, ring)| ring);
    if let Some(ring) = own.as_ref().filter(|r| round(r) > CLEAN) {
        return plain(mesh, plane, ring.clone());
    }
    // The roundest of the first that are.
    let first = (1..=last).find_map(alone).ok_or(FUSED)?.0;
    let (steps, clear) = (first..first + 10)
        .filter_map(alone)
        .max_by(|a, b| round(&a.1).total_cmp(&round(&b.1)))
        .ok_or(FUSED)?;
    let origin = match &own {
        Some(ring) => ring.centre,
        None => clear.centre - down * (f64::from(steps) * step),
    };
    let about = |p: Point3<f64>| Plane {
        point_mm: p.into(),
        ..*plane
    };
    let reference = hull(&flat(&clear.curve, &about(clear.centre)));
    let (u, v) = axes(plane);
    let out = away(down, body.left, side).ok_or(FUSED)?;
    let outward = [u.dot(&out), v.dot(&out)];
    let flat_about = |ring: &Ring| flat(&ring.curve, &about(origin));
    let parted = |ring: &Ring| freed_of_trunk(&flat_about(ring), outward, &reference);
    let Some(ring) = own else {
        let free = rings(&part, plane).iter().find_map(parted);
        return Ok(completed(free.ok_or(FUSED)?, origin, plane));
    };
    let free = parted(&ring).or_else(|| freed(&flat_about(&ring), &reference, outward));
    match free.ok_or(FUSED)? {
        free if free.share == 0.0 => plain(mesh, plane, ring),
        free => Ok(completed(free, origin, plane)),
    }
}

/// An arm's section from its freed outline about an origin.
fn completed(free: FreedArm, origin: Point3<f64>, plane: &Plane) -> SectionMeasurement {
    let (u, v) = axes(plane);
    let outline = free.outline;
    let even: Vec<[f64; 2]> = outline
        .iter()
        .step_by((outline.len() / 48).max(1))
        .copied()
        .collect();
    let contour_mm = length(&outline);
    SectionMeasurement {
        contour: outline
            .iter()
            .map(|p| origin + u * p[0] + v * p[1])
            .collect(),
        contour_mm,
        tape_mm: tape(&outline),
        spline_mm: closed_spline_length(&even).unwrap_or(contour_mm),
        carried: free.share,
        sigma_mm: free.sigma_mm,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oval(a: f64, b: f64) -> Vec<[f64; 2]> {
        (0..360)
            .map(|k| libm::sincos(TAU * f64::from(k) / 360.0))
            .map(|(s, c)| [a * c, b * s])
            .collect()
    }

    #[test]
    fn a_fold_that_hangs_on_the_inner_half_is_cut_away() {
        let (mut here, clear) = (oval(55.0, 48.0), oval(50.0, 44.0));
        let own = tape(&here);
        here.extend([[-68.0, 22.0], [-66.0, -5.0]]);
        let here = hull(&here);
        assert!(tape(&here) > 1.03 * own);
        let free = freed(&here, &clear, [1.0, 0.0]).unwrap();
        proof::near(tape(&free.outline) / own, 1.0, 0.012);
        assert!(free.share > 0.05 && free.share < 0.5);
    }

    #[test]
    fn a_plain_arm_is_left_as_it_is() {
        let (here, clear) = (oval(55.0, 48.0), oval(50.0, 44.0));
        let free = freed(&here, &clear, [1.0, 0.0]).unwrap();
        assert_eq!(free.share, 0.0);
        proof::near(tape(&free.outline), tape(&here), 1e-9);
    }
}
