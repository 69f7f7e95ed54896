//! Holes of a scan, closed by a fan of triangles about their middle.

use shape::Mesh;
use std::collections::BTreeMap;

/// A hole is at most so far across, as a share of the body's greatest extent (derived: soles that no scanner saw, a foot is 0.15 of
/// stature long by ANSUR II, and longer in a shoe; a body that is cut off is open 0.3 and more).
const LARGEST: f64 = 0.2;

/// Closes holes; how many, and how far the largest is across, in the file's unit.
pub(crate) fn closed(mesh: &mut Mesh) -> (usize, f64) {
    let extent = |all: &mut dyn Iterator<Item = [f32; 3]>| {
        let [low, high] = all.fold([[f32::MAX; 3], [f32::MIN; 3]], |[low, high], p| {
            [
                std::array::from_fn(|k| low[k].min(p[k])),
                std::array::from_fn(|k| high[k].max(p[k])),
            ]
        });
        (0..3)
            .map(|k| f64::from(high[k] - low[k]))
            .fold(0.0, f64::max)
    };
    let most = LARGEST * extent(&mut mesh.positions.iter().copied());
    let (mut count, mut largest) = (0, 0.0f64);
    for edge in edges(mesh) {
        let n = edge.len();
        let across = extent(&mut edge.iter().map(|v| mesh.positions[*v as usize]));
        if n < 3 || across > most {
            continue;
        }
        let middle = edge.iter().fold([0.0; 3], |m, v| {
            std::array::from_fn(|k| m[k] + mesh.point(*v)[k] / n as f64)
        });
        let new = mesh.positions.len() as u32;
        mesh.positions.push(middle.map(|x| x as f32));
        if !mesh.colors.is_empty() {
            mesh.colors.push(mesh.colors[edge[0] as usize]);
        }
        let fan = (0..n).map(|i| [edge[i], edge[(i + 1) % n], new]);
        mesh.faces.extend(fan);
        (count, largest) = (count + 1, largest.max(across));
    }
    (count, largest)
}

/// Edges of holes, in the direction in which a face beyond them would run. Where several meet in a vertex, each is taken by itself.
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
    let mut found = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let (mut way, mut at) = (vec![start], start);
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            if next[&at].is_empty() {
                next.remove(&at);
            }
            match way.iter().position(|v| *v == to) {
                Some(first) => {
                    found.push(way.split_off(first));
                    way.push(to);
                }
                None => way.push(to),
            }
            at = to;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_closed_though_they_meet_and_one_as_large_as_the_body_stays() {
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
        // Two that meet in a vertex.
        mesh.faces.remove(44);
        mesh.faces.remove(40);
        let (count, across) = closed(&mut mesh);
        assert_eq!((count, mesh.faces.len()), (2, whole + 4));
        proof::near(across, 1.0, 1e-6);
    }
}
