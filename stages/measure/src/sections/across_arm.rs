//! The section across an upper arm, freed of the trunk and of the filled fold of the armpit.
//!
//! Where arm and trunk are one outline they are parted at their folds (`beside_trunk`). On an outline of the arm's own,
//! a clear section farther down, grown and shifted so that its support function agrees with the outer half, which always
//! shows, tells how far the inner half may reach.

use crate::features::body::Body;
use crate::geometry::section::{axes, clipped, hull, length, tape};
use crate::geometry::slices::{Ring, rings};
use crate::geometry::spline::closed_spline_length;
use crate::sections::beside_trunk::{FreedArm, freed_of_trunk};
use crate::sections::down_arm::{CLEAN, DownArm, round};
use crate::sections::one::{FUSED, SectionMeasurement, Why, plain};
use nalgebra::{Matrix3, Point3, Vector3};
use shape::{Landmark, Mesh, Plane};
use std::f64::consts::TAU;

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

/// Takes the section of an upper arm; the plane's normal points down the arm.
pub(crate) fn across_arm(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    let plane = &landmark.plane;
    let down = DownArm::of(mesh, body, plane);
    let own = down.small(0).map(|(_, ring)| ring);
    if let Some(ring) = own.as_ref().filter(|r| round(r) > CLEAN) {
        return plain(mesh, plane, ring.clone());
    }
    let clear = down.clear(own.as_ref(), body, side)?;
    let (reference, outward) = (&clear.reference, clear.outward);
    let parted = |ring: &Ring| freed_of_trunk(&clear.flat(ring, plane), outward, reference);
    let Some(ring) = own else {
        let free = rings(&down.part, plane).iter().find_map(parted);
        return Ok(completed(free.ok_or(FUSED)?, clear.origin, plane));
    };
    let free = parted(&ring).or_else(|| freed(&clear.flat(&ring, plane), reference, outward));
    match free.ok_or(FUSED)? {
        free if free.share == 0.0 => plain(mesh, plane, ring),
        free => Ok(completed(free, clear.origin, plane)),
    }
}

/// An arm's section from its freed outline about an origin.
pub(super) fn completed(free: FreedArm, origin: Point3<f64>, plane: &Plane) -> SectionMeasurement {
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
