//! The 256 ways in which a surface may pass a cube (Lorensen and Cline 1987), made from one rule.
//!
//! On each face of the cube the surface's trace runs from where the face's outline, followed
//! counter-clockwise from outside, enters the solid to where it next leaves it. The rule looks at
//! the four corners of a face only, so both cubes of a face agree and the surface is closed; on an
//! ambiguous face it parts the solid's corners. Each cut edge starts one trace and ends one, so
//! traces close to loops; a loop is filled by triangles whose inner edges are not on a face of
//! the cube, or around a vertex within the cube, so that no edge can belong to more than two triangles.

/// Corner `i` of a cube is at x = bit 0, y = bit 1, z = bit 2 of `i`.
///
/// Edge `axis * 4 + j`: along x, y or z, from the corner whose other two bits are those of `j` (structural).
pub const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// Faces, corners counter-clockwise seen from outside (structural).
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// A corner of a triangle: on an edge of the cube, or within the cube (one for each loop).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Edge 0..12.
    Edge(u8),
    /// Mean of the vertices of loop 0..4.
    Middle(u8),
}

/// One way to pass a cube.
#[derive(Debug, Clone, Default)]
pub struct Case {
    /// Edges of each loop.
    pub loops: Vec<Vec<u8>>,
    /// Triangles, counter-clockwise seen from outside of the solid.
    pub triangles: Vec<[Place; 3]>,
}

fn edge_between(a: usize, b: usize) -> u8 {
    let found = EDGES.iter().position(|e| *e == [a.min(b), a.max(b)]);
    found.expect("bug: corners that share no edge") as u8
}

fn share_a_face(a: u8, b: u8) -> bool {
    FACES.iter().any(|face| {
        let on = |e: u8| EDGES[e as usize].iter().all(|corner| face.contains(corner));
        on(a) && on(b)
    })
}

/// All 256 cases; bit `i`: corner `i` is solid.
pub fn cases() -> Vec<Case> {
    (0..256).map(case).collect()
}

fn case(solid: usize) -> Case {
    let is = |corner: usize| solid >> corner & 1 == 1;
    let mut next = [None; 12];
    for face in FACES {
        for i in 0..4 {
            let (before, corner) = (face[(i + 3) % 4], face[i]);
            if is(before) || !is(corner) {
                continue;
            }
            let mut last = i;
            while is(face[(last + 1) % 4]) {
                last += 1;
            }
            let leaves = edge_between(face[last % 4], face[(last + 1) % 4]);
            next[edge_between(before, corner) as usize] = Some(leaves);
        }
    }
    let mut case = Case::default();
    let mut seen = [false; 12];
    for start in 0..12u8 {
        if seen[start as usize] || next[start as usize].is_none() {
            continue;
        }
        let (mut round, mut at) = (vec![], start);
        while !std::mem::replace(&mut seen[at as usize], true) {
            round.push(at);
            at = next[at as usize].expect("bug: a trace that ends nowhere");
        }
        fill(&round, case.loops.len() as u8, &mut case.triangles);
        case.loops.push(round);
    }
    case
}

/// Fills a loop.
fn fill(round: &[u8], number: u8, triangles: &mut Vec<[Place; 3]>) {
    let n = round.len();
    let fits = |apex: usize| (2..n - 1).all(|k| !share_a_face(round[apex], round[(apex + k) % n]));
    if let Some(apex) = (0..n).find(|apex| fits(*apex)) {
        for k in 1..n - 1 {
            let corner = |k: usize| Place::Edge(round[(apex + k) % n]);
            triangles.push([corner(0), corner(k), corner(k + 1)]);
        }
        return;
    }
    for k in 0..n {
        let corner = |k: usize| Place::Edge(round[k % n]);
        triangles.push([Place::Middle(number), corner(k), corner(k + 1)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cut_edge_is_on_one_loop_and_no_other_edge_is() {
        for (solid, case) in cases().iter().enumerate() {
            let mut on: Vec<u8> = case.loops.iter().flatten().copied().collect();
            on.sort_unstable();
            let cut = |e: &u8| {
                EDGES[*e as usize]
                    .iter()
                    .filter(|c| solid >> **c & 1 == 1)
                    .count()
                    == 1
            };
            assert_eq!(on, (0..12).filter(cut).collect::<Vec<u8>>(), "case {solid}");
        }
    }

    #[test]
    fn one_solid_corner_is_cut_off_facing_away_from_it() {
        let case = &cases()[1];
        assert_eq!(case.triangles.len(), 1);
        let mid = |p: Place| {
            let Place::Edge(e) = p else {
                panic!("a vertex within the cube")
            };
            let at = |c: usize| {
                nalgebra::Vector3::new((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2) as f64)
            };
            (at(EDGES[e as usize][0]) + at(EDGES[e as usize][1])) / 2.0
        };
        let [a, b, c] = case.triangles[0].map(mid);
        assert!((b - a).cross(&(c - a)).sum() > 0.0);
    }
}
