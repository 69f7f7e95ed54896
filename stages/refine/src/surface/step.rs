//! One step of all vertices along their normals, by conjugate gradients: the data's pull, the
//! silhouettes' and a bending term's balance.

use crate::geometry::curvature::Laplacian;
use crate::geometry::gradients::conjugate_gradients;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Pulls on each vertex, and how stiff they are: energy `½ stiffness d² − pull d` a vertex.
#[derive(Debug, Clone, Default)]
pub struct DataTerm {
    /// Pull outward. \[1/mm\]
    pub pull: Vec<f64>,
    /// Stiffness, 0 or more. \[1/mm²\]
    pub stiffness: Vec<f64>,
}

/// How curved the surface is, against how curved it is round about: what the bending term straightens.
///
/// Mean curvature (eq. 3) and a plain thin plate both shrink what is round: a cylinder of radius R
/// by 1/R and 1/R³. This bending term's rest shape is the surface's own curvature, averaged over the
/// neighbourhood, so that a cylinder and a sphere of any size rest, and only dents are straightened.
pub struct Rest {
    /// Wanted `n · L x` of each vertex. \[1/mm\]
    pub wanted: Vec<f64>,
}

impl Rest {
    /// Of the surface as it is, averaged `passes` times over the ring.
    pub fn new(
        laplacian: &Laplacian,
        x: &[Vector3<f64>],
        normals: &[Vector3<f64>],
        passes: usize,
    ) -> Self {
        let curvature = laplacian.apply(x);
        let mut wanted: Vec<f64> = curvature
            .iter()
            .zip(normals)
            .map(|(b, n)| b.dot(n))
            .collect();
        for _ in 0..passes {
            let one = |v: usize| {
                let (mut sum, mut area) = (wanted[v] * laplacian.areas[v], laplacian.areas[v]);
                for (j, _) in laplacian.row(v) {
                    sum += wanted[j] * laplacian.areas[j];
                    area += laplacian.areas[j];
                }
                sum / area
            };
            wanted = (0..x.len())
                .into_par_iter()
                .with_min_len(4096)
                .map(one)
                .collect();
        }
        Rest { wanted }
    }

    /// `½ Σ area (n · L x − wanted)²` at positions `x`.
    pub fn energy(
        &self,
        laplacian: &Laplacian,
        x: &[Vector3<f64>],
        normals: &[Vector3<f64>],
    ) -> f64 {
        let curvature = laplacian.apply(x);
        let each = curvature
            .iter()
            .zip(normals)
            .zip(&self.wanted)
            .zip(&laplacian.areas);
        each.map(|(((b, n), w), a)| 0.5 * a * (b.dot(n) - w).powi(2))
            .sum()
    }
}

/// Minimises `Σ (½ stiffness d² − pull d) + ½ bending Σ area (n · L (x + d n) − rest)²` over the
/// displacements `d` along the normals \[mm\]. `bending` in mm².
pub fn displacements(
    data_term: &DataTerm,
    laplacian: &Laplacian,
    x: &[Vector3<f64>],
    normals: &[Vector3<f64>],
    rest: &Rest,
    bending: f64,
    rounds: usize,
) -> Vec<f64> {
    let count = x.len();
    let along = AlongNormals::new(laplacian, normals);
    let strain = |v: usize, curvature: f64| curvature * laplacian.areas[v] * bending;
    let matrix = |d: &[f64]| -> Vec<f64> {
        let strained = along.apply(d, &along.forward, strain);
        along.apply(&strained, &along.back, |v, force| {
            force + data_term.stiffness[v] * d[v]
        })
    };
    let inverse: Vec<f64> = (0..count)
        .into_par_iter()
        .with_min_len(4096)
        .map(|v| {
            let own: f64 = laplacian.row(v).map(|(_, w)| w).sum();
            let beside = |(j, w): (usize, f64)| {
                // area_v w_vj is symmetric, so w_jv = w_vj area_v / area_j.
                let back = w * laplacian.areas[v] / laplacian.areas[j];
                laplacian.areas[j] * back * back
            };
            let rest: f64 = laplacian.row(v).map(beside).sum();
            let curvature = laplacian.areas[v] * own * own + rest;
            let diagonal = data_term.stiffness[v] + bending * curvature;
            if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 }
        })
        .collect();
    let curved = laplacian
        .apply(x)
        .into_iter()
        .zip(normals)
        .zip(&rest.wanted);
    let strained = curved.enumerate();
    let strained = strained.map(|(v, ((b, n), wanted))| strain(v, b.dot(n) - wanted));
    let strained: Vec<f64> = strained.collect();
    let r = along.apply(&strained, &along.back, |v, force| data_term.pull[v] - force);
    conjugate_gradients(matrix, &inverse, r, rounds)
}

/// The Laplacian between displacements along the normals: one number a pair of neighbours in place of a vector's three.
struct AlongNormals<'a> {
    laplacian: &'a Laplacian,
    /// `w_vj n_v·n_j`: how the curvature at a vertex changes as a neighbour moves.
    forward: Vec<f64>,
    /// `w_jv n_v·n_j`, that of the transposed. The pattern is symmetric and `area_v w_vj = area_j w_jv`.
    back: Vec<f64>,
    /// `Σ_j w_vj n_v·n_v`: how it changes as the vertex itself moves, but for the sign.
    own: Vec<f64>,
}

impl<'a> AlongNormals<'a> {
    fn new(laplacian: &'a Laplacian, normals: &[Vector3<f64>]) -> Self {
        let areas = &laplacian.areas;
        let vertices = || (0..normals.len()).into_par_iter().with_min_len(4096);
        let pair = |v: usize| {
            laplacian.row(v).map(move |(j, w)| {
                let forward = w * normals[v].dot(&normals[j]);
                (forward, forward * (areas[v] / areas[j]))
            })
        };
        let (forward, back) = vertices().flat_map_iter(pair).unzip();
        let own = |v: usize| {
            let sum: f64 = laplacian.row(v).map(|(_, w)| w).sum();
            sum * normals[v].norm_squared()
        };
        AlongNormals {
            laplacian,
            forward,
            back,
            own: vertices().map(own).collect(),
        }
    }

    /// `Σ_j pairs_vj d_j − own_v d_v` of each vertex, and what `then` makes of it; each is summed by one thread in order.
    fn apply(&self, d: &[f64], pairs: &[f64], then: impl Fn(usize, f64) -> f64 + Sync) -> Vec<f64> {
        let columns = self.laplacian.columns();
        let one = |v: usize| {
            let row = self.laplacian.places(v);
            let beside = columns[row.clone()].iter().zip(&pairs[row]);
            let sum = beside.fold(-self.own[v] * d[v], |sum, (j, w)| sum + w * d[*j as usize]);
            then(v, sum)
        };
        (0..d.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(one)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_round_rests_and_a_dent_is_straightened() {
        let mut mesh = crate::geometry::solids::sphere(40.0, 4);
        let around = shape::Adjacency::new(&mesh);
        let step = |mesh: &shape::Mesh| -> Vec<f64> {
            let x: Vec<_> = (0..mesh.positions.len() as u32)
                .map(|v| mesh.point(v).coords)
                .collect();
            let (laplacian, normals) = (Laplacian::new(mesh, &around), mesh.normals());
            let rest = Rest::new(&laplacian, &x, &normals, 20);
            let data_term = DataTerm {
                pull: vec![0.0; x.len()],
                stiffness: vec![1e-4; x.len()],
            };
            displacements(&data_term, &laplacian, &x, &normals, &rest, 40.0, 80)
        };
        let drift = step(&mesh);
        let mean = drift.iter().sum::<f64>() / drift.len() as f64;
        assert!(mean.abs() < 0.004, "a sphere of 40 mm drifts by {mean} mm");
        mesh.positions[0] = mesh.positions[0].map(|x| x * 0.98);
        assert!(
            step(&mesh)[0] > 0.5,
            "a dent of 0.8 mm comes out by {}",
            step(&mesh)[0]
        );
    }
}
