//! The weighted median over a vertex' neighbourhood (paper, eq. 6–7), for pulls and slopes alike.

use crate::geometry::curvature::Laplacian;
use crate::surface::median::{weight, weighted_median};
use crate::surface::step::DataTerm;
use nalgebra::Vector3;
use shape::{Adjacency, Mesh};

/// A vertex and its neighbours up to `rings` edges away, ascending.
pub fn neighbourhood(around: &Adjacency, v: u32, rings: u32) -> Vec<u32> {
    let mut found = vec![v];
    for _ in 0..rings {
        let next: Vec<u32> = found
            .iter()
            .flat_map(|v| around.vertices(*v))
            .copied()
            .collect();
        found.extend(next);
        found.sort_unstable();
        found.dedup();
    }
    found
}

/// The weighted median of `values` around each vertex (eq. 6) with the weights of eq. 7; distances
/// in units of `length` mm and curvatures in its inverse.
pub fn medians(
    mesh: &Mesh,
    around: &Adjacency,
    curvature: &[f64],
    values: &[f64],
    rings: u32,
    (eta, kappa): (f64, f64),
    length: f64,
) -> Vec<f64> {
    use rayon::prelude::*;
    let one = |v: u32| {
        let x = mesh.point(v);
        let mut samples: Vec<(f64, f64)> = neighbourhood(around, v, rings)
            .into_iter()
            .map(|j| {
                let differ = (curvature[v as usize] - curvature[j as usize]).abs();
                (
                    values[j as usize],
                    weight(eta, kappa, (mesh.point(j) - x).norm(), differ, length),
                )
            })
            .collect();
        weighted_median(&mut samples).unwrap_or(values[v as usize])
    };
    (0..values.len() as u32).into_par_iter().map(one).collect()
}

/// Replaces each vertex' wanted displacement by its neighbourhood's weighted median.
pub fn ring_median(
    mesh: &Mesh,
    around: &Adjacency,
    laplacian: &Laplacian,
    normals: &[Vector3<f64>],
    data_term: &mut DataTerm,
    weights: (f64, f64),
    length: f64,
) {
    let curvature = laplacian.mean_curvature(mesh, normals);
    let wanted: Vec<f64> = data_term
        .pull
        .iter()
        .zip(&data_term.stiffness)
        .map(|(p, s)| if *s > 0.0 { p / s } else { 0.0 })
        .collect();
    let medians = medians(mesh, around, &curvature, &wanted, 2, weights, length);
    data_term
        .pull
        .iter_mut()
        .zip(&data_term.stiffness)
        .zip(medians)
        .for_each(|((p, s), m)| *p = m * s);
}
