//! Vertices and faces in an order in which neighbours in space are neighbours in memory.
//!
//! Every loop over vertices reads the photos around each: in the order that remeshing leaves, each
//! read misses the cache; along a space-filling curve (Morton 1966) few do.

use shape::Mesh;

/// Cells a side of the curve's grid, as a power of two (structural).
const BITS: u32 = 10;

/// The same mesh, vertices along a Morton curve, faces by their first vertex. Colours are dropped.
pub(super) fn ordered(mesh: &Mesh) -> Mesh {
    let Some(first) = mesh.positions.first() else {
        return mesh.clone();
    };
    let (mut low, mut high) = (*first, *first);
    for p in &mesh.positions {
        low = [0, 1, 2].map(|i| low[i].min(p[i]));
        high = [0, 1, 2].map(|i| high[i].max(p[i]));
    }
    let most = [0, 1, 2].map(|i| high[i] - low[i]).into_iter();
    let cell = most.fold(0.0, f32::max) / (1 << BITS) as f32;
    let place = |p: &[f32; 3]| -> u32 {
        let at = [0, 1, 2].map(|i| ((p[i] - low[i]) / cell.max(1e-6)) as u32);
        let at = at.map(|a| a.min((1 << BITS) - 1));
        (0..BITS).fold(0, |code, bit| {
            (0..3).fold(code, |code, i| {
                code | (at[i] >> bit & 1) << (3 * bit + i as u32)
            })
        })
    };
    let mut along: Vec<(u32, u32)> = mesh.positions.iter().map(place).zip(0..).collect();
    along.sort_unstable();
    let mut now = vec![0u32; along.len()];
    for (to, (_, from)) in (0..).zip(&along) {
        now[*from as usize] = to;
    }
    let positions = along.iter().map(|(_, v)| mesh.positions[*v as usize]);
    let turned = |face: &[u32; 3]| {
        let face = face.map(|v| now[v as usize]);
        let least = (0..3).min_by_key(|i| face[*i]).unwrap_or(0);
        [0, 1, 2].map(|i| face[(least + i) % 3])
    };
    let mut faces: Vec<[u32; 3]> = mesh.faces.iter().map(turned).collect();
    faces.sort_unstable();
    Mesh {
        positions: positions.collect(),
        faces,
        unit: mesh.unit,
        ..Mesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn the_ordered_mesh_is_the_same_and_its_neighbours_are_near() {
        let mesh = sphere(50.0, 5);
        let sorted = ordered(&mesh);
        assert_eq!(sorted.validate_closed(), Ok(()));
        proof::near(sorted.volume(), mesh.volume(), 1e-6 * mesh.volume());
        let apart = |mesh: &Mesh| -> f64 {
            let each = mesh.faces.iter().flat_map(|f| [(f[0], f[1]), (f[1], f[2])]);
            let sum: u64 = each.map(|(a, b)| u64::from(a.abs_diff(b))).sum();
            sum as f64 / (2 * mesh.faces.len()) as f64
        };
        assert!(apart(&sorted) < 0.3 * apart(&mesh));
        assert_eq!(ordered(&sorted), sorted);
    }
}
