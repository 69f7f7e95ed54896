//! A body cut into horizontal slices: which curve is trunk, which are arms and legs.

use crate::geometry::section::{Loop, area, centre, flat, section, tape};
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
    let ring = |curve: Loop| {
        let points = flat(&curve, plane);
        Ring {
            area: area(&points).abs(),
            tape: tape(&points),
            centre: centre(&curve),
            curve,
        }
    };
    let mut rings: Vec<Ring> = section(mesh, plane).into_iter().map(ring).collect();
    rings.sort_by(|a, b| b.area.total_cmp(&a.area));
    let least = rings.first().map_or(0.0, |r| r.area * 0.01);
    rings.retain(|r| r.area >= least);
    rings
}

/// Slices every `step` from `low` to `high`. \[mm\]
pub fn slices(mesh: &Mesh, low: f64, high: f64, step: f64) -> Vec<Slice> {
    let count = ((high - low) / step).floor().max(0.0) as usize;
    (0..count)
        .into_par_iter()
        .map(|i| low + step * (i as f64 + 0.5))
        .map(|z| Slice {
            z,
            rings: rings(mesh, &level(z)),
        })
        .collect()
}
