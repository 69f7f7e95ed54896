//! Faces of a mesh that pass through each other, and how a step is taken back where they do.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// Pairs of faces that pass through each other without a common vertex, ascending. Faces that only
/// touch, or are in one plane, do not count.
pub fn crossings(mesh: &Mesh) -> Vec<(u32, u32)> {
    let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
    search(mesh, &all)
}

/// The crossings around some faces: of all that come near any of them.
fn search(mesh: &Mesh, around: &[u32]) -> Vec<(u32, u32)> {
    let cell = (2.0 * mesh.mean_edge()).max(1e-6);
    let cells = |f: u32| {
        let (low, high) = bounds(&mesh.triangle(f as usize));
        let [low, high] = [low, high].map(|p| [p.x, p.y, p.z].map(|x| (x / cell).floor() as i32));
        let plane = (low[0]..=high[0]).flat_map(move |x| (low[1]..=high[1]).map(move |y| (x, y)));
        plane.flat_map(move |(x, y)| (low[2]..=high[2]).map(move |z| [x, y, z]))
    };
    let all = around.len() == mesh.faces.len();
    let mut near: Vec<[i32; 3]> = vec![];
    if !all {
        near = around.iter().flat_map(|f| cells(*f)).collect();
        near.sort_unstable();
        near.dedup();
    }
    let mut places: Vec<([i32; 3], u32)> = (0..mesh.faces.len() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .flat_map_iter(|f| {
            let near = &near;
            let wanted = move |c: &[i32; 3]| all || near.binary_search(c).is_ok();
            cells(f).filter(wanted).map(move |c| (c, f))
        })
        .collect();
    places.par_sort_unstable();
    let groups: Vec<_> = places.chunk_by(|a, b| a.0 == b.0).collect();
    let within = |group: &&[([i32; 3], u32)]| -> Vec<(u32, u32)> {
        let corners: Vec<_> = group
            .iter()
            .map(|(_, f)| mesh.triangle(*f as usize))
            .collect();
        let boxes: Vec<_> = corners.iter().map(bounds).collect();
        let mut found = vec![];
        for i in 0..group.len() {
            for j in i + 1..group.len() {
                let apart =
                    |k: usize| boxes[i].0[k] > boxes[j].1[k] || boxes[j].0[k] > boxes[i].1[k];
                if (0..3).any(apart) {
                    continue;
                }
                let (f, g) = (group[i].1, group[j].1);
                let (a, b) = (mesh.faces[f as usize], mesh.faces[g as usize]);
                if a.iter().any(|v| b.contains(v)) {
                    continue;
                }
                if cross(&corners[i], &corners[j]) {
                    found.push((f.min(g), f.max(g)));
                }
            }
        }
        found
    };
    let mut found: Vec<_> = groups.par_iter().flat_map_iter(within).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Least and greatest coordinates.
fn bounds(corners: &[Point3<f64>; 3]) -> (Vector3<f64>, Vector3<f64>) {
    let [a, b, c] = corners.map(|p| p.coords);
    (a.inf(&b).inf(&c), a.sup(&b).sup(&c))
}

/// Whether an edge of one triangle passes through the inside of the other.
fn cross(a: &[Point3<f64>; 3], b: &[Point3<f64>; 3]) -> bool {
    let pierces = |p: &Point3<f64>, q: &Point3<f64>, t: &[Point3<f64>; 3]| -> bool {
        let normal = (t[1] - t[0]).cross(&(t[2] - t[0]));
        let (s, e) = (normal.dot(&(p - t[0])), normal.dot(&(q - t[0])));
        if s * e >= 0.0 {
            return false;
        }
        let x = p + (q - p) * (s / (s - e));
        (0..3).all(|i| {
            let (from, to) = (t[i], t[(i + 1) % 3]);
            normal.dot(&(to - from).cross(&(x - from))) > 0.0
        })
    };
    (0..3).any(|i| pierces(&a[i], &a[(i + 1) % 3], b) || pierces(&b[i], &b[(i + 1) % 3], a))
}

/// Takes vertices back to where they were, `before`, until no two faces cross that did not before:
/// those of crossing faces first, then wider and wider around them. Returns how many were taken back.
pub fn part(mesh: &mut Mesh, before: &[[f32; 3]], around: &Adjacency) -> usize {
    let mut back = vec![false; mesh.positions.len()];
    let mut found = crossings(mesh);
    for _ in 0..10 {
        let mut touched = vertices(mesh, &found);
        // What has been taken back already and still crosses draws its neighbours along.
        let again = touched.iter().filter(|v| back[**v as usize]);
        let ring: Vec<u32> = again.flat_map(|v| around.vertices(*v).to_vec()).collect();
        touched.extend(ring);
        touched.retain(|v| !back[*v as usize]);
        if touched.is_empty() {
            break;
        }
        for v in &touched {
            back[*v as usize] = true;
            mesh.positions[*v as usize] = before[*v as usize];
        }
        found = search(mesh, &faces(&touched, &found, around));
    }
    back.iter().filter(|b| **b).count()
}

/// The vertices of crossing faces, ascending.
fn vertices(mesh: &Mesh, found: &[(u32, u32)]) -> Vec<u32> {
    let faces = found.iter().flat_map(|(f, g)| [*f, *g]);
    let mut all: Vec<u32> = faces.flat_map(|f| mesh.faces[f as usize]).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The faces around vertices that moved, and those that crossed, ascending.
fn faces(moved: &[u32], found: &[(u32, u32)], around: &Adjacency) -> Vec<u32> {
    let beside = moved.iter().flat_map(|v| around.faces(*v).to_vec());
    let mut all: Vec<u32> = beside
        .chain(found.iter().flat_map(|p| [p.0, p.1]))
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Smooths small folds away: vertices of crossing faces move to the middle of their neighbours,
/// round after round, and the folds' surroundings with them. What is left is left.
pub fn unfold(mesh: &mut Mesh) {
    let around = Adjacency::new(mesh);
    let mut found = crossings(mesh);
    for round in 0..30 {
        if found.is_empty() {
            break;
        }
        let mut touched = vertices(mesh, &found);
        for _ in 0..round / 6 {
            let rings = touched.iter().flat_map(|v| around.vertices(*v).to_vec());
            let mut wider: Vec<u32> = rings.collect();
            touched.append(&mut wider);
            touched.sort_unstable();
            touched.dedup();
        }
        let middle = |v: &u32| -> [f32; 3] {
            let ring = around.vertices(*v);
            let all = ring.iter().map(|j| mesh.point(*j).coords);
            let to = all.sum::<Vector3<f64>>() / ring.len().max(1) as f64;
            [to.x as f32, to.y as f32, to.z as f32]
        };
        let moved: Vec<_> = touched.iter().map(middle).collect();
        for (v, to) in touched.iter().zip(moved) {
            mesh.positions[*v as usize] = to;
        }
        found = search(mesh, &faces(&touched, &found, &around));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn the_same_pairs_are_found_as_by_trying_all() {
        let mut dice = proof::Dice(5);
        for _ in 0..20 {
            let mut mesh = sphere(10.0, 2);
            for p in &mut mesh.positions {
                let far = dice.within(0.5, 1.5) as f32;
                *p = p.map(|x| x * far + dice.within(-5.0, 5.0) as f32);
            }
            let count = mesh.faces.len();
            let all = (0..count).flat_map(|f| (f + 1..count).map(move |g| (f, g)));
            let wanted: Vec<_> = all
                .filter(|(f, g)| {
                    let shared = mesh.faces[*f].iter().any(|v| mesh.faces[*g].contains(v));
                    !shared && cross(&mesh.triangle(*f), &mesh.triangle(*g))
                })
                .map(|(f, g)| (f as u32, g as u32))
                .collect();
            assert!(!wanted.is_empty());
            assert_eq!(crossings(&mesh), wanted);
        }
    }

    #[test]
    fn a_fold_is_smoothed_away() {
        let mut mesh = sphere(10.0, 4);
        let mut dice = proof::Dice(2);
        for p in mesh.positions.iter_mut().filter(|p| p[2] > 9.6) {
            *p = p.map(|x| x + dice.within(-0.9, 0.9) as f32);
        }
        assert!(!crossings(&mesh).is_empty());
        unfold(&mut mesh);
        assert_eq!(crossings(&mesh), vec![]);
    }

    #[test]
    fn a_side_pushed_through_the_other_is_taken_back_and_the_rest_stays() {
        let mut mesh = sphere(10.0, 4);
        assert_eq!(crossings(&mesh), vec![]);
        let before = mesh.positions.clone();
        let around = Adjacency::new(&mesh);
        for p in &mut mesh.positions {
            // The top comes out below; a bulge on the right is fine.
            p[2] -= if p[2] > 9.0 { 25.0 } else { 0.0 };
            p[0] += if p[0] > 8.0 { 1.0 } else { 0.0 };
        }
        assert!(!crossings(&mesh).is_empty());
        let back = part(&mut mesh, &before, &around);
        assert_eq!(crossings(&mesh), vec![]);
        assert!(back > 0 && back < mesh.positions.len() / 2, "{back}");
        let right = (0..before.len()).filter(|v| before[*v][0] > 8.0 && before[*v][2] < 6.0);
        for v in right {
            assert!(mesh.positions[v] != before[v]);
        }
    }
}
