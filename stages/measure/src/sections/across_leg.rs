//! The section across a leg; where both legs are one ring, the half of it on the leg's side.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use crate::features::extent::extent;
use crate::geometry::halves::{half, webbed};
use crate::geometry::section::{axes, length};
use crate::geometry::slices::{Ring, Slice, nearest_ring};
use crate::sections::hands::holds_hand;
use crate::sections::lobe::lobe;
use crate::sections::one::{FUSED, HAND, NOTHING, SectionMeasurement, Spline, Why, plain};
use crate::sections::split::{even, parted};
use nalgebra::Point3;
use shape::{GirthId, Landmark, Mesh};

/// Takes the section of a leg; the plane's normal points down it.
pub(crate) fn across_leg(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    let ring = nearest_ring(mesh, &landmark.plane).ok_or(NOTHING)?;
    let inner = extent(&ring, &(body.left * side)).ok_or(NOTHING)?.0;
    let both = other(body, ring.centre.z, side).is_some_and(|other| inner < other);
    if let Some(free) = without_hand(body, &ring, side) {
        return free.and_then(|free| if both { Err(HAND) } else { Ok(free) });
    }
    let alone = |ring: Ring| match webbed(&ring, &(body.left * side)) >= 1.0 {
        true if matches!(landmark.id, GirthId::Thigh(_)) => Err(FUSED),
        _ => plain(&landmark.plane, ring),
    };
    if !both {
        return alone(ring);
    }
    let half = half(&ring.curve, &landmark.plane, &(body.left * side)).ok_or(FUSED)?;
    let (u, v) = axes(&landmark.plane);
    let origin = Point3::from(landmark.plane.point_mm);
    let contour_mm = length(&half.points);
    let knots = even(&half.points, 48);
    Ok(SectionMeasurement {
        contour: half
            .points
            .iter()
            .map(|p| origin + u * p[0] + v * p[1])
            .collect(),
        contour_mm,
        tape_mm: half.tape,
        spline: Spline::Knots(knots),
        bridged: half.share,
        sigma_mm: half.sigma_mm,
    })
}

/// A leg's section without the hand at its outer side, parted from it as an arm from a trunk; `None` where there is no hand.
pub(crate) fn without_hand(
    body: &Body,
    ring: &Ring,
    side: f64,
) -> Option<Result<SectionMeasurement, Why>> {
    // What shows there as a ring of its own is not in this one.
    let apart = |s: &Slice| arm_ring(body, &s.rings, side).is_some();
    let hidden = !body.slice(ring.centre.z).is_some_and(apart) && holds_hand(body, ring, side);
    if !hidden && lobe(body, ring, side).is_none() {
        return None;
    }
    let middle = ring.centre;
    let (u, v) = (&body.left, &body.front);
    let way = ring.curve.iter().map(|p| p - middle);
    let flat: Vec<[f64; 2]> = way.map(|p| [p.dot(u), p.dot(v)]).collect();
    let free = parted(&[flat], 0, &[(side, 0..1)]).ok_or(HAND);
    Some(free.map(|free| free.section(middle, (u, v))))
}

/// Where the middle of the other leg is along a leg's side: at a height, or below it where both last show apart. \[mm\]
fn other(body: &Body, z: f64, side: f64) -> Option<f64> {
    let legs = body.slice(z.min(body.legs_join?))?.rings.iter().take(2);
    let along = |r: &Ring| r.centre.coords.dot(&(body.left * side));
    legs.map(along).reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::section::{area, tape};
    use std::f64::consts::TAU;

    /// A thigh of 85 mm beside which a disk of 28 mm is, so far out: the farthest that a ray from its middle meets.
    fn thigh(hand: Option<f64>) -> Ring {
        let reach = |k: usize| {
            let (s, c) = libm::sincos(TAU * k as f64 / 1440.0);
            let far = hand.and_then(|at| {
                let root = 28.0f64.powi(2) - (at * s).powi(2);
                (root > 0.0 && c > 0.0).then(|| at * c + root.sqrt())
            });
            let far = far.unwrap_or(0.0).max(85.0);
            Point3::new(far * c, far * s, 700.0)
        };
        let curve: Vec<Point3<f64>> = (0..1440).map(reach).collect();
        let flat: Vec<[f64; 2]> = curve.iter().map(|p| [p.x, p.y]).collect();
        Ring {
            area: area(&flat),
            tape: tape(&flat),
            centre: Point3::new(0.0, 0.0, 700.0),
            curve,
        }
    }

    #[test]
    fn a_hand_at_a_thigh_is_cut_off_and_a_thigh_without_one_is_left_alone() {
        let body = Body::of_slices(Vec::new());
        assert!(without_hand(&body, &thigh(None), 1.0).is_none());
        for out in [90.0, 100.0, 108.0] {
            let ring = thigh(Some(out));
            assert!(ring.tape > 1.05 * TAU * 85.0);
            let free = without_hand(&body, &ring, 1.0).unwrap().unwrap();
            proof::near(free.tape_mm / (TAU * 85.0), 1.0, 0.015);
            assert!(free.bridged > 0.05 && free.sigma_mm > 1.0);
            assert!(without_hand(&body, &ring, -1.0).is_none());
        }
    }
}
