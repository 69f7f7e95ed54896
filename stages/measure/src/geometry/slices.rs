//! A body cut into horizontal slices: which curve is trunk, which are arms and legs.

use crate::geometry::section::{Loop, area, centre, flat, section, section_of, tape};
use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Mesh, Plane};

/// One curve of a slice.
#[derive(Debug, Clone)]
pub struct Ring {
    /// The curve. \[mm\]
    pub curve: Loop,
    /// Area within. \[mm²\]
    pub area: f64,
    /// Length of a tape around it. \[mm\]
    pub tape: f64,
    /// Its middle. \[mm\]
    pub centre: Point3<f64>,
}

/// One slice: its rings, largest first; specks are left out.
#[derive(Debug, Clone)]
pub struct Slice {
    /// Height. \[mm\]
    pub z: f64,
    /// The rings.
    pub rings: Vec<Ring>,
}

/// A horizontal plane.
pub fn level(z: f64) -> Plane {
    Plane {
        point_mm: [0.0, 0.0, z],
        normal: [0.0, 0.0, 1.0],
    }
}

/// The rings that a plane cuts, largest first.
pub fn rings(mesh: &Mesh, plane: &Plane) -> Vec<Ring> {
    ringed(section(mesh, plane), plane)
}

/// The ring of a plane whose middle is nearest to the plane's point.
pub fn nearest_ring(mesh: &Mesh, plane: &Plane) -> Option<Ring> {
    let p = Point3::from(plane.point_mm);
    let far = |r: &Ring| (r.centre - p).norm();
    rings(mesh, plane)
        .into_iter()
        .min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Curves of a plane as rings, largest first; specks are left out.
pub(crate) fn ringed(curves: Vec<Loop>, plane: &Plane) -> Vec<Ring> {
    let ring = |curve: Loop| {
        let points = flat(&curve, plane);
        Ring {
            area: area(&points).abs(),
            tape: tape(&points),
            centre: centre(&curve),
            curve,
        }
    };
    let mut rings: Vec<Ring> = curves.into_iter().map(ring).collect();
    rings.sort_by(|a, b| b.area.total_cmp(&a.area));
    let least = rings.first().map_or(0.0, |r| r.area * 0.01);
    rings.retain(|r| r.area >= least);
    rings
}

/// Slices every `step` from `low` to `high`. \[mm\]
pub fn slices(mesh: &Mesh, low: f64, high: f64, step: f64) -> Vec<Slice> {
    let count = ((high - low) / step).floor().max(0.0) as usize;
    let height = |i: usize| low + step * (i as f64 + 0.5);
    // The faces that each slice may cut: each looks at its own alone.
    let mut own: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (f, face) in mesh.faces.iter().enumerate() {
        let z = face.map(|v| f64::from(mesh.positions[v as usize][2]));
        let (least, most) = z
            .iter()
            .fold((f64::MAX, f64::MIN), |e, z| (e.0.min(*z), e.1.max(*z)));
        let first = ((least - low) / step - 1.5).max(0.0) as usize;
        let last = ((most - low) / step + 1.5).max(0.0) as usize;
        for slice in own.iter_mut().take(last).skip(first) {
            slice.push(f as u32);
        }
    }
    own.into_par_iter()
        .enumerate()
        .map(|(i, faces)| {
            let z = height(i);
            let plane = level(z);
            let curves = section_of(mesh, &faces, &plane);
            Slice {
                z,
                rings: ringed(curves, &plane),
            }
        })
        .collect()
}
