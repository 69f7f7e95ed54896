//! Faces that disagree with their neighbours about which side is outside, turned to agree.

use shape::Mesh;

/// An edge, the face it is of, and whether that runs along it from the lesser to the greater vertex.
type Side = (u32, u32, u32, bool);

/// Turns faces so that neighbours run along their common edge in opposite directions; in each part the fewer ones. How
/// many were turned. Where more than two faces meet at an edge nobody is a neighbour.
pub(crate) fn agreed(mesh: &mut Mesh) -> usize {
    let mut sides = sides(mesh);
    sides.sort_unstable();
    let pairs = |w: &[Side]| (w[0].0, w[0].1) == (w[1].0, w[1].1);
    let disagree = sides.windows(2).any(|w| pairs(w) && w[0].3 == w[1].3);
    if !disagree {
        return 0;
    }
    let next = neighbours(mesh.faces.len(), &sides);
    let mut turned: Vec<Option<bool>> = vec![None; mesh.faces.len()];
    let mut count = 0;
    for first in 0..mesh.faces.len() {
        if turned[first].is_some() {
            continue;
        }
        let part = spread(first, &next, &mut turned);
        let other = part.iter().filter(|f| turned[**f] == Some(true)).count();
        let flip = 2 * other <= part.len();
        for f in part {
            if turned[f] == Some(flip) {
                mesh.faces[f].swap(1, 2);
                count += 1;
            }
        }
    }
    count
}

fn sides(mesh: &Mesh) -> Vec<Side> {
    let of = |(f, face): (usize, &[u32; 3])| {
        let [a, b, c] = *face;
        [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b), f as u32, a < b))
    };
    mesh.faces.iter().enumerate().flat_map(of).collect()
}

/// The neighbours of each face over its edges, and whether both run along the edge the same way.
fn neighbours(faces: usize, sides: &[Side]) -> Vec<[Option<(u32, bool)>; 3]> {
    let mut next = vec![[None; 3]; faces];
    let mut put = |f: u32, to: u32, same: bool| {
        let free = next[f as usize].iter_mut().find(|n| n.is_none());
        free.into_iter().for_each(|n| *n = Some((to, same)));
    };
    for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [a, b] = edge {
            put(a.2, b.2, a.3 == b.3);
            put(b.2, a.2, a.3 == b.3);
        }
    }
    next
}

/// Walks a part from one of its faces; which of them look the other way than that one.
fn spread(
    first: usize,
    next: &[[Option<(u32, bool)>; 3]],
    turned: &mut [Option<bool>],
) -> Vec<usize> {
    turned[first] = Some(false);
    let mut part = vec![first];
    let mut at = 0;
    while let Some(&f) = part.get(at) {
        let own = turned[f] == Some(true);
        for (to, same) in next[f].iter().flatten() {
            let to = *to as usize;
            if turned[to].is_none() {
                turned[to] = Some(own != *same);
                part.push(to);
            }
        }
        at += 1;
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_that_look_the_other_way_are_turned_back_whichever_they_are() {
        let (positions, faces) = proof::block([1.0, 2.0, 3.0]);
        let whole = Mesh {
            positions,
            faces,
            ..Mesh::default()
        };
        assert_eq!(agreed(&mut whole.clone()), 0);
        for mask in 1u32..1 << 12 {
            let mut mixed = whole.clone();
            let other = (0..12).filter(|f| mask >> f & 1 == 1);
            other.for_each(|f| mixed.faces[f as usize].swap(1, 2));
            let count = agreed(&mut mixed);
            assert!(count <= 6);
            mixed.validate_closed().unwrap();
            assert!((mixed.volume().abs() - whole.volume().abs()).abs() < 1e-9);
        }
    }
}
