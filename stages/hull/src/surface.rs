//! The surface of a field: marching cubes with shared vertices, closed and manifold.

use crate::cases::{Case, EDGES, Place, cases};
use crate::field::{BRICK, Bricks, Lattice, SIDE};
use nalgebra::Point3;
use rayon::prelude::*;
use shape::Mesh;

/// A vertex before it has a number: the lattice edge or cell it belongs to.
type Name = u64;

/// The surface within one brick.
struct Part {
    /// Sorted by name, none twice. \[mm\]
    vertices: Vec<(Name, [f32; 3])>,
    triangles: Vec<[Name; 3]>,
}

/// The surface where the field crosses zero. Beyond the lattice nothing is solid.
pub fn surface(lattice: &Lattice, bricks: &Bricks) -> Mesh {
    let cases = cases();
    let parts: Vec<Part> = (0..bricks.len())
        .into_par_iter()
        .filter_map(|b| Some(part(lattice, b, bricks[b].as_ref()?, &cases)))
        .collect();
    let all = parts.iter().flat_map(|p| p.vertices.iter().copied());
    let mut vertices: Vec<(Name, [f32; 3])> = all.collect();
    vertices.par_sort_unstable_by_key(|v| v.0);
    vertices.dedup_by_key(|v| v.0);
    let number = |name: &Name| {
        vertices
            .binary_search_by_key(name, |v| v.0)
            .expect("bug: a vertex without a place") as u32
    };
    let faces = parts
        .par_iter()
        .flat_map_iter(|p| p.triangles.iter().map(|f| f.map(|n| number(&n))))
        .collect();
    Mesh {
        positions: vertices.into_iter().map(|v| v.1).collect(),
        faces,
        ..Mesh::default()
    }
}

/// The vertices and triangles of one brick.
fn part(lattice: &Lattice, brick: usize, values: &[f32], cases: &[Case]) -> Part {
    let base = lattice.place(brick).map(|b| b * BRICK);
    let row = (lattice.bricks[0] * BRICK + 1) as u64;
    let slab = row * (lattice.bricks[1] * BRICK + 1) as u64;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for z in 0..BRICK {
        for y in 0..BRICK {
            for x in 0..BRICK {
                let at = (z * SIDE + y) * SIDE + x;
                let corner =
                    |i: usize| values[at + (i & 1) + (i >> 1 & 1) * SIDE + (i >> 2) * SIDE * SIDE];
                let solid = (0..8).fold(0, |s, i| s | usize::from(corner(i) > 0.0) << i);
                let case = &cases[solid];
                if case.triangles.is_empty() {
                    continue;
                }
                let cell = [base[0] + x, base[1] + y, base[2] + z];
                let linear = |c: [usize; 3]| c[0] as u64 + row * c[1] as u64 + slab * c[2] as u64;
                let offset = |c: [usize; 3], i: usize| {
                    [c[0] + (i & 1), c[1] + (i >> 1 & 1), c[2] + (i >> 2)]
                };
                let on_edge = |e: u8| -> (Name, Point3<f64>) {
                    let [a, b] = EDGES[e as usize];
                    let (from, to) = (offset(cell, a), offset(cell, b));
                    let (fa, fb) = (f64::from(corner(a)), f64::from(corner(b)));
                    // Kept off the corners, so that no two vertices fall into one.
                    let t = (fa / (fa - fb)).clamp(0.01, 0.99);
                    let (p, q) = (
                        lattice.corner(from[0], from[1], from[2]),
                        lattice.corner(to[0], to[1], to[2]),
                    );
                    (linear(from) * 4 + u64::from(e) / 4, p + (q - p) * t)
                };
                let within_cell = |l: u8| -> (Name, Point3<f64>) {
                    let ring = &case.loops[l as usize];
                    let sum: nalgebra::Vector3<f64> =
                        ring.iter().map(|e| on_edge(*e).1.coords).sum();
                    let name = (1 << 63) | (linear(cell) * 4 + u64::from(l));
                    (name, Point3::from(sum / ring.len() as f64))
                };
                for triangle in &case.triangles {
                    triangles.push(triangle.map(|place| {
                        let (name, p) = match place {
                            Place::Edge(e) => on_edge(e),
                            Place::Middle(l) => within_cell(l),
                        };
                        vertices.push((name, [p.x as f32, p.y as f32, p.z as f32]));
                        name
                    }));
                }
            }
        }
    }
    vertices.sort_unstable_by_key(|v| v.0);
    vertices.dedup_by_key(|v| v.0);
    // Each is there once of the six times that it was pushed, and there are many bricks.
    vertices.shrink_to_fit();
    triangles.shrink_to_fit();
    Part {
        vertices,
        triangles,
    }
}

/// The part with the most volume, and those of the other parts, largest first. \[mm³\]
pub fn largest(mesh: &Mesh) -> (Mesh, Vec<f64>) {
    let pieces = mesh.pieces(|_| true);
    let mut volumes = std::collections::BTreeMap::new();
    for (f, piece) in pieces.iter().enumerate() {
        let [a, b, c] = mesh.triangle(f);
        let six = a.coords.dot(&b.coords.cross(&c.coords));
        *volumes.entry(*piece).or_insert(0.0) += six / 6.0;
    }
    let mut order: Vec<(Option<u32>, f64)> = volumes.into_iter().collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let Some((keep, _)) = order.first().copied() else {
        return (mesh.clone(), vec![]);
    };
    let own = mesh.faces.iter().zip(&pieces).filter(|(_, p)| **p == keep);
    let faces: Vec<[u32; 3]> = own.map(|(face, _)| *face).collect();
    let kept = Mesh::packed(&mesh.positions, &faces);
    (kept, order[1..].iter().map(|(_, volume)| *volume).collect())
}
