//! Flips edges so that vertices have six neighbours, where the surface does not bend by it.

use super::edge::area;
use shape::{Adjacency, Mesh};
use std::collections::HashSet;

/// Flips edges at most so many times, and gives who is whose neighbour then.
pub(super) fn flip(mesh: &mut Mesh, times: usize) -> Adjacency {
    let mut around = Adjacency::new(mesh);
    let mut near = vec![true; mesh.faces.len()];
    for pass in 0..times {
        let changed = once(mesh, &around, &mut near, pass > 0);
        if changed.is_empty() {
            break;
        }
        around = Adjacency::new(mesh);
        near.fill(false);
        changed.iter().for_each(|v| mark(&around, *v, &mut near));
    }
    around
}

/// Marks the faces with an edge that may be flipped now that a vertex has other neighbours: one end of such an edge is
/// the vertex, or is beside it.
fn mark(around: &Adjacency, v: u32, near: &mut [bool]) {
    let beside = around.vertices(v).iter().chain([&v]);
    let faces = beside.flat_map(|v| around.faces(*v));
    faces.for_each(|f| near[*f as usize] = true);
}

/// Flips edges of the faces in question, none of them next to another. The vertices that have new neighbours.
fn once(mesh: &mut Mesh, around: &Adjacency, near: &mut [bool], some: bool) -> Vec<u32> {
    let mut valence: Vec<i32> = (0..mesh.positions.len() as u32)
        .map(|v| around.vertices(v).len() as i32)
        .collect();
    let mut taken = vec![false; mesh.faces.len()];
    // Asked, never listed: a hash set's order cannot matter.
    let mut fresh: HashSet<(u32, u32)> = HashSet::new();
    let mut changed = vec![];
    for f in 0..mesh.faces.len() {
        if !near[f] {
            continue;
        }
        for i in 0..3 {
            let (a, b, c) = corners(mesh.faces[f], i);
            if a > b || taken[f] {
                continue;
            }
            let other = around.faces(a).iter().map(|g| *g as usize).find(|g| {
                let face = mesh.faces[*g];
                (0..3).any(|k| face[k] == b && face[(k + 1) % 3] == a)
            });
            let Some(g) = other.filter(|g| !taken[*g]) else {
                continue;
            };
            let d = mesh.faces[g]
                .into_iter()
                .find(|v| *v != a && *v != b)
                .expect("bug: a face names a vertex twice");
            let far = |v: u32, change: i32| (valence[v as usize] + change - 6).pow(2);
            let now = far(a, 0) + far(b, 0) + far(c, 0) + far(d, 0);
            let then = far(a, -1) + far(b, -1) + far(c, 1) + far(d, 1);
            let joined = || {
                around.vertices(c).binary_search(&d).is_ok()
                    || fresh.contains(&(c.min(d), c.max(d)))
            };
            if then >= now
                || c == d
                || valence[a as usize] <= 3
                || valence[b as usize] <= 3
                || joined()
            {
                continue;
            }
            let (p, q) = ([c, a, d], [c, d, b]);
            let up = area(mesh, mesh.faces[f]) + area(mesh, mesh.faces[g]);
            let flat = [p, q].iter().all(|t| {
                let n = area(mesh, *t);
                n.dot(&up) > 0.9 * n.norm() * up.norm() && n.norm() > 0.1 * up.norm()
            });
            if !flat {
                continue;
            }
            (mesh.faces[f], mesh.faces[g]) = (p, q);
            // The neighbours' lists are those of before: both faces rest until the next pass.
            (taken[f], taken[g]) = (true, true);
            [(a, -1), (b, -1), (c, 1), (d, 1)]
                .iter()
                .for_each(|(v, k)| valence[*v as usize] += k);
            fresh.insert((c.min(d), c.max(d)));
            changed.extend([a, b, c, d]);
            if some {
                [a, b, c, d].iter().for_each(|v| mark(around, *v, near));
            }
        }
    }
    changed
}

/// The edge `i` of a face and the vertex across.
fn corners(face: [u32; 3], i: usize) -> (u32, u32, u32) {
    (face[i], face[(i + 1) % 3], face[(i + 2) % 3])
}
