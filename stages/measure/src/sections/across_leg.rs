//! The section across a leg; where both legs are one ring, the half of it on the leg's side.

use crate::features::body::Body;
use crate::features::extent::extent;
use crate::geometry::crop::slab;
use crate::geometry::section::{axes, clipped, flat, hull, length, tape};
use crate::geometry::slices::{Ring, rings};
use crate::geometry::spline::closed_spline_length;
use crate::planes::limbs::webbed;
use crate::sections::hands::holds_hand;
use crate::sections::lobe::lobe;
use crate::sections::one::{FUSED, HAND, NOTHING, SectionMeasurement, Why, nearest, plain};
use nalgebra::{Point3, Vector3};
use shape::{GirthId, Landmark, Mesh, Plane};

/// Legs that press each other share at most so much of a leg's tape (by hand): a wider cut goes through the trunk.
const MOST_CUT: f64 = 0.22;
/// How far down a leg a section is looked for that is its own, and the step, as shares of stature.
const DOWN: f64 = 0.08;
/// The step, as a share of stature (structural: samples).
const STEP: f64 = 0.005;
/// A ring that is so many times as long as the leg's own lower down is two legs'.
const TWO: f64 = 1.3;
/// Doubt of a half ring's tape, as a share of what is cut: legs press each other out of shape.
const DOUBT: f64 = 0.06;

/// Takes the section of a leg; the plane's normal points down it.
pub(crate) fn across_leg(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    let ring = nearest(mesh, &landmark.plane).ok_or(NOTHING)?;
    if holds_hand(body, &ring, side) || lobe(body, &ring, side).is_some() {
        return Err(HAND);
    }
    let out = |r: &Ring| extent(r, &(body.left * side));
    let inner = out(&ring).ok_or(NOTHING)?.0;
    // The whole leg and the other one are about the body's middle; one leg's ring is narrow.
    let own = below(mesh, body, &landmark.plane, side);
    let alone = |ring: Ring| match webbed(body, &ring, side) {
        true if matches!(landmark.id, GirthId::Thigh(_)) => Err(FUSED),
        _ => plain(mesh, &landmark.plane, ring),
    };
    let Some((leg, middle)) = own else {
        return alone(ring);
    };
    if ring.tape < TWO * leg.tape || inner > middle {
        return alone(ring);
    }
    half(&ring, &landmark.plane, &(body.left * side), middle).ok_or(FUSED)
}

/// The leg's own ring a little lower, where two rings show, and the middle between both legs there,
/// counted along the leg's side. \[mm\]
fn below(mesh: &Mesh, body: &Body, plane: &Plane, side: f64) -> Option<(Ring, f64)> {
    let turn = if plane.normal[2] > 0.0 { -1.0 } else { 1.0 };
    let down = Vector3::from(plane.normal).normalize() * turn;
    let plane = Plane {
        normal: down.into(),
        ..*plane
    };
    let step = STEP * body.stature;
    let part = slab(mesh, &plane, -step, (DOWN + STEP) * body.stature);
    let left = body.left * side;
    (1..=(DOWN / STEP) as i32).find_map(|k| {
        let point = Point3::from(plane.point_mm) + down * (f64::from(k) * step);
        let all = rings(
            &part,
            &Plane {
                point_mm: point.into(),
                ..plane
            },
        );
        let (a, b) = (all.first()?, all.get(1)?);
        if b.area < 0.4 * a.area {
            return None;
        }
        let (own, other) = match a.centre.coords.dot(&left) > b.centre.coords.dot(&left) {
            true => (a, b),
            false => (b, a),
        };
        let middle = (extent(own, &left)?.0 + extent(other, &left)?.1) / 2.0;
        Some((own.clone(), middle))
    })
}

/// What of a ring is beyond a place along a direction.
fn half(
    ring: &Ring,
    plane: &Plane,
    left: &Vector3<f64>,
    middle: f64,
) -> Option<SectionMeasurement> {
    let (u, v) = axes(plane);
    let origin = Point3::from(plane.point_mm);
    // left · (origin + u x + v y) >= middle
    let n = [left.dot(&u), left.dot(&v)];
    let long = libm::hypot(n[0], n[1]);
    if long < 0.5 {
        return None;
    }
    let way = [-n[0] / long, -n[1] / long];
    let reach = (left.dot(&origin.coords) - middle) / long;
    let outline = hull(&clipped(&flat(&ring.curve, plane), way, reach));
    if outline.len() < 8 {
        return None;
    }
    let count = outline.len();
    let at = |p: &[f64; 2]| way[0] * p[0] + way[1] * p[1] > reach - 1e-6;
    let cut: f64 = (0..count)
        .map(|i| (outline[i], outline[(i + 1) % count]))
        .filter(|(a, b)| at(a) && at(b))
        .map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1]))
        .sum();
    let tape_mm = tape(&outline);
    if cut > MOST_CUT * tape_mm {
        return None;
    }
    let contour_mm = length(&outline);
    let even: Vec<[f64; 2]> = outline
        .iter()
        .step_by((count / 48).max(1))
        .copied()
        .collect();
    Some(SectionMeasurement {
        contour: outline
            .iter()
            .map(|p| origin + u * p[0] + v * p[1])
            .collect(),
        contour_mm,
        tape_mm,
        spline_mm: closed_spline_length(&even).unwrap_or(contour_mm),
        carried: cut / tape_mm,
        sigma_mm: DOUBT * cut,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_half_of_a_trunk_is_no_leg() {
        let at = |k: i32| {
            let (s, c) = libm::sincos(TAU * f64::from(k) / 720.0);
            Point3::new(190.0 * c, 125.0 * s, 0.0)
        };
        let curve: Vec<Point3<f64>> = (0..720).map(at).collect();
        let plane = Plane {
            point_mm: [0.0; 3],
            normal: [0.0, 0.0, -1.0],
        };
        let ring = Ring {
            tape: tape(&flat(&curve, &plane)),
            area: 1.0,
            centre: Point3::origin(),
            curve,
        };
        assert!(half(&ring, &plane, &Vector3::x(), 0.0).is_none());
    }

    #[test]
    fn the_half_of_two_pressed_legs_is_one_leg_with_a_flat_side() {
        // Two disks of radius 80 about x = ±76, pressed together at x = 0.
        let curve: Vec<Point3<f64>> = (0..720)
            .map(|k| TAU * (f64::from(k) / 720.0 - 0.5))
            .filter_map(|t| {
                let (s, c) = libm::sincos(t);
                let x = 76.0 + 80.0 * c;
                (x >= 0.0).then_some((x, 80.0 * s))
            })
            .map(|(x, y)| Point3::new(x, y, 0.0))
            .collect();
        let mirrored = curve.iter().map(|p| Point3::new(-p.x, -p.y, 0.0));
        let both: Vec<Point3<f64>> = curve.iter().copied().chain(mirrored).collect();
        let plane = Plane {
            point_mm: [76.0, 0.0, 0.0],
            normal: [0.0, 0.0, -1.0],
        };
        let flat_both = flat(&both, &plane);
        let ring = Ring {
            tape: tape(&flat_both),
            area: 1.0,
            centre: Point3::origin(),
            curve: both,
        };
        let one = half(&ring, &plane, &Vector3::x(), 0.0).unwrap();
        proof::near(one.tape_mm / (TAU * 80.0), 1.0, 0.01);
        assert!(one.carried > 0.02 && one.carried < 0.2, "{}", one.carried);
    }
}
