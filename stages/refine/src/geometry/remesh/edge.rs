//! Edges and faces as remeshing looks at them.

use nalgebra::{Point3, Vector3};
use shape::Mesh;

/// Every edge once, its lesser vertex first.
pub(super) fn edges(mesh: &Mesh) -> impl Iterator<Item = (u32, u32)> {
    let each = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
    mesh.faces.iter().flat_map(each).filter(|(a, b)| a < b)
}

/// The unit normal of a vertex with these faces, ascending: as [`Mesh::normals`] has it, byte for byte.
pub(super) fn normal(mesh: &Mesh, faces: &[u32]) -> Vector3<f64> {
    let sum = faces.iter().map(|f| area(mesh, mesh.faces[*f as usize]));
    sum.fold(Vector3::zeros(), |sum, n| sum + n)
        .try_normalize(0.0)
        .unwrap_or_default()
}

/// The middle of an edge, lifted from the chord to the surface that the normals of its ends describe.
pub(super) fn middle(mesh: &Mesh, [m, n]: [Vector3<f64>; 2], a: u32, b: u32) -> [f32; 3] {
    let (p, q) = (mesh.point(a), mesh.point(b));
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
