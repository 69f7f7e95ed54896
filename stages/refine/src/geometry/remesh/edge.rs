//! Edges and faces as remeshing looks at them.

use nalgebra::{Point3, Vector3};
use shape::{Mesh, rows};

/// Every edge once, its lesser vertex first, ascending.
pub(super) fn edges(mesh: &Mesh) -> Vec<(u32, u32)> {
    let each = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
    let all = mesh.faces.iter().flat_map(each).filter(|(a, b)| a < b);
    let (starts, mut ends_of) = rows(mesh.positions.len(), all);
    let mut edges = Vec::with_capacity(ends_of.len());
    for (v, ends) in starts.windows(2).enumerate() {
        let ends_of = &mut ends_of[ends[0] as usize..ends[1] as usize];
        ends_of.sort_unstable();
        edges.extend(ends_of.iter().map(|other| (v as u32, *other)));
    }
    edges
}

/// The middle of an edge, lifted from the chord to the surface that the normals describe.
pub(super) fn middle(mesh: &Mesh, normals: &[Vector3<f64>], a: u32, b: u32) -> [f32; 3] {
    let (p, q) = (mesh.point(a), mesh.point(b));
    let (m, n) = (normals[a as usize], normals[b as usize]);
    let lift = (n - m).dot(&(q - p)) / 8.0;
    let most = 0.1 * (q - p).norm();
    let up = (m + n).try_normalize(0.0).unwrap_or_default() * lift.clamp(-most, most);
    let x: Point3<f64> = nalgebra::center(&p, &q) + up;
    [x.x as f32, x.y as f32, x.z as f32]
}

/// Twice the area times the normal of three points.
pub(super) fn area(mesh: &Mesh, [a, b, c]: [u32; 3]) -> Vector3<f64> {
    let (a, b, c) = (mesh.point(a), mesh.point(b), mesh.point(c));
    (b - a).cross(&(c - a))
}
