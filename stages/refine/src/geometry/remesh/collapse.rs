//! Collapses short edges into their middles where the surface stays a manifold and no face turns.

use super::edge::{middle, normal};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// An edge as it is chosen: the bits of its length (one that is not negative is in the order of its bits), its ends.
type Edge = (u64, u32, u32);

/// How many edges are looked at side by side before the shortest of them are chosen (structural: speed alone).
const SIDE_BY_SIDE: usize = 2048;

/// Collapses edges shorter than `least` mm, none of them next to another, where no edge becomes
/// longer than `most`; at most so many times.
pub(super) fn collapse(mesh: &mut Mesh, least: f64, most: f64, times: usize) {
    let count = mesh.positions.len() as u32;
    let all = || (0..count).into_par_iter().with_min_len(4096);
    let mut gone = vec![false; count as usize];
    let mut near = vec![true; count as usize];
    let mut around = Adjacency::new(mesh);
    for _ in 0..times {
        let chosen = chosen(mesh, &around, short(mesh, &around, &near, least), most);
        if chosen.is_empty() {
            break;
        }
        let mut into: Vec<u32> = (0..count).collect();
        let mut new = vec![false; count as usize];
        for (a, b, to) in chosen {
            (mesh.positions[a as usize], mesh.positions[b as usize]) = (to, to);
            (into[b as usize], gone[b as usize]) = (a, true);
            let beside = around.vertices(a).iter().chain(around.vertices(b));
            beside.for_each(|v| new[*v as usize] = true);
        }
        let named = mesh.faces.par_iter();
        let named = named.map(|f| f.map(|v| into[v as usize]));
        let whole = named.filter(|[a, b, c]| a != b && b != c && c != a);
        mesh.faces = whole.collect();
        around = Adjacency::new(mesh);
        // What an edge becomes depends on the vertices around its ends: where none is new, nothing is to be done.
        let beside = |v: u32| around.vertices(v).iter().any(|w| new[*w as usize]);
        near = all().map(|v| new[v as usize] || beside(v)).collect();
    }
    gather(mesh, &gone);
}

/// The edges at some vertices that are shorter than `least` mm.
fn short(mesh: &Mesh, around: &Adjacency, near: &[bool], least: f64) -> Vec<Edge> {
    let length = |a: u32, b: u32| (mesh.point(a) - mesh.point(b)).norm();
    let from = |a: u32| {
        let ring = around.vertices(a).iter().copied();
        let once = ring.filter(move |b| *b > a || !near[*b as usize]);
        let each = once.map(move |b| (length(a, b), a.min(b), a.max(b)));
        each.filter(move |e| e.0 < least)
    };
    let all = (0..near.len() as u32).into_par_iter().with_min_len(4096);
    let some = all.filter(|a| near[*a as usize]).flat_map_iter(from);
    some.map(|(l, a, b)| (l.to_bits(), a, b)).collect()
}

/// Those that collapse, and where to: the shortest first, none of them next to another.
fn chosen(
    mesh: &Mesh,
    around: &Adjacency,
    mut short: Vec<Edge>,
    most: f64,
) -> Vec<(u32, u32, [f32; 3])> {
    // Vertices that stay as they are, for they are beside a chosen edge, or one away.
    let mut resting = vec![false; mesh.positions.len()];
    let mut chosen = vec![];
    while !short.is_empty() {
        // Few of the longer ones are left when the shortest are chosen: they need no order before.
        let some = short.len().min((short.len() / 8).max(SIDE_BY_SIDE));
        if some < short.len() {
            short.select_nth_unstable(some);
        }
        let longer = short.split_off(some);
        short.par_sort_unstable();
        for part in short.chunks(SIDE_BY_SIDE) {
            let rests = |a: u32, b: u32| resting[a as usize] || resting[b as usize];
            // What is around an edge that does not rest is as it was: all may be asked before any is chosen.
            let ends = part.par_iter().with_min_len(64);
            let ends = ends.map(|(_, a, b)| match rests(*a, *b) {
                true => None,
                false => collapsed(mesh, around, most, [*a, *b]),
            });
            let ends: Vec<Option<[f32; 3]>> = ends.collect();
            for ((_, a, b), to) in part.iter().zip(ends) {
                let free = !resting[*a as usize] && !resting[*b as usize];
                let Some(to) = to.filter(|_| free) else {
                    continue;
                };
                chosen.push((*a, *b, to));
                let beside = around.vertices(*a).iter().chain(around.vertices(*b));
                let farther = beside.flat_map(|v| around.vertices(*v));
                farther.for_each(|v| resting[*v as usize] = true);
            }
        }
        let left = longer.into_par_iter();
        let left = left.filter(|(_, a, b)| !(resting[*a as usize] || resting[*b as usize]));
        short = left.collect();
    }
    chosen
}

/// Where an edge collapses to, unless the surface would fold, tear or get too long an edge.
fn collapsed(mesh: &Mesh, around: &Adjacency, most: f64, [a, b]: [u32; 2]) -> Option<[f32; 3]> {
    let opposite = || {
        let of_a = around.vertices(a).iter();
        of_a.filter(|v| around.vertices(b).contains(v))
    };
    let lean = |v: u32| around.vertices(v).len() <= 3;
    if opposite().count() != 2 || opposite().any(|v| lean(*v)) || (lean(a) && lean(b)) {
        return None;
    }
    let normals = [a, b].map(|v| normal(mesh, around.faces(v)));
    let to = middle(mesh, normals, a, b);
    let there = Point3::from(to.map(f64::from));
    let area = |face: [u32; 3], at: &dyn Fn(u32) -> Point3<f64>| -> Vector3<f64> {
        let [p, q, r] = face.map(at);
        (q - p).cross(&(r - p))
    };
    let moved = |v: u32| {
        if v == a || v == b {
            there
        } else {
            mesh.point(v)
        }
    };
    let faces = around.faces(a).iter().chain(around.faces(b));
    let faces = faces.map(|f| mesh.faces[*f as usize]);
    let mut kept = faces.filter(|f| !(f.contains(&a) && f.contains(&b)));
    let whole = kept.all(|f| {
        let (before, after) = (area(f, &|v| mesh.point(v)), area(f, &moved));
        after.dot(&before) > 0.3 * after.norm() * before.norm() && after.norm() > 1e-9
    });
    let mut ring = around.vertices(a).iter().chain(around.vertices(b));
    let long = |v: &u32| (mesh.point(*v) - there).norm() > most && *v != a && *v != b;
    (whole && !ring.any(long)).then_some(to)
}

/// Leaves out the vertices that are gone, which no face names.
fn gather(mesh: &mut Mesh, gone: &[bool]) {
    let mut place = vec![u32::MAX; gone.len()];
    let mut positions = Vec::new();
    for (v, position) in mesh.positions.iter().enumerate().filter(|(v, _)| !gone[*v]) {
        place[v] = positions.len() as u32;
        positions.push(*position);
    }
    let named = mesh.faces.iter().map(|f| f.map(|v| place[v as usize]));
    mesh.faces = named.collect();
    mesh.positions = positions;
}
