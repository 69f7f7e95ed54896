//! What grew and what shrank: distances to a body in the same pose, volumes by part.

use crate::closest::Closest;
use crate::rigid::Target;
use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Mesh, Part};
use std::collections::BTreeMap;

/// How far the other surface is outside of each vertex of one in the same pose; negative inside. \[mm\]
pub fn growth(posed: &Mesh, other: &Target<'_>) -> Vec<f64> {
    let at = |v: u32| -other.tree().signed(&posed.point(v)).unwrap_or(0.0);
    (0..posed.positions.len() as u32)
        .into_par_iter()
        .map(at)
        .collect()
}

/// The part of each vertex of a mesh: that of the nearest face's first corner on a labelled one in the same pose.
pub fn labels_like(mesh: &Mesh, posed: &Mesh, parts: &[Part]) -> Vec<Part> {
    let tree = Closest::new(posed);
    let at = |v: u32| {
        let hit = tree.to(&mesh.point(v)).expect("bug: a mesh without faces");
        parts[posed.faces[hit.face][0] as usize]
    };
    (0..mesh.positions.len() as u32)
        .into_par_iter()
        .map(at)
        .collect()
}

/// The volume of each part, in the order in which parts are named: each is closed by fans over the edges that it shares with
/// another part, and both take the same fan, so that their sum is the volume of the closed mesh. A face belongs to the part
/// that two of its corners have, else to its first one's. \[mm³\]
pub fn volumes(mesh: &Mesh, of: &[Part], wanted: &[Part]) -> Vec<f64> {
    let label = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| of[v as usize]);
        if b == c { b } else { a }
    };
    let labels: Vec<Part> = mesh.faces.iter().map(label).collect();
    let tetrahedron = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| a.dot(&b.cross(&c)) / 6.0;
    let mut sums: BTreeMap<u8, f64> = BTreeMap::new();
    let mut sides: BTreeMap<(u32, u32), Part> = BTreeMap::new();
    for (f, part) in labels.iter().enumerate() {
        let [a, b, c] = mesh.triangle(f).map(|p| p.coords);
        *sums.entry(*part as u8).or_default() += tetrahedron(a, b, c);
        let [a, b, c] = mesh.faces[f];
        [(a, b), (b, c), (c, a)].into_iter().for_each(|edge| {
            sides.insert(edge, *part);
        });
    }
    // Edges between two parts, once each, as they run in the part of the lesser number.
    let mut borders: BTreeMap<(u8, u8), Vec<(u32, u32)>> = BTreeMap::new();
    for ((a, b), part) in &sides {
        let Some(other) = sides.get(&(*b, *a)) else {
            continue;
        };
        if (*part as u8) < *other as u8 {
            borders
                .entry((*part as u8, *other as u8))
                .or_default()
                .push((*a, *b));
        }
    }
    for ((low, high), edges) in borders {
        let ends = edges.iter().map(|(a, _)| mesh.point(*a).coords);
        let middle = ends.sum::<Vector3<f64>>() / edges.len() as f64;
        for (a, b) in edges {
            let cap = tetrahedron(mesh.point(b).coords, mesh.point(a).coords, middle);
            *sums.entry(low).or_default() += cap;
            *sums.entry(high).or_default() -= cap;
        }
    }
    wanted
        .iter()
        .map(|p| sums.get(&(*p as u8)).copied().unwrap_or(0.0))
        .collect()
}
