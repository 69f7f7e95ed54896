//! A triangle mesh as flat arrays, and who is whose neighbour.

use crate::Unit;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// A triangle mesh, counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertices in the world; thousandths of the camera ring's radius where the unit is relative. \[mm\]
    pub positions: Vec<[f32; 3]>,
    /// Three vertices a face.
    pub faces: Vec<[u32; 3]>,
    /// Red, green, blue of each vertex; empty if unknown.
    pub colors: Vec<[u8; 3]>,
    /// What its lengths mean.
    pub unit: Unit,
}

/// What is wrong with a mesh.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Serialize, Deserialize)]
pub enum MeshFault {
    /// A face names a vertex that is not there.
    #[error("face {0} names a vertex that is not there")]
    Dangling(usize),
    /// A face names a vertex twice.
    #[error("face {0} names a vertex twice")]
    Degenerate(usize),
    /// A coordinate is no finite number.
    #[error("vertex {0} has a coordinate that is no number")]
    NotFinite(usize),
    /// An edge has not exactly one face on each side.
    #[error("the edge between vertices {0} and {1} has not exactly one face on each side")]
    Open(u32, u32),
    /// A vertex whose faces form more than one fan.
    #[error("vertex {0} joins parts that touch in it alone")]
    Pinched(u32),
}

impl Mesh {
    /// A vertex.
    #[inline]
    pub fn point(&self, vertex: u32) -> Point3<f64> {
        let [x, y, z] = self.positions[vertex as usize];
        Point3::new(f64::from(x), f64::from(y), f64::from(z))
    }

    /// A face's corners.
    #[inline]
    pub fn triangle(&self, face: usize) -> [Point3<f64>; 3] {
        self.faces[face].map(|v| self.point(v))
    }

    /// Twice the area times the unit normal of a face. \[mm²\]
    #[inline]
    pub fn area_vector(&self, face: usize) -> Vector3<f64> {
        let [a, b, c] = self.triangle(face);
        (b - a).cross(&(c - a))
    }

    /// Area-weighted unit normals, one a vertex; zero where no face is.
    pub fn normals(&self) -> Vec<Vector3<f64>> {
        let mut normals = vec![Vector3::zeros(); self.positions.len()];
        for (f, face) in self.faces.iter().enumerate() {
            let n = self.area_vector(f);
            face.iter().for_each(|v| normals[*v as usize] += n);
        }
        let unit = |n: &Vector3<f64>| n.try_normalize(0.0).unwrap_or_default();
        normals.iter().map(unit).collect()
    }

    /// As [`normals`](Self::normals), byte for byte, on all cores.
    pub fn normals_among(&self, around: &Adjacency) -> Vec<Vector3<f64>> {
        let normal = |v: u32| {
            let faces = around.faces(v).iter();
            let sum = faces.fold(Vector3::zeros(), |sum, f| {
                sum + self.area_vector(*f as usize)
            });
            sum.try_normalize(0.0).unwrap_or_default()
        };
        let all = (0..self.positions.len() as u32).into_par_iter();
        all.with_min_len(4096).map(normal).collect()
    }

    /// The enclosed volume, positive if faces look outward. \[mm³\]
    pub fn volume(&self) -> f64 {
        let six = |f| {
            let [a, b, c] = self.triangle(f);
            a.coords.dot(&b.coords.cross(&c.coords))
        };
        (0..self.faces.len()).map(six).sum::<f64>() / 6.0
    }

    /// Mean length of the edges. \[mm\]
    pub fn mean_edge(&self) -> f64 {
        let around = |f: usize| {
            let [a, b, c] = self.triangle(f);
            (b - a).norm() + (c - b).norm() + (a - c).norm()
        };
        let total: f64 = (0..self.faces.len()).map(around).sum();
        total / (3 * self.faces.len()).max(1) as f64
    }

    /// Least and greatest corner. [`None`] without vertices.
    pub fn bounds(&self) -> Option<(Point3<f64>, Point3<f64>)> {
        let first = self.positions.first()?;
        let fold = |f: fn(f32, f32) -> f32| {
            let corner = self
                .positions
                .iter()
                .fold(*first, |c, p| [f(c[0], p[0]), f(c[1], p[1]), f(c[2], p[2])]);
            Point3::from(corner.map(f64::from))
        };
        Some((fold(f32::min), fold(f32::max)))
    }

    /// Checks what any mesh must keep to, closed or not.
    ///
    /// # Errors
    ///
    /// A position is not finite, or a face names a vertex that is not there, or one twice.
    pub fn validate(&self) -> Result<(), MeshFault> {
        let wild = |p: &[f32; 3]| p.iter().any(|x| !x.is_finite());
        if let Some(v) = self.positions.iter().position(wild) {
            return Err(MeshFault::NotFinite(v));
        }
        for (f, &[a, b, c]) in self.faces.iter().enumerate() {
            let beyond = |v: &u32| *v as usize >= self.positions.len();
            if [a, b, c].iter().any(beyond) {
                return Err(MeshFault::Dangling(f));
            }
            if a == b || b == c || c == a {
                return Err(MeshFault::Degenerate(f));
            }
        }
        Ok(())
    }

    /// Checks that the mesh is closed, consistently oriented and manifold.
    ///
    /// # Errors
    ///
    /// As [`Mesh::validate`], or an edge does not belong to two faces that run along it in opposite directions.
    pub fn validate_closed(&self) -> Result<(), MeshFault> {
        self.validate()?;
        let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
        let mut half: Vec<(u32, u32)> = self.faces.iter().flat_map(edges).collect();
        half.par_sort_unstable();
        if let Some(w) = half.windows(2).find(|w| w[0] == w[1]) {
            return Err(MeshFault::Open(w[0].0, w[0].1));
        }
        let alone = |(a, b): &&(u32, u32)| half.binary_search(&(*b, *a)).is_err();
        if let Some(&(a, b)) = half.par_iter().with_min_len(4096).find_first(alone) {
            return Err(MeshFault::Open(a, b));
        }
        let around = Adjacency::new(self);
        let pinched = |v: &u32| {
            let (v, faces) = (*v, around.faces(*v));
            let Some(&first) = faces.first() else {
                return false;
            };
            // Walk the fan: from each face over the edge that leaves the vertex to the next.
            let next = |f: u32| {
                let face = self.faces[f as usize];
                let at = face.iter().position(|x| *x == v).expect("bug: adjacency");
                let over = face[(at + 2) % 3];
                faces.iter().copied().find(|g| {
                    let g = self.faces[*g as usize];
                    (0..3).any(|i| g[i] == v && g[(i + 1) % 3] == over)
                })
            };
            let (mut f, mut seen) = (next(first), 1);
            while let Some(g) = f.filter(|g| *g != first && seen <= faces.len()) {
                (f, seen) = (next(g), seen + 1);
            }
            seen != faces.len()
        };
        let all = (0..self.positions.len() as u32).into_par_iter();
        let pinched = all.with_min_len(4096).find_first(pinched);
        pinched.map_or(Ok(()), |v| Err(MeshFault::Pinched(v)))
    }
}

/// Which faces and vertices are around a vertex (compressed rows).
pub struct Adjacency {
    face_starts: Vec<u32>,
    faces: Vec<u32>,
    vertex_starts: Vec<u32>,
    vertices: Vec<u32>,
}

impl Adjacency {
    /// The neighbours in a valid mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let count = mesh.positions.len();
        let corners = mesh.faces.iter().enumerate();
        let by_face = corners.flat_map(|(f, face)| face.map(|v| (v, f as u32)));
        let (face_starts, faces) = rows(count, by_face);
        // Of some vertices one after the other: where each ring ends among theirs, all rings, the last of them.
        let more = |[mut ends, mut rings, mut ring]: [Vec<u32>; 3], v: usize| {
            let here = faces[face_starts[v] as usize..face_starts[v + 1] as usize].iter();
            let corners = here.flat_map(|f| mesh.faces[*f as usize]);
            ring.clear();
            ring.extend(corners.filter(|c| *c as usize != v));
            ring.sort_unstable();
            ring.dedup();
            rings.extend_from_slice(&ring);
            ends.push(rings.len() as u32);
            [ends, rings, ring]
        };
        let all = (0..count).into_par_iter().with_min_len(4096);
        let parts: Vec<[Vec<u32>; 3]> = all.fold(Default::default, more).collect();
        let (mut vertex_starts, mut vertices) = (vec![0], Vec::with_capacity(faces.len()));
        for [ends, rings, _] in parts {
            let before = vertices.len() as u32;
            vertex_starts.extend(ends.iter().map(|end| before + end));
            vertices.extend_from_slice(&rings);
        }
        Adjacency {
            face_starts,
            faces,
            vertex_starts,
            vertices,
        }
    }

    /// The faces at a vertex, ascending.
    #[inline]
    pub fn faces(&self, vertex: u32) -> &[u32] {
        let v = vertex as usize;
        &self.faces[self.face_starts[v] as usize..self.face_starts[v + 1] as usize]
    }

    /// The vertices an edge away, ascending.
    #[inline]
    pub fn vertices(&self, vertex: u32) -> &[u32] {
        let v = vertex as usize;
        &self.vertices[self.vertex_starts[v] as usize..self.vertex_starts[v + 1] as usize]
    }
}

/// Pairs as compressed rows: where each row starts, and the columns, in a row in the order of the pairs.
pub fn rows(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; count + 1];
    pairs
        .clone()
        .for_each(|(row, _)| starts[row as usize + 1] += 1);
    for i in 0..count {
        starts[i + 1] += starts[i];
    }
    let (mut next, mut columns) = (starts.clone(), vec![0; starts[count] as usize]);
    for (row, column) in pairs {
        columns[next[row as usize] as usize] = column;
        next[row as usize] += 1;
    }
    (starts, columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Mesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Mesh {
            positions,
            faces,
            ..Mesh::default()
        }
    }

    #[test]
    fn a_tetrahedron_is_closed_and_a_sixth_of_a_cube() {
        let mesh = tetrahedron();
        assert_eq!(mesh.validate_closed(), Ok(()));
        assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-12);
        assert_eq!(stage::from_bytes::<Mesh>(&stage::to_bytes(&mesh)), Ok(mesh));
    }

    #[test]
    fn holes_flips_and_pinches_are_found() {
        let mut hole = tetrahedron();
        hole.faces.pop();
        assert!(matches!(hole.validate_closed(), Err(MeshFault::Open(..))));
        let mut flip = tetrahedron();
        flip.faces[0].swap(0, 1);
        assert!(matches!(flip.validate_closed(), Err(MeshFault::Open(..))));
        let mut pinch = tetrahedron();
        let moved = |p: &[f32; 3]| [-p[0], -p[1], p[2]];
        let more: Vec<_> = pinch.positions[1..].iter().map(moved).collect();
        pinch.positions.extend(more);
        let shifted = |f: &[u32; 3]| f.map(|v| if v == 0 { 0 } else { v + 3 });
        let more: Vec<_> = pinch.faces.iter().map(shifted).collect();
        pinch.faces.extend(more);
        assert_eq!(pinch.validate_closed(), Err(MeshFault::Pinched(0)));
    }
}
