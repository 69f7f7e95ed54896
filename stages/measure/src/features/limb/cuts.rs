//! Sections of a part of a surface: only the faces near a place are looked at.

use crate::features::limb::graph::cell_of;
use crate::geometry::section::{flat, section_of};
use crate::geometry::slices::{Ring, ringed};
use nalgebra::{Point3, Vector3};
use shape::{Mesh, Plane};

/// The faces of a mesh by the cells of a grid.
pub(crate) struct Cuts<'a> {
    mesh: &'a Mesh,
    low: Point3<f64>,
    cell: f64,
    /// How far a face reaches from its middle at most. \[mm\]
    reach: f64,
    /// Cells with faces in rising order, and where their faces start.
    cells: Vec<([u32; 3], usize)>,
    faces: Vec<u32>,
}

impl<'a> Cuts<'a> {
    /// Of a mesh, with cells of a size. \[mm\]
    pub(crate) fn new(mesh: &'a Mesh, cell: f64) -> Cuts<'a> {
        let low = mesh.bounds().map_or(Point3::origin(), |b| b.0);
        let mut reach = 0.0f64;
        let mut named: Vec<([u32; 3], u32)> = (0..mesh.faces.len())
            .map(|f| {
                let corners = mesh.triangle(f);
                let sum = corners.iter().map(|p| p.coords).sum::<Vector3<f64>>();
                let middle = Point3::from(sum / 3.0);
                for p in corners {
                    reach = reach.max((p - middle).norm());
                }
                (cell_of(middle, low, cell), f as u32)
            })
            .collect();
        named.sort_unstable();
        let mut cells: Vec<([u32; 3], usize)> = Vec::new();
        for (i, (key, _)) in named.iter().enumerate() {
            if cells.last().is_none_or(|c| c.0 != *key) {
                cells.push((*key, i));
            }
        }
        Cuts {
            mesh,
            low,
            cell,
            reach,
            cells,
            faces: named.into_iter().map(|n| n.1).collect(),
        }
    }

    /// Closed rings in which a plane cuts the surface within a distance of the plane's point, largest
    /// first; a ring that reaches farther is left out. \[mm\]
    pub(crate) fn rings(&self, plane: &Plane, within: f64) -> Vec<Ring> {
        let (n, p) = (
            Vector3::from(plane.normal).normalize(),
            Point3::from(plane.point_mm),
        );
        // Half a cell's diagonal.
        let half = self.cell * 3f64.sqrt() / 2.0 + self.reach;
        let mut faces = Vec::new();
        for (i, (key, start)) in self.cells.iter().enumerate() {
            let middle = Vector3::from(key.map(|k| (f64::from(k) + 0.5) * self.cell));
            let off = self.low + middle - p;
            if n.dot(&off).abs() <= half && off.norm() <= within + half {
                let end = self.cells.get(i + 1).map_or(self.faces.len(), |c| c.1);
                faces.extend_from_slice(&self.faces[*start..end]);
            }
        }
        ringed(section_of(self.mesh, &faces, plane), plane)
    }

    /// Where a ray from a point crosses the surface, at most so far away. \[mm\]
    pub(crate) fn crossings(&self, from: Point3<f64>, along: Vector3<f64>, most: f64) -> Vec<f64> {
        let half = self.cell * 3f64.sqrt() / 2.0 + self.reach;
        let mut found = Vec::new();
        for (i, (key, start)) in self.cells.iter().enumerate() {
            let middle = Vector3::from(key.map(|k| (f64::from(k) + 0.5) * self.cell));
            let off = self.low + middle - from;
            let t = along.dot(&off).clamp(0.0, most);
            if (off - along * t).norm() > half {
                continue;
            }
            let end = self.cells.get(i + 1).map_or(self.faces.len(), |c| c.1);
            for f in &self.faces[*start..end] {
                let t = crossing(self.mesh.triangle(*f as usize), from, along);
                found.extend(t.filter(|t| (0.0..=most).contains(t)));
            }
        }
        found
    }

    /// The ring around the plane's point, or else the one whose middle is nearest to it, at most `off`
    /// away. \[mm\]
    pub(crate) fn ring(&self, plane: &Plane, within: f64, off: f64) -> Option<Ring> {
        let all = self.rings(plane, within);
        let p = Point3::from(plane.point_mm);
        let around = all
            .iter()
            .rposition(|r| holds_origin(&flat(&r.curve, plane)));
        let far = |r: &Ring| (r.centre - p).norm();
        match around {
            Some(i) => all.into_iter().nth(i),
            None => all
                .into_iter()
                .filter(|r| far(r) <= off)
                .min_by(|a, b| far(a).total_cmp(&far(b))),
        }
    }
}

/// Where a ray crosses a triangle (Möller and Trumbore 1997).
fn crossing([a, b, c]: [Point3<f64>; 3], from: Point3<f64>, along: Vector3<f64>) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let h = along.cross(&v);
    let under = u.dot(&h);
    if under.abs() < 1e-12 {
        return None;
    }
    let s = from - a;
    let q = s.cross(&u);
    let (x, y) = (s.dot(&h) / under, along.dot(&q) / under);
    (x >= 0.0 && y >= 0.0 && x + y <= 1.0).then(|| v.dot(&q) / under)
}

/// Whether a closed curve goes around the origin.
pub(crate) fn holds_origin(curve: &[[f64; 2]]) -> bool {
    let mut inside = false;
    for (i, a) in curve.iter().enumerate() {
        let b = curve[(i + 1) % curve.len()];
        if (a[1] > 0.0) != (b[1] > 0.0) && a[0] - (b[0] - a[0]) * a[1] / (b[1] - a[1]) > 0.0 {
            inside = !inside;
        }
    }
    inside
}
