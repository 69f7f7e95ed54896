//! Collapses short edges into their middles where the surface stays a manifold and no face turns.

use super::edge::{area, middle};
use shape::{Adjacency, Mesh};

/// Collapses edges shorter than `least` mm, none of them next to another, where no edge becomes
/// longer than `most`. Whether there were any.
pub(super) fn collapse(mesh: &mut Mesh, least: f64, most: f64) -> bool {
    let (around, normals) = (Adjacency::new(mesh), mesh.normals());
    // A length that is not negative is in the order of its bits.
    let length = |a: u32, b: u32| (mesh.point(a) - mesh.point(b)).norm();
    let from = |a: u32| {
        let beyond = around.vertices(a).iter().filter(move |b| **b > a);
        let each = beyond.map(move |b| (length(a, *b), a, *b));
        each.filter(move |e| e.0 < least)
    };
    let all = (0..mesh.positions.len() as u32).flat_map(from);
    let mut short: Vec<(u64, u32, u32)> = all.map(|(l, a, b)| (l.to_bits(), a, b)).collect();
    short.sort_unstable();
    let mut taken = vec![false; mesh.positions.len()];
    let mut into: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    let mut any = false;
    for (_, a, b) in short {
        let ring = || around.vertices(a).iter().chain(around.vertices(b));
        if taken[a as usize] || taken[b as usize] || ring().any(|v| taken[*v as usize]) {
            continue;
        }
        let shared = around
            .vertices(a)
            .iter()
            .filter(|v| around.vertices(b).contains(v))
            .count();
        let lean = |v: u32| around.vertices(v).len() <= 3;
        let opposite = around
            .vertices(a)
            .iter()
            .filter(|v| around.vertices(b).contains(v));
        if shared != 2 || opposite.clone().any(|v| lean(*v)) || (lean(a) && lean(b)) {
            continue;
        }
        let to = middle(mesh, &normals, a, b);
        let old = [mesh.positions[a as usize], mesh.positions[b as usize]];
        let faces: Vec<[u32; 3]> = around
            .faces(a)
            .iter()
            .chain(around.faces(b))
            .map(|f| mesh.faces[*f as usize])
            .filter(|f| !(f.contains(&a) && f.contains(&b)))
            .collect();
        let before: Vec<_> = faces.iter().map(|f| area(mesh, *f)).collect();
        (mesh.positions[a as usize], mesh.positions[b as usize]) = (to, to);
        let whole = faces.iter().zip(before).all(|(f, before)| {
            let after = area(mesh, *f);
            after.dot(&before) > 0.3 * after.norm() * before.norm() && after.norm() > 1e-9
        });
        let long =
            ring().any(|v| (mesh.point(*v) - mesh.point(a)).norm() > most && *v != a && *v != b);
        if !whole || long {
            (mesh.positions[a as usize], mesh.positions[b as usize]) = (old[0], old[1]);
            continue;
        }
        into[b as usize] = a;
        ring().for_each(|v| taken[*v as usize] = true);
        any = true;
    }
    if any {
        gather(mesh, &into);
    }
    any
}

/// Names each vertex by what it went into, and leaves out what nothing names.
fn gather(mesh: &mut Mesh, into: &[u32]) {
    let mut place = vec![u32::MAX; into.len()];
    let mut positions = Vec::new();
    for (v, to) in into.iter().enumerate() {
        if *to == v as u32 {
            place[v] = positions.len() as u32;
            positions.push(mesh.positions[v]);
        }
    }
    let named = mesh
        .faces
        .iter()
        .map(|f| f.map(|v| place[into[v as usize] as usize]));
    mesh.faces = named
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    mesh.positions = positions;
}
