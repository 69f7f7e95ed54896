//! Sections that cross a hole of a scan which is closed by a flat cover, a fan about a vertex: the skin there runs anywhere
//! between the cover and an arc.

use nalgebra::{Point3, Vector3};
use shape::{Mesh, Plane};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A vertex of so many faces is the middle of a cover (structural: most have six; a fan of fewer is hardly wider than an edge or two,
/// and what bulges over one of a surface's own is as little).
const SPOKES: u32 = 12;

/// The edges of holes that are closed by flat covers, by the vertex in the middle.
pub(crate) struct Covers(BTreeMap<u32, Vec<[u32; 2]>>);

impl Covers {
    /// All of a surface.
    pub(crate) fn of(mesh: &Mesh) -> Covers {
        let mut count = vec![0u32; mesh.positions.len()];
        mesh.faces
            .iter()
            .flatten()
            .for_each(|v| count[*v as usize] += 1);
        let mut covers: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        for [a, b, c] in &mesh.faces {
            for [middle, from, to] in [[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]] {
                if count[middle as usize] >= SPOKES {
                    covers.entry(middle).or_default().push([from, to]);
                }
            }
        }
        Covers(covers)
    }

    /// How much longer a tape is if the skin bulges over the covers in its contour as a circle of so long a tape does. \[mm\]
    pub(crate) fn bulge_mm(
        &self,
        mesh: &Mesh,
        (contour, plane): (&[Point3<f64>], &Plane),
        tape_mm: f64,
    ) -> f64 {
        let (n, p) = (
            Vector3::from(plane.normal).normalize(),
            Point3::from(plane.point_mm),
        );
        let crossing = |[a, b]: &[u32; 2]| {
            let (a, b) = (mesh.point(*a), mesh.point(*b));
            let [from, to] = [a, b].map(|x| n.dot(&(x - p)));
            ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
        };
        let near = mesh.mean_edge();
        let on = |x: &Point3<f64>| contour.iter().any(|c| (c - x).norm() < near);
        let radius = tape_mm / TAU;
        let bulge = |edge: &Vec<[u32; 2]>| {
            let met: Vec<Point3<f64>> = edge.iter().filter_map(crossing).collect();
            let Some(first) = met.first().filter(|first| on(first)) else {
                return 0.0;
            };
            let chord = met.iter().map(|x| (x - first).norm()).fold(0.0, f64::max);
            2.0 * radius * libm::asin((chord / (2.0 * radius)).min(1.0)) - chord
        };
        self.0.values().map(bulge).sum()
    }
}
