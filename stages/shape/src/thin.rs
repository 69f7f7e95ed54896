//! Fewer faces for a page: vertices of a grid cell become one (Rossignac and Borrel 1993).

use crate::Mesh;
use std::collections::BTreeMap;

/// The mesh with at most about `most_faces` faces; as it is if it has no more. Vertices keep the
/// colour of the first that became them.
pub fn thinned(mesh: &Mesh, most_faces: usize) -> Mesh {
    let mut cell = (mesh.mean_edge() as f32).max(1e-6);
    let mut small = mesh.clone();
    while small.faces.len() > most_faces {
        cell *= (small.faces.len() as f32 / most_faces as f32)
            .sqrt()
            .max(1.05);
        small = clustered(mesh, cell);
    }
    small
}

/// One vertex a cell: the mean of its vertices; faces that collapse or repeat go.
fn clustered(mesh: &Mesh, cell: f32) -> Mesh {
    let mut cells: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut sums: Vec<([f64; 3], f64, usize)> = Vec::new();
    let mut merged = Vec::with_capacity(mesh.positions.len());
    for (v, p) in mesh.positions.iter().enumerate() {
        let key = p.map(|x| (x / cell).floor() as i32);
        let at = *cells.entry(key).or_insert(sums.len() as u32);
        if at as usize == sums.len() {
            sums.push(([0.0; 3], 0.0, v));
        }
        let (sum, count, _) = &mut sums[at as usize];
        (0..3).for_each(|i| sum[i] += f64::from(p[i]));
        *count += 1.0;
        merged.push(at);
    }
    let renamed = |face: &[u32; 3]| face.map(|v| merged[v as usize]);
    let turned = |[a, b, c]: [u32; 3]| {
        // The least vertex first, so that equal faces are equal.
        if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        }
    };
    let mut faces: Vec<[u32; 3]> = mesh
        .faces
        .iter()
        .map(renamed)
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .map(turned)
        .collect();
    faces.sort_unstable();
    faces.dedup();
    Mesh {
        positions: sums
            .iter()
            .map(|(s, n, _)| s.map(|x| (x / n) as f32))
            .collect(),
        faces,
        colors: match mesh.colors.is_empty() {
            true => vec![],
            false => sums
                .iter()
                .map(|(_, _, first)| mesh.colors[*first])
                .collect(),
        },
        unit: mesh.unit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_keeps_its_area() {
        let n = 60u32;
        let mut mesh = Mesh::default();
        for y in 0..=n {
            mesh.positions
                .extend((0..=n).map(|x| [x as f32, y as f32, 0.0]));
        }
        for (y, x) in (0..n).flat_map(|y| (0..n).map(move |x| (y, x))) {
            let v = y * (n + 1) + x;
            mesh.faces
                .extend([[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]);
        }
        let small = thinned(&mesh, 800);
        assert!(small.positions.iter().all(|p| p[2] == 0.0));
        let area = |m: &Mesh| {
            (0..m.faces.len())
                .map(|f| m.area_vector(f).z / 2.0)
                .sum::<f64>()
        };
        assert!(small.faces.len() <= 800 && small.faces.len() > 200);
        assert!(small.validate().is_ok());
        assert!(
            area(&small) > 0.9 * area(&mesh),
            "{} {}",
            area(&small),
            area(&mesh)
        );
    }
    #[test]
    fn a_mesh_without_extent_ends_too() {
        let mesh = Mesh {
            positions: vec![[1.0; 3]; 3],
            faces: vec![[0, 1, 2]; 40],
            ..Mesh::default()
        };
        assert!(thinned(&mesh, 10).faces.is_empty());
        assert_eq!(thinned(&mesh, 40), mesh);
    }
}
