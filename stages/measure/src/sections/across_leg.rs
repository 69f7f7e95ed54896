//! The section across a leg; where both legs are one ring, the half of it on the leg's side.

use crate::features::body::Body;
use crate::features::extent::extent;
use crate::geometry::halves::{half, webbed};
use crate::geometry::section::{axes, length};
use crate::geometry::slices::{Ring, nearest_ring};
use crate::sections::hands::holds_hand;
use crate::sections::lobe::lobe;
use crate::sections::one::{FUSED, HAND, NOTHING, SectionMeasurement, Spline, Why, plain};
use crate::sections::split::even;
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
    if holds_hand(body, &ring, side) || lobe(body, &ring, side).is_some() {
        return Err(HAND);
    }
    let inner = extent(&ring, &(body.left * side)).ok_or(NOTHING)?.0;
    let alone = |ring: Ring| match webbed(&ring, &(body.left * side)) >= 1.0 {
        true if matches!(landmark.id, GirthId::Thigh(_)) => Err(FUSED),
        _ => plain(&landmark.plane, ring),
    };
    if !other(body, ring.centre.z, side).is_some_and(|other| inner < other) {
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
        carried: half.share,
        sigma_mm: half.sigma_mm,
    })
}

/// Where the middle of the other leg is along a leg's side: at a height, or below it where both last show apart. \[mm\]
fn other(body: &Body, z: f64, side: f64) -> Option<f64> {
    let legs = body.slice(z.min(body.legs_join?))?.rings.iter().take(2);
    let along = |r: &Ring| r.centre.coords.dot(&(body.left * side));
    legs.map(along).reduce(f64::min)
}
