//! Cuts off what hangs on a thin neck: shards of the hull that no photo takes away shrink to balls on
//! stalks, and bridges between limbs to threads.

use crate::mend::repair::capped;
use shape::{Adjacency, Mesh};
use std::collections::BTreeSet;

/// A lobe is as large, against the square of its neck's girth, as nothing that only bulges. By hand: looked at half a
/// ball, 0.16, and a finger, 1.3.
const LOBE_SHARE: f64 = 0.6;

/// Finds necks of at most `edges` edges, with a lobe on either side, cuts them out and caps the holes; of
/// each part the largest piece stays. Returns how many vertices belonged to necks.
///
/// Where both sides of the neck are one, it was a bridge, and its ends are capped.
pub fn pinch(mesh: &mut Mesh, edges: usize) -> usize {
    let mut cut = 0;
    // A cap may leave a shorter neck beneath it.
    for _ in 0..3 {
        match once(mesh, edges) {
            0 => break,
            some => cut += some,
        }
    }
    cut
}

/// As [`pinch`], once.
fn once(mesh: &mut Mesh, edges: usize) -> usize {
    let around = Adjacency::new(mesh);
    let narrow = narrow(mesh, &around);
    let mut neck = BTreeSet::new();
    for v in (0..mesh.positions.len() as u32).filter(|v| narrow[*v as usize]) {
        if !neck.contains(&v) {
            let mut path = vec![v];
            search(mesh, &around, &narrow, edges, &mut path, &mut neck);
        }
    }
    if neck.is_empty() {
        return 0;
    }
    let faces: BTreeSet<u32> = neck
        .iter()
        .flat_map(|v| around.faces(*v).to_vec())
        .collect();
    let cut = capped(mesh, faces);
    if cut.faces.is_empty() || cut.validate_closed().is_err() {
        return 0;
    }
    *mesh = cut;
    neck.len()
}

/// Whether the surface turns round within two rings of a vertex.
fn narrow(mesh: &Mesh, around: &Adjacency) -> Vec<bool> {
    let normals = mesh.normals();
    let one = |v: u32| {
        let turned = |j: &u32| normals[*j as usize].dot(&normals[v as usize]) < -0.3;
        let ring = around.vertices(v);
        ring.iter().any(|i| around.vertices(*i).iter().any(turned))
    };
    (0..mesh.positions.len() as u32).map(one).collect()
}

/// The face on the left of a directed edge.
fn beside(mesh: &Mesh, around: &Adjacency, (a, b): (u32, u32)) -> Option<u32> {
    let runs = |f: &&u32| {
        let c = mesh.faces[**f as usize];
        (0..3).any(|i| c[i] == a && c[(i + 1) % 3] == b)
    };
    around.faces(a).iter().find(runs).copied()
}

/// Goes on from a path over narrow vertices; closed paths without a chord that part two lobes are added
/// to the necks.
fn search(
    mesh: &Mesh,
    around: &Adjacency,
    narrow: &[bool],
    edges: usize,
    path: &mut Vec<u32>,
    neck: &mut BTreeSet<u32>,
) {
    let (first, last) = (path[0], path[path.len() - 1]);
    for next in around.vertices(last).iter().copied() {
        if !narrow[next as usize] || path.contains(&next) {
            continue;
        }
        let touched: Vec<usize> = (0..path.len() - 1)
            .filter(|i| around.vertices(next).binary_search(&path[*i]).is_ok())
            .collect();
        match touched.as_slice() {
            [] if path.len() + 1 < edges => {
                path.push(next);
                search(mesh, around, narrow, edges, path, neck);
                path.pop();
            }
            [0] if path.len() >= 2 && path[1] < next => {
                path.push(next);
                if parts_two_lobes(mesh, around, path) {
                    neck.extend(path.iter().copied());
                }
                path.pop();
            }
            _ => {}
        }
        if neck.contains(&first) {
            return;
        }
    }
}

/// Whether a closed path has a lobe on its left and one on its right, or all the same surface.
fn parts_two_lobes(mesh: &Mesh, around: &Adjacency, path: &[u32]) -> bool {
    let count = path.len();
    let steps: Vec<(u32, u32)> = (0..count)
        .map(|i| (path[i], path[(i + 1) % count]))
        .collect();
    let girth: f64 = steps
        .iter()
        .map(|(a, b)| (mesh.point(*a) - mesh.point(*b)).norm())
        .sum();
    let wanted = LOBE_SHARE * girth * girth;
    let large = |left: bool| {
        let starts = steps
            .iter()
            .map(|(a, b)| if left { (*a, *b) } else { (*b, *a) });
        let mut open: Vec<u32> = starts.filter_map(|s| beside(mesh, around, s)).collect();
        let mut seen: BTreeSet<u32> = open.iter().copied().collect();
        let mut area = 0.0;
        while let Some(f) = open.pop() {
            area += 0.5 * mesh.area_vector(f as usize).norm();
            if area > wanted {
                return true;
            }
            let c = mesh.faces[f as usize];
            for (a, b) in [(c[0], c[1]), (c[1], c[2]), (c[2], c[0])] {
                if steps.contains(&(a, b)) || steps.contains(&(b, a)) {
                    continue;
                }
                let Some(g) = beside(mesh, around, (b, a)) else {
                    continue;
                };
                if seen.insert(g) {
                    open.push(g);
                }
            }
        }
        false
    };
    large(true) && large(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    /// A ball with a lobe drawn out of it, on a neck, by bending space along x.
    fn with_a_lobe(neck: f64) -> Mesh {
        let mut mesh = sphere(10.0, 5);
        for p in &mut mesh.positions {
            let x = f64::from(p[0]);
            // Radius over length: the ball up to 9, a neck, a lobe of 2 mm.
            if x > 9.0 {
                let t = (x - 9.0) / 1.0;
                let r = f64::from(libm::hypotf(p[1], p[2])).max(1e-9);
                let along = 9.0 + 14.0 * t;
                let lobe = (t - 0.6) / 0.4;
                let wanted = if t < 0.6 {
                    neck + (4.36 - neck) * (1.0 - t / 0.6).powi(4)
                } else {
                    neck.max(2.0 * (1.0 - (2.0 * lobe - 1.0).powi(2)).max(0.0).sqrt())
                        * (1.0 - lobe.powi(8))
                };
                let scale = wanted / r;
                *p = [
                    along as f32,
                    (f64::from(p[1]) * scale) as f32,
                    (f64::from(p[2]) * scale) as f32,
                ];
            }
        }
        crate::geometry::remesh::remesh(&mesh, 0.6, 4)
    }

    fn reach(mesh: &Mesh) -> f32 {
        mesh.positions.iter().map(|p| p[0]).fold(0.0, f32::max)
    }

    #[test]
    fn a_lobe_on_a_thin_neck_is_cut_off_and_the_rest_closed() {
        let mut mesh = with_a_lobe(0.3);
        assert!(reach(&mesh) > 20.0, "{}", reach(&mesh));
        assert!(pinch(&mut mesh, 6) > 0);
        assert_eq!(mesh.validate_closed(), Ok(()));
        assert!(reach(&mesh) < 18.0, "{}", reach(&mesh));
        let ball = 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
        assert!(
            (mesh.volume() / ball - 1.0).abs() < 0.03,
            "{}",
            mesh.volume() / ball
        );
    }

    #[test]
    fn a_finger_as_thick_as_its_tip_stays() {
        let mut mesh = with_a_lobe(2.0);
        let same = mesh.clone();
        assert_eq!(pinch(&mut mesh, 6), 0);
        assert_eq!(mesh.positions, same.positions);
    }

    #[test]
    fn a_ball_stays_as_it_is() {
        let mut mesh = sphere(10.0, 4);
        assert_eq!(pinch(&mut mesh, 6), 0);
    }
}
