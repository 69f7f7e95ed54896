//! How wide and how deep a section is, and a level one around the trunk.

use crate::features::body::Body;
use crate::geometry::slices::{Ring, level};
use nalgebra::{Point3, Vector3};
use shape::Plane;

/// Least and greatest of a ring along a direction.
pub(crate) fn extent(ring: &Ring, along: &Vector3<f64>) -> Option<(f64, f64)> {
    let reach = ring.curve.iter().map(|p| p.coords.dot(along));
    reach.fold(None, |e: Option<(f64, f64)>, x| {
        Some(e.map_or((x, x), |(lo, hi)| (lo.min(x), hi.max(x))))
    })
}

/// How far to either side of its middle a trunk's depth is read, as a share of stature: nipples and buttocks are
/// within, raised arms and the forearms before them are not: half a chest is 0.063 to 0.105 broad (ANSUR II).
const MIDDLE_SHARE: f64 = 0.08;

/// Backmost and foremost of the middle of a trunk's section, along the body's front. \[mm\]
pub(crate) fn depth(body: &Body, ring: &Ring) -> Option<(f64, f64)> {
    let (low, high) = extent(ring, &body.left)?;
    let middle = (low + high) / 2.0;
    let near = |x: f64| (x - middle).abs() <= MIDDLE_SHARE * body.stature;
    let own = ring.curve.iter().filter(|p| near(p.coords.dot(&body.left)));
    own.map(|p| p.coords.dot(&body.front)).fold(None, |e, x| {
        Some(e.map_or((x, x), |(lo, hi): (f64, f64)| (lo.min(x), hi.max(x))))
    })
}

/// A level plane around the middle of the trunk.
pub(crate) fn across(body: &Body, z: f64) -> Plane {
    let middle = body.trunk(z).map_or(Point3::origin(), |r| r.centre);
    Plane {
        point_mm: [middle.x, middle.y, z],
        ..level(z)
    }
}
