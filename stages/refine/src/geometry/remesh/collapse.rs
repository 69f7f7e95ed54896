//! Collapses short edges into their middles where the surface stays a manifold and no face turns.

use super::edge::{area, middle, normal};
use super::rings::Rings;
use nalgebra::Vector3;
use shape::Mesh;

/// Collapses edges shorter than `least` mm, none of them next to another, where no edge becomes
/// longer than `most`; at most so many times.
pub(super) fn collapse(mesh: &mut Mesh, least: f64, most: f64, times: usize) {
    let mut rings = Rings::new(mesh);
    let count = mesh.positions.len();
    let mut into: Vec<u32> = (0..count as u32).collect();
    let mut taken = vec![false; count];
    let mut near = vec![true; count];
    let mut before = vec![];
    for _ in 0..times {
        let short = short(mesh, &rings, &near, least);
        let mut all = vec![];
        for (_, a, b) in short {
            if !collapsed(mesh, &rings, &taken, &mut before, most, [a, b]) {
                continue;
            }
            for v in [a, b].iter().flat_map(|v| rings.vertices(*v)) {
                all.push(*v);
                taken[*v as usize] = true;
            }
            rings.join(mesh, a, b);
            into[b as usize] = a;
        }
        if all.is_empty() {
            break;
        }
        // What an edge becomes depends on the vertices around its ends: where none was taken, nothing is to be done.
        all.iter().for_each(|v| taken[*v as usize] = false);
        near.fill(false);
        let beside = all.iter().flat_map(|v| rings.vertices(*v));
        beside.chain(&all).for_each(|v| near[*v as usize] = true);
    }
    gather(mesh, &into);
}

/// The edges at some vertices that are shorter than `least` mm, the shortest first.
fn short(mesh: &Mesh, rings: &Rings, near: &[bool], least: f64) -> Vec<(u64, u32, u32)> {
    let length = |a: u32, b: u32| (mesh.point(a) - mesh.point(b)).norm();
    let from = |a: u32| {
        let ring = rings.vertices(a).iter().copied();
        let once = ring.filter(move |b| *b > a || !near[*b as usize]);
        let each = once.map(move |b| (length(a, b), a.min(b), a.max(b)));
        each.filter(move |e| e.0 < least)
    };
    // A length that is not negative is in the order of its bits.
    let all = (0..near.len() as u32)
        .filter(|a| near[*a as usize])
        .flat_map(from);
    let mut short: Vec<(u64, u32, u32)> = all.map(|(l, a, b)| (l.to_bits(), a, b)).collect();
    short.sort_unstable();
    short
}

/// Moves both ends of an edge to its middle, unless one of the vertices around was taken. Whether it did; `before` is
/// space to work in.
fn collapsed(
    mesh: &mut Mesh,
    rings: &Rings,
    taken: &[bool],
    before: &mut Vec<([u32; 3], Vector3<f64>)>,
    most: f64,
    [a, b]: [u32; 2],
) -> bool {
    let ring = || rings.vertices(a).iter().chain(rings.vertices(b));
    if [a, b].iter().chain(ring()).any(|v| taken[*v as usize]) {
        return false;
    }
    let opposite = || {
        let of_a = rings.vertices(a).iter();
        of_a.filter(|v| rings.vertices(b).contains(v))
    };
    let lean = |v: u32| rings.vertices(v).len() <= 3;
    if opposite().count() != 2 || opposite().any(|v| lean(*v)) || (lean(a) && lean(b)) {
        return false;
    }
    let normals = [a, b].map(|v| normal(mesh, rings.faces(v)));
    let to = middle(mesh, normals, a, b);
    let old = [mesh.positions[a as usize], mesh.positions[b as usize]];
    let faces = rings.faces(a).iter().chain(rings.faces(b));
    let faces = faces.map(|f| mesh.faces[*f as usize]);
    let kept = faces.filter(|f| !(f.contains(&a) && f.contains(&b)));
    before.clear();
    before.extend(kept.map(|f| (f, area(mesh, f))));
    (mesh.positions[a as usize], mesh.positions[b as usize]) = (to, to);
    let whole = before.iter().all(|(f, before)| {
        let after = area(mesh, *f);
        after.dot(before) > 0.3 * after.norm() * before.norm() && after.norm() > 1e-9
    });
    let long = ring().any(|v| (mesh.point(*v) - mesh.point(a)).norm() > most && *v != a && *v != b);
    if !whole || long {
        (mesh.positions[a as usize], mesh.positions[b as usize]) = (old[0], old[1]);
        return false;
    }
    true
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
