//! Parts of a mesh in which many sections are taken quickly: near an upright line, or between two planes.

use nalgebra::{Point3, Vector3};
use shape::{Mesh, Plane};

/// The faces all of whose corners are within a distance of the upright line through a point, and between
/// two heights. \[mm\]
pub(crate) fn near(
    mesh: &Mesh,
    middle: &Point3<f64>,
    radius: f64,
    (low, high): (f64, f64),
) -> Mesh {
    let mut name = vec![u32::MAX; mesh.positions.len()];
    let mut part = Mesh::default();
    for (v, slot) in name.iter_mut().enumerate() {
        let p = mesh.point(v as u32);
        if p.z >= low && p.z <= high && libm::hypot(p.x - middle.x, p.y - middle.y) <= radius {
            *slot = part.positions.len() as u32;
            part.positions.push(mesh.positions[v]);
        }
    }
    let named = mesh.faces.iter().map(|f| f.map(|v| name[v as usize]));
    part.faces = named.filter(|f| !f.contains(&u32::MAX)).collect();
    part
}

/// The faces with a corner between `low` and `high` along a plane's normal, counted from it, as a
/// mesh of their own. Any plane square to that normal between the two cuts it as it cuts the whole. \[mm\]
pub(crate) fn slab(mesh: &Mesh, plane: &Plane, low: f64, high: f64) -> Mesh {
    let (n, p) = (
        Vector3::from(plane.normal).normalize(),
        Point3::from(plane.point_mm),
    );
    let height: Vec<f64> = (0..mesh.positions.len() as u32)
        .map(|v| n.dot(&(mesh.point(v) - p)))
        .collect();
    let mut out = Mesh::default();
    let mut name = vec![u32::MAX; mesh.positions.len()];
    for face in &mesh.faces {
        let (least, most) = face
            .iter()
            .map(|v| height[*v as usize])
            .fold((f64::MAX, f64::MIN), |e, h| (e.0.min(h), e.1.max(h)));
        if most < low || least > high {
            continue;
        }
        out.faces.push(face.map(|v| {
            let known = &mut name[v as usize];
            if *known == u32::MAX {
                *known = out.positions.len() as u32;
                out.positions.push(mesh.positions[v as usize]);
            }
            *known
        }));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_faces_within_are_kept_and_they_are_the_same_triangles() {
        let mesh = Mesh {
            positions: vec![
                [0.0, 0.0, 0.0],
                [10.0, 0.0, 0.0],
                [0.0, 10.0, 5.0],
                [90.0, 0.0, 0.0],
                [0.0, 0.0, 60.0],
            ],
            faces: vec![[3, 0, 1], [0, 1, 2], [2, 1, 4]],
            colors: Vec::new(),
            ..Mesh::default()
        };
        let part = near(&mesh, &Point3::origin(), 50.0, (-1.0, 50.0));
        assert_eq!(part.faces.len(), 1);
        assert_eq!(part.triangle(0), mesh.triangle(1));
        assert!(
            near(&mesh, &Point3::origin(), 5.0, (-1.0, 50.0))
                .faces
                .is_empty()
        );
    }
}
