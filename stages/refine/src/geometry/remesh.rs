//! Isotropic remeshing to a target edge (Botsch and Kobbelt 2004): split, collapse, flip, relax.
//! A closed manifold stays one.

mod collapse;
mod edge;
mod flip;
mod order;
mod split;

use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// Remeshes to edges of about `edge_mm`, in so many rounds. Neighbours in
/// space become neighbours in memory. Colours are dropped.
pub fn remesh(mesh: &Mesh, edge_mm: f64, rounds: usize) -> Mesh {
    let mut mesh = Mesh {
        colors: vec![],
        ..mesh.clone()
    };
    let (least, most) = (0.8 * edge_mm, 4.0 / 3.0 * edge_mm);
    for _ in 0..rounds {
        split::split(&mut mesh, most, 6);
        collapse::collapse(&mut mesh, least, most, 12);
        let around = flip::flip(&mut mesh, 3);
        relax(&mut mesh, &around);
    }
    order::ordered(&mesh)
}

/// Moves each vertex within its tangent plane towards the middle of its faces.
pub fn relax(mesh: &mut Mesh, around: &Adjacency) {
    let normals = mesh.normals_among(around);
    let moved: Vec<[f32; 3]> = (0..mesh.positions.len() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .map(|v| {
            let x = mesh.point(v);
            let (mut sum, mut weight) = (Vector3::zeros(), 0.0);
            for f in around.faces(v) {
                let area = mesh.area_vector(*f as usize).norm();
                let [a, b, c] = mesh.triangle(*f as usize);
                sum += (a.coords + b.coords + c.coords) / 3.0 * area;
                weight += area;
            }
            if weight <= 0.0 {
                return mesh.positions[v as usize];
            }
            let (step, n) = (sum / weight - x.coords, normals[v as usize]);
            let to = x + (step - n * step.dot(&n)) * 0.5;
            [to.x as f32, to.y as f32, to.z as f32]
        })
        .collect();
    mesh.positions = moved;
}

#[cfg(test)]
mod tests {
    use super::edge::edges;
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn a_remeshed_sphere_is_closed_even_and_as_large() {
        let ball = sphere(60.0, 4);
        for edge in [2.0, 4.0, 9.0, 20.0] {
            let mesh = remesh(&ball, edge, 4);
            assert_eq!(mesh.validate_closed(), Ok(()), "edge {edge}");
            let lengths = edges(&mesh);
            let lengths: Vec<_> = lengths
                .map(|(a, b)| (mesh.point(a) - mesh.point(b)).norm())
                .collect();
            let off = lengths
                .iter()
                .filter(|l| **l < 0.5 * edge || **l > 1.5 * edge)
                .count();
            assert!(
                off * 50 < lengths.len(),
                "edge {edge}: {off} of {} are off",
                lengths.len()
            );
            let true_volume = 4.0 / 3.0 * std::f64::consts::PI * 60f64.powi(3);
            let facets = 1.0 - (edge / 60.0).powi(2) / 2.0;
            assert!(
                mesh.volume() > true_volume * (facets - 0.01)
                    && mesh.volume() < true_volume * 1.003
            );
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_surface() {
        let ball = sphere(60.0, 6);
        let by = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| remesh(&ball, 3.0, 2))
        };
        let (one, four) = (by(1), by(4));
        assert!(one.faces.len() < ball.faces.len());
        assert_eq!(one, four);
    }

    #[test]
    fn random_bumps_stay_a_closed_manifold() {
        let mut dice = proof::Dice(9);
        for _ in 0..5 {
            let mut ball = sphere(30.0, 3);
            for p in &mut ball.positions {
                let far = dice.within(0.6, 1.4) as f32;
                *p = p.map(|x| x * far);
            }
            let mesh = remesh(&ball, dice.within(1.0, 12.0), 3);
            assert_eq!(mesh.validate_closed(), Ok(()));
        }
    }
}
