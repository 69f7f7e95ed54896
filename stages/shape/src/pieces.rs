//! Connected pieces of a mesh, and a mesh of some of its faces.

use crate::{Mesh, join, root};

impl Mesh {
    /// The connected piece of each face that is wanted, named by its least vertex; [`None`] for the rest.
    /// Faces are connected where they share a vertex.
    pub fn pieces(&self, wanted: impl Fn(u32) -> bool) -> Vec<Option<u32>> {
        let mut parent: Vec<u32> = (0..self.positions.len() as u32).collect();
        let faces = || self.faces.iter().enumerate();
        for (_, [first, rest @ ..]) in faces().filter(|(f, _)| wanted(*f as u32)) {
            rest.iter().for_each(|v| join(&mut parent, *first, *v));
        }
        faces()
            .map(|(f, face)| wanted(f as u32).then(|| root(&mut parent, face[0])))
            .collect()
    }

    /// Of some faces: the vertices that they use, in their order in the mesh, without colours.
    pub fn packed(positions: &[[f32; 3]], faces: &[[u32; 3]]) -> Mesh {
        let mut place = vec![u32::MAX; positions.len()];
        for v in faces.iter().flatten() {
            place[*v as usize] = 0;
        }
        let mut mesh = Mesh::default();
        for (v, to) in place.iter_mut().enumerate().filter(|(_, to)| **to == 0) {
            *to = mesh.positions.len() as u32;
            mesh.positions.push(positions[v]);
        }
        let placed = faces.iter().map(|f| f.map(|v| place[v as usize]));
        mesh.faces = placed.collect();
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_named_by_their_least_vertex_and_packed_alone() {
        let mesh = Mesh {
            positions: (0..9).map(|i| [i as f32, 0.0, 0.0]).collect(),
            faces: vec![[7, 8, 2], [1, 3, 5], [5, 6, 3], [2, 0, 7]],
            ..Mesh::default()
        };
        let all = mesh.pieces(|_| true);
        assert_eq!(all, [Some(0), Some(1), Some(1), Some(0)]);
        let some = mesh.pieces(|f| f != 3);
        assert_eq!(some, [Some(2), Some(1), Some(1), None]);
        let one = Mesh::packed(&mesh.positions, &mesh.faces[1..3]);
        assert_eq!(one.faces, [[0, 1, 2], [2, 3, 1]]);
        let at: Vec<f32> = one.positions.iter().map(|p| p[0]).collect();
        assert_eq!(at, [1.0, 3.0, 5.0, 6.0]);
    }
}
