//! Solids whose curvature is a formula, for this crate's tests.

use shape::Mesh;

/// A sphere around the origin: an octahedron, each face cut in four `cuts` times.
pub(crate) fn sphere(radius: f64, cuts: u32) -> Mesh {
    let mut positions: Vec<[f32; 3]> = vec![
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    for _ in 0..cuts {
        let mut middles = std::collections::BTreeMap::new();
        let mut middle = |a: u32, b: u32, positions: &mut Vec<[f32; 3]>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (positions[a as usize], positions[b as usize]);
                positions.push([0, 1, 2].map(|i| (p[i] + q[i]) / 2.0));
                positions.len() as u32 - 1
            })
        };
        let cut = |[a, b, c]: [u32; 3]| {
            let (x, y, z) = (
                middle(a, b, &mut positions),
                middle(b, c, &mut positions),
                middle(c, a, &mut positions),
            );
            [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
        };
        faces = faces.into_iter().flat_map(cut).collect();
    }
    for p in &mut positions {
        let long = p.iter().map(|x| x * x).sum::<f32>().sqrt();
        *p = p.map(|x| x / long * radius as f32);
    }
    Mesh {
        positions,
        faces,
        ..Mesh::default()
    }
}
