//! Where the neck is measured.

use super::{LandmarkParams, landmark};
use crate::body::Body;
use crate::slices::rings;
use nalgebra::{Point3, Vector3};
use shape::{Landmarks, Mesh, Missing, Part, Plane};

/// Middle of the neck above its narrowest, as a share of what is above that.
const MID_NECK: f64 = 0.0957;

/// The neck: across its axis, which leans forward, amid its two joints. These lie a tenth of the
/// head's height above the horizontal narrowest.
pub(super) fn neck_plane(p: &LandmarkParams, mesh: &Mesh, body: &Body, found: &mut Landmarks) {
    let Some(narrow) = body.neck else { return };
    let z = narrow + MID_NECK * (body.ground + body.stature - narrow);
    let lean = p.neck_lean_deg.to_radians();
    let axis = Vector3::z() * lean.cos() + body.front * lean.sin();
    let Some(ring) = body.trunk(narrow) else {
        return;
    };
    // The middle of the section must lie at that height: two steps along the axis settle it.
    let mut plane = Plane {
        point_mm: ring.centre.into(),
        normal: axis.into(),
    };
    for _ in 0..4 {
        let Some(neck) = rings(mesh, &plane).into_iter().next() else {
            return;
        };
        let centre = neck.centre + axis * ((z - neck.centre.z) / axis.z);
        plane.point_mm = centre.into();
    }
    let Some(neck) = rings(mesh, &plane).into_iter().next() else {
        return;
    };
    if (neck.centre - Point3::from(plane.point_mm)).norm() > 0.04 * body.stature {
        let why =
            "the section across the neck's axis is not the neck: is hair or a collar in the way?";
        found.missing.push(Missing {
            name: "NC".into(),
            why: why.into(),
        });
        return;
    }
    let text = "neck: across its axis, amid its height (ISO 8559-1 5.3.2)";
    found
        .found
        .push(landmark("NC", "neck", text, plane, Part::Head));
}
