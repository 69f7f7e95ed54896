//! A surface as a coarse graph, and shortest ways over it.
//!
//! Vertices that share a cell of a grid and hang together within it are one node, so that the work
//! hardly grows with the number of faces, and sheets that only come near each other stay apart.

use nalgebra::{Point3, Vector3};
use shape::{Mesh, join, root};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Nodes on a surface and their links.
pub(crate) struct Graph {
    /// Middles of the nodes. \[mm\]
    pub(crate) at: Vec<Point3<f64>>,
    /// The node of each vertex.
    pub(crate) of: Vec<u32>,
    starts: Vec<u32>,
    links: Vec<u32>,
}

/// The grid cell of a point, counted from the lowest corner.
pub(crate) fn cell_of(p: Point3<f64>, low: Point3<f64>, cell: f64) -> [u32; 3] {
    let off = p - low;
    [off.x, off.y, off.z].map(|x| (x / cell).max(0.0) as u32)
}

impl Graph {
    /// Of a mesh, with cells of a size. \[mm\]
    pub(crate) fn new(mesh: &Mesh, cell: f64) -> Graph {
        let count = mesh.positions.len();
        let low = mesh.bounds().map_or(Point3::origin(), |b| b.0);
        let cells: Vec<[u32; 3]> = (0..count as u32)
            .map(|v| cell_of(mesh.point(v), low, cell))
            .collect();
        let mut up: Vec<u32> = (0..count as u32).collect();
        let edges = |f: &[u32; 3]| [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])];
        for (a, b) in mesh.faces.iter().flat_map(edges) {
            if cells[a as usize] == cells[b as usize] {
                join(&mut up, a, b);
            }
        }
        let mut used = vec![false; count];
        mesh.faces
            .iter()
            .flatten()
            .for_each(|v| used[*v as usize] = true);
        let mut of = vec![u32::MAX; count];
        let mut sums: Vec<(Vector3<f64>, f64)> = Vec::new();
        for v in (0..count as u32).filter(|v| used[*v as usize]) {
            let r = root(&mut up, v) as usize;
            if of[r] == u32::MAX {
                of[r] = sums.len() as u32;
                sums.push((Vector3::zeros(), 0.0));
            }
            of[v as usize] = of[r];
            let sum = &mut sums[of[r] as usize];
            *sum = (sum.0 + mesh.point(v).coords, sum.1 + 1.0);
        }
        let at: Vec<Point3<f64>> = sums.iter().map(|(s, n)| Point3::from(s / *n)).collect();
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (a, b) in mesh.faces.iter().flat_map(edges) {
            let (a, b) = (of[a as usize], of[b as usize]);
            if a != b {
                pairs.extend([(a, b), (b, a)]);
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0u32; at.len() + 1];
        pairs.iter().for_each(|p| starts[p.0 as usize + 1] += 1);
        (0..at.len()).for_each(|i| starts[i + 1] += starts[i]);
        Graph {
            at,
            of,
            starts,
            links: pairs.into_iter().map(|p| p.1).collect(),
        }
    }

    /// The neighbours of a node, ascending.
    pub(crate) fn links(&self, node: u32) -> &[u32] {
        let n = node as usize;
        &self.links[self.starts[n] as usize..self.starts[n + 1] as usize]
    }

    /// Length of the shortest way from a node to each (Dijkstra 1959); infinite where none leads. \[mm\]
    pub(crate) fn ways(&self, from: u32) -> Vec<f64> {
        let mut far = vec![f64::INFINITY; self.at.len()];
        let mut open = BinaryHeap::new();
        far[from as usize] = 0.0;
        open.push(Reverse(Step(0.0, from)));
        while let Some(Reverse(Step(way, a))) = open.pop() {
            if way > far[a as usize] {
                continue;
            }
            for b in self.links(a) {
                let next = way + (self.at[*b as usize] - self.at[a as usize]).norm();
                if next < far[*b as usize] {
                    far[*b as usize] = next;
                    open.push(Reverse(Step(next, *b)));
                }
            }
        }
        far
    }

    /// The nodes on the shortest way to one; `far` are ways from where it begins.
    pub(crate) fn line(&self, far: &[f64], to: u32) -> Vec<u32> {
        let mut line = vec![to];
        let next = |here: u32| {
            let before = self.links(here).iter().copied();
            let before = before.filter(|a| far[*a as usize] < far[here as usize]);
            let off = |a: u32| (self.at[a as usize] - self.at[here as usize]).norm();
            let long = |a: &u32| far[*a as usize] + off(*a);
            before.min_by(|a, b| long(a).total_cmp(&long(b)))
        };
        while let Some(before) = next(line[line.len() - 1]) {
            line.push(before);
        }
        line.reverse();
        line
    }
}

/// A way's length and the node it leads to; of equal lengths the lower node is first.
struct Step(f64, u32);

impl Ord for Step {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Step {}
