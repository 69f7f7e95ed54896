//! A plane carried from a body to the same body in another pose.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::{Mesh, Plane};

/// Vertices so near to the plane give how it moved. By hand: not on record. \[mm\]
const NEAR_MM: f64 = 20.0;

/// The plane on the moved twin of a mesh: the rigid motion (least squares, Umeyama 1991) of what is near to it
/// and wanted. `None` where fewer than ten vertices are.
pub fn carried(
    plane: &Plane,
    mesh: &Mesh,
    moved: &Mesh,
    wanted: impl Fn(usize) -> bool,
) -> Option<Plane> {
    let (at, normal) = (
        Point3::from(plane.point_mm),
        Vector3::from(plane.normal).normalize(),
    );
    let near = |v: &u32| wanted(*v as usize) && normal.dot(&(mesh.point(*v) - at)).abs() < NEAR_MM;
    let near: Vec<u32> = (0..mesh.positions.len() as u32).filter(near).collect();
    if near.len() < 10 {
        return None;
    }
    let middle = |mesh: &Mesh| {
        near.iter()
            .map(|v| mesh.point(*v).coords)
            .sum::<Vector3<f64>>()
            / near.len() as f64
    };
    let (a, b) = (middle(mesh), middle(moved));
    let outer = |v: &u32| (moved.point(*v).coords - b) * (mesh.point(*v).coords - a).transpose();
    let svd = near.iter().map(outer).sum::<Matrix3<f64>>().svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let flip = Vector3::new(1.0, 1.0, (u * v_t).determinant().signum());
    let turn = Rotation3::from_matrix_unchecked(u * Matrix3::from_diagonal(&flip) * v_t);
    let point = turn * (at.coords - a) + b;
    Some(Plane {
        point_mm: point.into(),
        normal: (turn * normal).into(),
    })
}
