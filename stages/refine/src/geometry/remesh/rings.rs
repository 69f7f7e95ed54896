//! Faces and neighbours of each vertex, kept true while edges collapse.

use shape::{Adjacency, Mesh};

/// Ascending rows that change: a row that may grow goes to the end, and leaves its old place empty.
struct Rows {
    /// Where each row begins, and how long it is.
    at: Vec<(u32, u32)>,
    items: Vec<u32>,
}

impl Rows {
    fn new<'a>(rows: impl Iterator<Item = &'a [u32]>) -> Self {
        let (mut at, mut items) = (vec![], vec![]);
        for row in rows {
            at.push((items.len() as u32, row.len() as u32));
            items.extend_from_slice(row);
        }
        Rows { at, items }
    }

    fn row(&self, v: u32) -> &[u32] {
        let (start, count) = self.at[v as usize];
        &self.items[start as usize..][..count as usize]
    }

    /// Takes an item out of a row.
    fn remove(&mut self, v: u32, item: u32) {
        let (start, count) = &mut self.at[v as usize];
        let row = &mut self.items[*start as usize..][..*count as usize];
        if let Ok(i) = row.binary_search(&item) {
            row[i..].rotate_left(1);
            *count -= 1;
        }
    }

    /// Puts an item, once, in place of another one of the row.
    fn replace(&mut self, v: u32, item: u32, by: u32) {
        self.remove(v, item);
        let (start, count) = &mut self.at[v as usize];
        let row = &mut self.items[*start as usize..][..*count as usize + 1];
        if let Err(i) = row[..*count as usize].binary_search(&by) {
            row[*count as usize] = by;
            row[i..].rotate_right(1);
            *count += 1;
        }
    }

    /// Puts two rows, each item once, in place of the first; the second is empty then.
    fn merge(&mut self, a: u32, b: u32) {
        let first = self.items.len();
        for v in [a, b] {
            let (start, count) = self.at[v as usize];
            let row = start as usize..(start + count) as usize;
            self.items.extend_from_within(row);
        }
        self.items[first..].sort_unstable();
        let mut end = first;
        for i in first..self.items.len() {
            if end == first || self.items[end - 1] != self.items[i] {
                self.items[end] = self.items[i];
                end += 1;
            }
        }
        self.items.truncate(end);
        self.at[a as usize] = (first as u32, (end - first) as u32);
        self.at[b as usize] = (0, 0);
    }
}

/// Who is around whom.
pub(super) struct Rings {
    faces: Rows,
    vertices: Rows,
}

impl Rings {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let around = Adjacency::new(mesh);
        let all = 0..mesh.positions.len() as u32;
        Rings {
            faces: Rows::new(all.clone().map(|v| around.faces(v))),
            vertices: Rows::new(all.map(|v| around.vertices(v))),
        }
    }

    /// The faces at a vertex, ascending.
    pub(super) fn faces(&self, v: u32) -> &[u32] {
        self.faces.row(v)
    }

    /// The vertices an edge away, ascending.
    pub(super) fn vertices(&self, v: u32) -> &[u32] {
        self.vertices.row(v)
    }

    /// Names `b` as `a`, its neighbour, in all faces. Those of both name `a` twice then, and are nobody's.
    pub(super) fn join(&mut self, mesh: &mut Mesh, a: u32, b: u32) {
        let (start, count) = self.faces.at[b as usize];
        // From the last: what is taken out moves those behind it.
        for i in (start..start + count).rev() {
            let f = self.faces.items[i as usize];
            let face = mesh.faces[f as usize];
            if face.contains(&a) {
                face.iter().for_each(|v| self.faces.remove(*v, f));
            }
            mesh.faces[f as usize] = face.map(|v| if v == b { a } else { v });
        }
        self.faces.merge(a, b);
        self.vertices.remove(a, b);
        self.vertices.remove(b, a);
        let (start, count) = self.vertices.at[b as usize];
        for i in start..start + count {
            let v = self.vertices.items[i as usize];
            self.vertices.replace(v, b, a);
        }
        self.vertices.merge(a, b);
    }
}
