//! Landmarks on arms and legs, and the part of each vertex.

use crate::features::arms::axis_about;
use crate::features::body::{Body, nearest_ring};
use crate::features::marks::Marks;
use crate::features::whole::thighs_are_one;
use crate::geometry::slices::{Ring, Slice, level};
use crate::landmarks::{landmark, missing};
use crate::planes::levels;
use nalgebra::Point3;
use shape::{Landmarks, Mesh, Part, Plane};

/// How much the middle line of an upper arm's flesh leans forward, going down, against the line from
/// joint to joint that the standard means: the median of the bodies that levels were fitted on.
const FLESH: f64 = 0.068;

/// The plane across an upper arm amid shoulder and elbow, from the arm's axis below the armpit.
pub(crate) fn upper_arm(mesh: &Mesh, body: &Body, side: f64, marks: &Marks) -> Option<Plane> {
    let z = body.ground + levels::upper_arm(marks, body.stature);
    let axis = axis_about(body, side, z, body.ground + marks.hip)?;
    let normal = (axis.down - body.front * FLESH).normalize();
    let plane = Plane {
        point_mm: axis.at(z).into(),
        normal: normal.into(),
    };
    // Centred on the ring itself, where that is the arm's alone.
    let ring = nearest_ring(mesh, &plane)?;
    let off = (ring.centre - axis.at(z)).norm();
    if off > 0.02 * body.stature {
        return Some(plane);
    }
    Some(Plane {
        point_mm: ring.centre.into(),
        ..plane
    })
}

/// Why there is no thigh.
const ONE: &str = "the thighs are one on the surface well below the crotch, so where they are fullest does not show: \
     stand with the feet farther apart";

/// Thigh and calf of both legs.
pub(crate) fn legs(body: &Body, found: &mut Landmarks) {
    let Some(crotch) = body.crotch else { return };
    let inside = crotch - body.ground;
    let one = thighs_are_one(body);
    for (side, part, suffix, word) in [
        (1.0, Part::LegLeft, "L", "left"),
        (-1.0, Part::LegRight, "R", "right"),
    ] {
        let leg = |s: &Slice| {
            let two = s.rings.get(..2)?;
            let out = |r: &Ring| r.centre.coords.dot(&body.left) * side;
            let ring = if out(&two[0]) > out(&two[1]) {
                &two[0]
            } else {
                &two[1]
            };
            Some((s.z, ring.tape, ring.centre))
        };
        let widest = |low: f64, high: f64| {
            let range = body.between(body.ground + low * inside, body.ground + high * inside);
            range.filter_map(leg).max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let mut add = |name: &str, label: &str, text: &str, at: Option<(f64, f64, Point3<f64>)>| {
            let Some((z, _, c)) = at else { return };
            let plane = Plane {
                point_mm: [c.x, c.y, z],
                ..level(z)
            };
            let (name, label) = (format!("{name}_{suffix}"), format!("{label}, {word}"));
            found.found.push(landmark(&name, &label, text, plane, part));
        };
        if one {
            found.missing.push(missing(&format!("TC_{suffix}"), ONE));
        } else {
            add(
                "TC",
                "thigh",
                "thigh: horizontal, fullest below the crotch (ISO 8559-1 5.3.20)",
                widest(0.8, 0.99),
            );
        }
        add(
            "CFC",
            "calf",
            "calf: horizontal, greatest (ISO 8559-1 5.3.24)",
            widest(0.3, 0.58),
        );
    }
}

/// The part of each vertex: head above the neck, legs below the crotch, arms beyond the trunk.
pub(crate) fn parts(mesh: &Mesh, body: &Body) -> Vec<u8> {
    let neck = body.neck.unwrap_or(f64::MAX);
    let crotch = body.crotch.unwrap_or(f64::MIN);
    let half = body
        .trunk(crotch.max(body.ground) + 0.05 * body.stature)
        .map_or(f64::MAX, |r| {
            let reach = r.curve.iter().map(|p| (p - r.centre).dot(&body.left).abs());
            reach.fold(0.0, f64::max)
        });
    let part = |v: u32| {
        let p = mesh.point(v);
        let out = p.coords.dot(&body.left);
        let (arm, leg) = match out > 0.0 {
            true => (Part::ArmLeft, Part::LegLeft),
            false => (Part::ArmRight, Part::LegRight),
        };
        match p.z {
            z if z > neck => Part::Head,
            _ if out.abs() > 1.15 * half => arm,
            z if z < crotch => leg,
            _ => Part::Trunk,
        }
    };
    (0..mesh.positions.len() as u32)
        .map(|v| part(v) as u8)
        .collect()
}
