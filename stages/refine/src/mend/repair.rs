//! Takes out what passes through itself and closes the holes: the last resort, where no step back and no
//! smoothing has parted two sheets (after Attene 2010, "A lightweight approach to repairing digitized
//! polygon meshes", sec. 3: the faces that cross go, growing outward, and each hole gets a cap).

use crate::mend::crossing::crossings;
use shape::{Adjacency, Mesh};
use std::collections::{BTreeMap, BTreeSet};

/// Rings of faces about what crosses that are cut out with it, at most (structural: a cap on work).
const MOST_RINGS: usize = 6;

/// Cuts crossing faces out with their surroundings and caps the holes, until nothing crosses or more of
/// it does not help. Returns how many pairs still cross. The mesh stays closed and consistently oriented.
pub fn mend(mesh: &mut Mesh) -> usize {
    let mut found = crossings(mesh);
    for rings in 1..=MOST_RINGS {
        // What a cap made cross may go at the second try.
        for _ in 0..2 {
            let Some((mended, left)) = without(mesh, &found, rings) else {
                break;
            };
            (*mesh, found) = (mended, left);
        }
    }
    found.len()
}

/// The mesh without the faces that cross and so many rings about them, and what crosses in it; [`None`]
/// where that is no less.
fn without(mesh: &Mesh, found: &[(u32, u32)], rings: usize) -> Option<(Mesh, Vec<(u32, u32)>)> {
    if found.is_empty() {
        return None;
    }
    let around = Adjacency::new(mesh);
    let faces: BTreeSet<u32> = found.iter().flat_map(|(f, g)| [*f, *g]).collect();
    let wider = (0..rings).fold(faces, |faces, _| grown(mesh, &around, &faces));
    let mended = capped(mesh, wider);
    if mended.faces.is_empty() || mended.validate_closed().is_err() {
        return None;
    }
    let left = crossings(&mended);
    (left.len() < found.len()).then_some((mended, left))
}

/// The mesh without some faces, every hole capped. Of each part of the mesh the largest piece is kept.
pub(crate) fn capped(mesh: &Mesh, mut gone: BTreeSet<u32>) -> Mesh {
    let around = Adjacency::new(mesh);
    without_pinches(mesh, &around, &mut gone);
    let mut kept: Vec<[u32; 3]> = largest_pieces(mesh, &gone);
    let mut positions = mesh.positions.clone();
    for hole in holes(&kept) {
        cap(&mut positions, &mut kept, &hole, mesh.mean_edge());
    }
    Mesh {
        unit: mesh.unit,
        ..Mesh::packed(&positions, &kept)
    }
}

/// Faces and all that share a vertex with them.
fn grown(mesh: &Mesh, around: &Adjacency, faces: &BTreeSet<u32>) -> BTreeSet<u32> {
    let corners = faces.iter().flat_map(|f| mesh.faces[*f as usize]);
    corners.flat_map(|v| around.faces(v).to_vec()).collect()
}

/// Removes more faces until no vertex is left at which two holes meet.
fn without_pinches(mesh: &Mesh, around: &Adjacency, gone: &mut BTreeSet<u32>) {
    loop {
        let corners: BTreeSet<u32> = gone.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
        let before = gone.len();
        for v in corners {
            let stay: Vec<_> = around
                .faces(v)
                .iter()
                .filter(|f| !gone.contains(f))
                .map(|f| mesh.faces[*f as usize])
                .collect();
            // Edges out of v that no face which stays comes back along.
            let open = stay.iter().filter(|face| {
                let i = (0..3).find(|i| face[*i] == v).unwrap_or(0);
                let to = face[(i + 1) % 3];
                !stay
                    .iter()
                    .any(|g| (0..3).any(|j| g[j] == to && g[(j + 1) % 3] == v))
            });
            if open.count() > 1 {
                gone.extend(around.faces(v));
            }
        }
        if gone.len() == before {
            return;
        }
    }
}

/// The faces that stay, of each part of the mesh only the largest piece.
fn largest_pieces(mesh: &Mesh, gone: &BTreeSet<u32>) -> Vec<[u32; 3]> {
    let parts = mesh.pieces(|_| true);
    let left = mesh.pieces(|f| !gone.contains(&f));
    let mut size: BTreeMap<u32, usize> = BTreeMap::new();
    for piece in left.iter().flatten() {
        *size.entry(*piece).or_default() += 1;
    }
    let mut best: BTreeMap<u32, (usize, u32)> = BTreeMap::new();
    for (part, piece) in parts.iter().zip(&left) {
        let (Some(part), Some(piece)) = (part, piece) else {
            continue;
        };
        let one = (size[piece], *piece);
        let most = best.entry(*part).or_insert(one);
        if one.0 > most.0 {
            *most = one;
        }
    }
    let kept: BTreeSet<u32> = best.values().map(|(_, piece)| *piece).collect();
    let faces = mesh.faces.iter().zip(&left);
    faces
        .filter(|(_, piece)| piece.is_some_and(|p| kept.contains(&p)))
        .map(|(face, _)| *face)
        .collect()
}

/// Loops of vertices around the holes, in the order in which a cap's edges run.
fn holes(faces: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let edges: BTreeSet<(u32, u32)> = faces
        .iter()
        .flat_map(|f| (0..3).map(move |i| (f[i], f[(i + 1) % 3])))
        .collect();
    let open = edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a)));
    let mut next: BTreeMap<u32, u32> = open.map(|(a, b)| (*b, *a)).collect();
    let mut loops = vec![];
    while let Some((first, mut v)) = next.pop_first() {
        let mut hole = vec![first];
        while v != first {
            hole.push(v);
            let Some(to) = next.remove(&v) else { break };
            v = to;
        }
        loops.push(hole);
    }
    loops
}

/// Closes a hole: rings of vertices towards its middle, about an edge apart.
fn cap(positions: &mut Vec<[f32; 3]>, faces: &mut Vec<[u32; 3]>, hole: &[u32], edge: f64) {
    let count = hole.len();
    let rim: Vec<[f32; 3]> = hole.iter().map(|v| positions[*v as usize]).collect();
    let middle = [0, 1, 2].map(|i| rim.iter().map(|p| p[i]).sum::<f32>() / count as f32);
    let far = |p: &[f32; 3]| {
        (0..3)
            .map(|i| (p[i] - middle[i]).powi(2))
            .sum::<f32>()
            .sqrt()
    };
    let radius = f64::from(rim.iter().map(far).sum::<f32>()) / count as f64;
    let layers = (radius / edge.max(1e-9)).round().clamp(1.0, 20.0) as usize;
    let mut outer = hole.to_vec();
    for layer in 1..layers {
        let share = layer as f32 / layers as f32;
        let first = positions.len() as u32;
        positions.extend(rim.iter().map(|p| {
            let at = |i: usize| p[i] + (middle[i] - p[i]) * share;
            [at(0), at(1), at(2)]
        }));
        let inner: Vec<u32> = (first..first + count as u32).collect();
        for i in 0..count {
            let j = (i + 1) % count;
            faces.push([outer[i], outer[j], inner[i]]);
            faces.push([inner[i], outer[j], inner[j]]);
        }
        outer = inner;
    }
    let top = positions.len() as u32;
    positions.push(middle);
    faces.extend((0..count).map(|i| [outer[i], outer[(i + 1) % count], top]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn what_passes_through_itself_is_cut_out_and_closed() {
        let mut dice = proof::Dice(9);
        for _ in 0..10 {
            let mut mesh = sphere(10.0, 4);
            // A spike that comes out on the other side.
            let spike = dice.bits() as usize % mesh.positions.len();
            mesh.positions[spike] = mesh.positions[spike].map(|x| -1.4 * x);
            assert!(!crossings(&mesh).is_empty());
            assert_eq!(mend(&mut mesh), 0);
            assert_eq!(crossings(&mesh), vec![]);
            assert_eq!(mesh.validate_closed(), Ok(()));
            let ball = 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
            assert!(mesh.volume() > 0.8 * ball, "{} of {ball}", mesh.volume());
        }
    }

    #[test]
    fn two_fingers_that_grew_into_each_other_part_or_join_closed() {
        let mut mesh = sphere(10.0, 4);
        let mut other = sphere(10.0, 4);
        other.positions.iter_mut().for_each(|p| p[0] += 18.0);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(&other.positions);
        let faces = other.faces.iter().map(|f| f.map(|v| v + first));
        mesh.faces.extend(faces);
        assert!(!crossings(&mesh).is_empty());
        assert_eq!(mend(&mut mesh), 0);
        assert_eq!(mesh.validate_closed(), Ok(()));
        let both = 2.0 * 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
        assert!(mesh.volume() > 0.9 * both, "{} of {both}", mesh.volume());
    }

    #[test]
    fn a_mesh_that_does_not_cross_keeps_its_bytes() {
        let (mut mesh, same) = (sphere(10.0, 3), sphere(10.0, 3));
        assert_eq!(mend(&mut mesh), 0);
        assert_eq!(mesh.positions, same.positions);
        assert_eq!(mesh.faces, same.faces);
    }
}
