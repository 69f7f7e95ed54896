//! How a body stands: its height, which way it faces, where legs join, where the neck is narrow.

use crate::section::centre;
use crate::slices::{Ring, Slice, rings, slices};
use nalgebra::{Point3, Vector3};
use shape::{Mesh, Plane};

/// What the slices of an upright body tell.
#[derive(Debug, Clone)]
pub struct Body {
    /// Height of the ground. \[mm\]
    pub ground: f64,
    /// Crown above the ground. \[mm\]
    pub stature: f64,
    /// The way it faces: horizontal, unit.
    pub front: Vector3<f64>,
    /// Its left.
    pub left: Vector3<f64>,
    /// Where the legs join. \[mm\] `None` without two legs.
    pub crotch: Option<f64>,
    /// Height of the narrowest of the neck. \[mm\] `None` without a neck.
    pub neck: Option<f64>,
    /// The slices, from the ground up.
    pub slices: Vec<Slice>,
}

impl Body {
    /// The ring of the trunk at a height: the largest. \[mm\]
    pub fn trunk(&self, z: f64) -> Option<&Ring> {
        self.slice(z)?.rings.first()
    }

    /// The slice nearest to a height.
    pub fn slice(&self, z: f64) -> Option<&Slice> {
        self.slices
            .iter()
            .min_by(|a, b| (a.z - z).abs().total_cmp(&(b.z - z).abs()))
    }

    /// Slices between two heights.
    pub fn between(&self, low: f64, high: f64) -> impl Iterator<Item = &Slice> {
        self.slices
            .iter()
            .filter(move |s| s.z >= low && s.z <= high)
    }
}

/// Reads a body from its mesh; upright is z.
pub fn body(mesh: &Mesh, ground: f64) -> Option<Body> {
    let (_, high) = mesh.bounds()?;
    let stature = high.z - ground;
    if stature <= 0.0 {
        return None;
    }
    let slices = slices(mesh, ground, high.z, stature / 400.0);
    let mut body = Body {
        ground,
        stature,
        front: -Vector3::y(),
        left: Vector3::x(),
        crotch: None,
        neck: None,
        slices,
    };
    body.crotch = crotch(&body);
    body.neck = neck(&body);
    if let Some(front) = facing(&body) {
        body.front = front;
        body.left = Vector3::z().cross(&front);
    }
    Some(body)
}

/// Two rings of like size, the largest, are legs; the crotch is where they become one.
fn crotch(body: &Body) -> Option<f64> {
    let legs = |s: &Slice| s.rings.len() >= 2 && s.rings[1].area > 0.4 * s.rings[0].area;
    let low = body.ground + 0.12 * body.stature;
    let high = body.ground + 0.65 * body.stature;
    let both: Vec<f64> = body
        .between(low, high)
        .filter(|s| legs(s))
        .map(|s| s.z)
        .collect();
    // The first gap of more than a hundredth of the stature ends the legs.
    let mut top = *both.first()?;
    if top > body.ground + 0.3 * body.stature {
        return None;
    }
    for z in both {
        if z - top > 0.015 * body.stature {
            break;
        }
        top = z;
    }
    Some(top)
}

/// The narrowest ring between the widest of the head and the shoulders.
fn neck(body: &Body) -> Option<f64> {
    let from = body.ground + 0.72 * body.stature;
    let upper: Vec<(f64, f64)> = body
        .between(from, body.ground + 0.995 * body.stature)
        .filter_map(|s| Some((s.z, s.rings.first()?.tape)))
        .collect();
    let head = upper
        .iter()
        .filter(|(z, _)| *z > body.ground + 0.86 * body.stature)
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let below = upper.iter().filter(|(z, _)| *z < head.0);
    let narrow = below.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let shoulders = upper
        .iter()
        .filter(|(z, _)| *z < narrow.0)
        .map(|u| u.1)
        .fold(0.0, f64::max);
    (narrow.1 < 0.92 * head.1 && shoulders > 1.4 * narrow.1).then_some(narrow.0)
}

/// Feet point forward of the ankles.
fn facing(body: &Body) -> Option<Vector3<f64>> {
    let mean = |low: f64, high: f64| {
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for s in body.between(
            body.ground + low * body.stature,
            body.ground + high * body.stature,
        ) {
            for r in s.rings.iter().take(2) {
                sum += r.centre.coords * r.area;
                total += r.area;
            }
        }
        (total > 0.0).then(|| sum / total)
    };
    let mut ahead = mean(0.008, 0.025)? - mean(0.06, 0.09)?;
    ahead.z = 0.0;
    (ahead.norm() > 0.004 * body.stature).then(|| ahead.normalize())
}

/// The upper arm: a plane across it amid shoulder and elbow, from the arm's axis below the armpit.
pub struct Arm {
    /// The plane, its normal down the arm.
    pub plane: Plane,
    /// Direction down the arm.
    pub axis: Vector3<f64>,
}

/// The arm on a side (1 left, -1 right), where it stands clear of the trunk; `z` is the height of
/// the middle of the upper arm. \[mm\]
pub fn arm(mesh: &Mesh, body: &Body, side: f64, z: f64) -> Option<Arm> {
    let low = body.ground + 0.5 * (z - body.ground);
    let apart: Vec<Point3<f64>> = body
        .between(low, z)
        .filter_map(|s| {
            let trunk = s.rings.first()?;
            let is = |r: &&Ring| {
                (r.centre - trunk.centre).dot(&body.left) * side > 0.0 && r.area < 0.35 * trunk.area
            };
            let outer = |r: &Ring| (r.centre - trunk.centre).dot(&body.left) * side;
            s.rings[1..]
                .iter()
                .filter(is)
                .max_by(|a, b| outer(a).total_cmp(&outer(b)))
                .map(|r| r.centre)
        })
        .collect();
    let top = apart.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    // The forearm may be bent: only the upper part of what stands clear tells the axis.
    let reach = 0.10 * body.stature;
    let upper: Vec<&Point3<f64>> = apart.iter().filter(|p| p.z > top - reach).collect();
    if upper.len() < 8 {
        return None;
    }
    let mean = upper.iter().map(|p| p.coords).sum::<Vector3<f64>>() / upper.len() as f64;
    let slope = upper
        .iter()
        .map(|p| (p.coords - mean) * (p.z - mean.z))
        .sum::<Vector3<f64>>();
    let axis = -(slope / slope.z).normalize();
    let middle = Point3::from(mean + axis * ((z - mean.z) / axis.z));
    let plane = Plane {
        point_mm: middle.into(),
        normal: axis.into(),
    };
    // Centred on the ring itself.
    let ring = nearest_ring(mesh, &plane)?;
    let plane = Plane {
        point_mm: centre(&ring.curve).into(),
        ..plane
    };
    Some(Arm { plane, axis })
}

/// The ring of a plane whose middle is nearest to the plane's point.
pub fn nearest_ring(mesh: &Mesh, plane: &Plane) -> Option<Ring> {
    let p = Point3::from(plane.point_mm);
    let far = |r: &Ring| (r.centre - p).norm();
    rings(mesh, plane)
        .into_iter()
        .min_by(|a, b| far(a).total_cmp(&far(b)))
}
