//! Small holes of a scan, closed by a fan of triangles about their middle.

use shape::Mesh;
use std::collections::BTreeMap;

/// A hole's edge is at most so long, as a share of the body's greatest extent (by hand: 17 cm around on a grown person;
/// a flat cover over more would be no skin).
const SMALL: f64 = 0.1;

/// Closes small holes; how many, and the length of the longest edge of one in the file's unit.
pub(crate) fn closed(mesh: &mut Mesh) -> (usize, f64) {
    let Some((low, high)) = mesh.bounds() else {
        return (0, 0.0);
    };
    let most = SMALL * (high - low).max();
    let (mut count, mut longest) = (0, 0.0f64);
    for edge in edges(mesh) {
        let n = edge.len();
        let at = |i: usize| mesh.point(edge[i % n]);
        let long: f64 = (0..n).map(|i| (at(i + 1) - at(i)).norm()).sum();
        if n < 3 || long > most {
            continue;
        }
        let middle = (0..n).fold([0.0; 3], |m, i| {
            std::array::from_fn(|k| m[k] + at(i)[k] / n as f64)
        });
        let new = mesh.positions.len() as u32;
        mesh.positions.push(middle.map(|x| x as f32));
        if !mesh.colors.is_empty() {
            mesh.colors.push(mesh.colors[edge[0] as usize]);
        }
        let fan = (0..n).map(|i| [edge[i], edge[(i + 1) % n], new]);
        mesh.faces.extend(fan);
        (count, longest) = (count + 1, longest.max(long));
    }
    (count, longest)
}

/// Edges of holes, in the direction in which a face beyond them would run; those that meet themselves are left out.
fn edges(mesh: &Mesh) -> Vec<Vec<u32>> {
    let sides = |f: &[u32; 3]| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
    let mut open: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for (a, b) in mesh.faces.iter().flat_map(sides) {
        *open.entry((a, b)).or_default() += 1;
        *open.entry((b, a)).or_default() -= 1;
    }
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for ((a, b), lacks) in open {
        if lacks < 0 {
            next.entry(a).or_default().push(b);
        }
    }
    next.retain(|_, ways| ways.len() == 1);
    let mut found = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let (mut edge, mut at) = (Vec::new(), start);
        while let Some(to) = next.remove(&at) {
            edge.push(at);
            at = to[0];
        }
        if at == start {
            found.push(edge);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_hole_is_closed_and_a_large_one_stays() {
        // A block without one face of twelve: as large as the block.
        let (positions, faces) = proof::block([1.0, 1.0, 1.0]);
        let mut mesh = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        mesh.faces.remove(0);
        assert_eq!(closed(&mut mesh).0, 0);
        // A long strip with two sides, without one of its faces.
        let mut mesh = Mesh {
            positions: (0..40)
                .flat_map(|k| [[k as f32, 0.0, 0.0], [k as f32, 1.0, 0.0]])
                .collect(),
            ..Mesh::default()
        };
        for k in 0..39u32 {
            mesh.faces.extend([
                [2 * k, 2 * k + 2, 2 * k + 1],
                [2 * k + 1, 2 * k + 2, 2 * k + 3],
            ]);
            mesh.faces.extend([
                [2 * k, 2 * k + 1, 2 * k + 2],
                [2 * k + 1, 2 * k + 3, 2 * k + 2],
            ]);
        }
        let whole = mesh.faces.len();
        mesh.faces.remove(30);
        let (count, long) = closed(&mut mesh);
        assert_eq!((count, mesh.faces.len()), (1, whole + 2));
        assert!((3.0..3.5).contains(&long), "{long}");
    }
}
