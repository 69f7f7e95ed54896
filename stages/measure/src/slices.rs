//! A body cut into horizontal slices: which curve is trunk, which are arms and legs.

use crate::section::{Loop, area, centre, flat, hull, length, section, tape};
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

/// A ring of trunk and arms with the arms cut off at the folds of the armpits.
///
/// `left` is the subject's left (unit, horizontal). On each side the fold in front and the one at
/// the back are the points deepest under the convex hull; the trunk ends at the chord between
/// them. `None` on a side without two folds deeper than a fortieth of the width.
pub fn without_arms(ring: &Ring, left: [f64; 2], front: [f64; 2]) -> Option<Vec<[f64; 2]>> {
    let points = flat(&ring.curve, &level(ring.centre.z));
    let middle = [ring.centre.x, ring.centre.y];
    // In the subject's own axes: x to the left, y to the front. `level`'s axes are world x and y.
    let own: Vec<[f64; 2]> = points
        .iter()
        .map(|p| [p[0] - middle[0], p[1] - middle[1]])
        .map(|p| {
            [
                p[0] * left[0] + p[1] * left[1],
                p[0] * front[0] + p[1] * front[1],
            ]
        })
        .collect();
    let border = hull(&own);
    let depth = |p: &[f64; 2]| {
        (0..border.len())
            .map(|i| {
                let (a, b) = (border[i], border[(i + 1) % border.len()]);
                let side = length(&[a, b]) / 2.0;
                ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / side.max(1e-9)
            })
            .fold(f64::MAX, f64::min)
    };
    let width = own.iter().map(|p| p[0].abs()).fold(0.0, f64::max) * 2.0;
    let mut kept = own.clone();
    for side in [1.0, -1.0] {
        let fold = |facing: f64| {
            own.iter()
                .filter(|p| p[0] * side > 0.15 * width && p[1] * facing > 0.0)
                .map(|p| (depth(p), *p))
                .max_by(|a, b| a.0.total_cmp(&b.0))
                .filter(|(deep, _)| *deep > width / 80.0)
        };
        let ((_, f), (_, b)) = (fold(1.0)?, fold(-1.0)?);
        // Keep what lies inward of the chord.
        kept.retain(|p| {
            let t = ((p[1] - b[1]) / (f[1] - b[1])).clamp(0.0, 1.0);
            p[0] * side <= (b[0] + t * (f[0] - b[0])) * side + 1e-9
        });
    }
    (kept.len() > 8).then_some(kept)
}
