//! The section across an upper arm, freed of the trunk.
//!
//! Where arm and trunk are one outline, or a web hangs on the arm, they are parted at their folds (`beside_trunk`). An outline
//! without folds is the arm's own, round or not.

use crate::features::body::Body;
use crate::geometry::section::{axes, length, tape};
use crate::geometry::slices::{Ring, rings};
use crate::sections::beside_trunk::{FreedArm, freed_of_trunk};
use crate::sections::down_arm::{CLEAN_ROUND, DownArm, round};
use crate::sections::one::{FUSED, SectionMeasurement, Spline, Why, plain};
use nalgebra::Point3;
use shape::{Landmark, Mesh, Plane};

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
    if let Some(ring) = own.as_ref().filter(|r| round(r) > CLEAN_ROUND) {
        return plain(plane, ring.clone());
    }
    let clear = down.clear(own.as_ref(), body, side)?;
    let (reference, outward) = (&clear.reference, clear.outward);
    let parted = |ring: &Ring| freed_of_trunk(&clear.flat(ring, plane), outward, reference);
    let Some(ring) = own else {
        let free = rings(&down.part, plane).iter().find_map(parted);
        return Ok(completed(free.ok_or(FUSED)?, clear.origin, plane));
    };
    match parted(&ring) {
        Some(free) => Ok(completed(free, clear.origin, plane)),
        None => plain(plane, ring),
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
        spline: Spline::Knots(even),
        bridged: free.share,
        sigma_mm: free.sigma_mm,
    }
}
