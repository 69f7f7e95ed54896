//! Holes of a scan, closed by a fan of triangles about their middle.

use shape::Mesh;
use std::collections::BTreeMap;

/// A hole is at most so far across, as a share of the body's greatest extent (derived: soles that no scanner saw, a foot is 0.15 of
/// stature long by ANSUR II, and longer in a shoe; a body that is cut off is open 0.3 and more).
const LARGEST: f64 = 0.2;

/// A hole in the upper half of a head is at most so far across, as a share of stature: a flat cover over more would take more than
/// 0.3 % of it (derived: of a ball with a head's radius, 0.055 of stature).
const CROWN: f64 = 0.036;
/// The upper half of a head, as a share of stature (derived: half of menton to top of head, ANSUR II).
const HEAD: f64 = 0.065;

/// The cover of a hole.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cover {
    /// The vertex in its middle, and those around it.
    middle: u32,
    edge: Vec<u32>,
    /// How far the hole is across, in the file's unit.
    pub(crate) across: f64,
}

/// Opens again, of a surface with z up, what took the place of the crown: heights must not end at a flat cover.
pub(crate) fn crown_opened(mesh: &mut Mesh, covers: &mut Vec<Cover>) {
    let Some((low, high)) = mesh.bounds() else {
        return;
    };
    let tall = high.z - low.z;
    let crown = |cover: &Cover| {
        let at = cover.edge.iter().map(|v| mesh.point(*v));
        let [x, y] = [0, 1].map(|k| {
            let all = at.clone().map(|p| p[k]);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        });
        let top = at.map(|p| p.z).fold(f64::MIN, f64::max);
        top > high.z - HEAD * tall && x.max(y) > CROWN * tall
    };
    let open: Vec<u32> = covers
        .iter()
        .filter(|c| crown(c))
        .map(|c| c.middle)
        .collect();
    if open.is_empty() {
        return;
    }
    covers.retain(|cover| !open.contains(&cover.middle));
    let faces = mesh
        .faces
        .iter()
        .filter(|f| !f.iter().any(|v| open.contains(v)));
    let faces: Vec<[u32; 3]> = faces.copied().collect();
    *mesh = Mesh {
        unit: mesh.unit,
        ..Mesh::packed(&mesh.positions, &faces)
    };
}

/// Closes holes.
pub(crate) fn closed(mesh: &mut Mesh) -> Vec<Cover> {
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
    let mut covers = Vec::new();
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
        covers.push(Cover {
            middle: new,
            edge,
            across,
        });
    }
    covers
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
        assert_eq!(closed(&mut mesh), []);
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
        let covers = closed(&mut mesh);
        assert_eq!((covers.len(), mesh.faces.len()), (2, whole + 4));
        proof::near(covers[0].across, 1.0, 1e-6);
    }

    #[test]
    fn a_crown_that_is_cut_off_stays_open_and_soles_are_closed() {
        // A tube with a ring of vertices at each height, open at both ends.
        let (around, heights) = (24u32, 40u32);
        let tube = |radius: f64| {
            let at = |k: u32| {
                let (s, c) = libm::sincos(f64::from(k % around) / 24.0 * std::f64::consts::TAU);
                [radius * c, radius * s, f64::from(k / around) * 44.0].map(|x| x as f32)
            };
            let face = |k: u32| {
                let (a, b) = (k, k / around * around + (k + 1) % around);
                [[a, b, a + around], [b, b + around, a + around]]
            };
            Mesh {
                positions: (0..around * heights).map(at).collect(),
                faces: (0..around * (heights - 1)).flat_map(face).collect(),
                ..Mesh::default()
            }
        };
        for (radius, left) in [(80.0, 1), (25.0, 2)] {
            let mut mesh = tube(radius);
            let mut covers = closed(&mut mesh);
            assert_eq!(covers.len(), 2);
            crown_opened(&mut mesh, &mut covers);
            assert_eq!(covers.len(), left, "{radius}");
            assert_eq!(mesh.validate_closed().is_ok(), left == 2);
        }
    }
}
