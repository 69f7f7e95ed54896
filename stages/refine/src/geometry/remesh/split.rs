//! Splits every long edge in its middle, all at once; a face is cut in two, three or four.

use super::edge::{edges, middle};
use shape::Mesh;

/// Splits edges longer than `most` mm, and what they became, at most so many times.
pub(super) fn split(mesh: &mut Mesh, most: f64, times: usize) {
    // Edges that were there before were short enough, or are gone.
    let mut fresh = 0;
    for _ in 0..times {
        let first = mesh.positions.len() as u32;
        if !once(mesh, most, fresh) {
            break;
        }
        fresh = first;
    }
}

/// Splits the long edges that have an end from `fresh` on. Whether there were any.
fn once(mesh: &mut Mesh, most: f64, fresh: u32) -> bool {
    let mut long: Vec<_> = edges(mesh)
        .filter(|(_, b)| *b >= fresh)
        .filter(|(a, b)| (mesh.point(*a) - mesh.point(*b)).norm() > most)
        .collect();
    if long.is_empty() {
        return false;
    }
    long.sort_unstable();
    let mut end = vec![false; mesh.positions.len()];
    long.iter()
        .for_each(|(a, b)| [a, b].iter().for_each(|v| end[**v as usize] = true));
    let normals = mesh.normals();
    let first = mesh.positions.len() as u32;
    let middles: Vec<_> = long
        .iter()
        .map(|(a, b)| middle(mesh, [*a, *b].map(|v| normals[v as usize]), *a, *b))
        .collect();
    mesh.positions.extend(middles);
    let cut = |a: u32, b: u32| -> Option<u32> {
        if !(end[a as usize] && end[b as usize]) {
            return None;
        }
        let at = long.binary_search(&(a.min(b), a.max(b))).ok()?;
        Some(first + at as u32)
    };
    let mut faces = Vec::with_capacity(mesh.faces.len() * 2);
    for &[a, b, c] in &mesh.faces {
        let cuts = [cut(a, b), cut(b, c), cut(c, a)];
        // Turn the face so that its first edges are the cut ones.
        let turn = match cuts.map(|c| c.is_some()) {
            [true, true, false] | [true, false, false] => 0,
            [false, true, true] | [false, true, false] => 1,
            [true, false, true] | [false, false, true] => 2,
            _ => 0,
        };
        let corner = |i: usize| [a, b, c][(i + turn) % 3];
        let (p, q, r) = (corner(0), corner(1), corner(2));
        match [0, 1, 2].map(|i| cuts[(i + turn) % 3]) {
            [Some(x), Some(y), Some(z)] => {
                faces.extend([[p, x, z], [x, q, y], [z, y, r], [x, y, z]])
            }
            [Some(x), Some(y), None] => {
                faces.push([x, q, y]);
                let along = (mesh.point(x) - mesh.point(r)).norm();
                if along < (mesh.point(p) - mesh.point(y)).norm() {
                    faces.extend([[p, x, r], [x, y, r]]);
                } else {
                    faces.extend([[p, x, y], [p, y, r]]);
                }
            }
            [Some(x), None, None] => faces.extend([[p, x, r], [x, q, r]]),
            _ => faces.push([p, q, r]),
        }
    }
    mesh.faces = faces;
    true
}
