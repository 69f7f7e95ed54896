//! How sure an adjusted scene is: standard deviations, from the inverse of its undamped normal equations.

use crate::adjust::lens::LENS;
use crate::adjust::normal::Normal;
use crate::adjust::places::Places;
use crate::adjust::residual::SHOT;
use crate::adjust::scene::Scene;
use nalgebra::{DVector, SMatrix, Vector3};

/// Standard deviations; infinite where something is not determined.
pub(crate) struct Sureness {
    /// Of each camera's centre, a coordinate's root mean square.
    pub(crate) centres: Vec<f64>,
    /// Of each lens' unknowns.
    pub(crate) lenses: Vec<[f64; LENS]>,
    /// Of the cameras' mean distance from their middle, as a share of it.
    pub(crate) size: f64,
}

/// Those of a scene that is adjusted.
pub(crate) fn sureness(scene: &Scene, places: &Places, system: Normal) -> Sureness {
    let shots = &scene.shots;
    let Some(covariance) = system.matrix.cholesky().map(|c| c.inverse()) else {
        return Sureness {
            centres: vec![f64::INFINITY; shots.len()],
            lenses: vec![[f64::INFINITY; LENS]; scene.lenses.len()],
            size: f64::INFINITY,
        };
    };
    let by: Vec<_> = (0..shots.len())
        .map(|s| by_unknowns(scene, places, s))
        .collect();
    let centre = |by: &Vec<(usize, Vector3<f64>)>| {
        let one = |(k, by_k): &(usize, Vector3<f64>)| {
            let row = by.iter().map(|(i, by_i)| by_i * covariance[(*i, *k)]);
            row.sum::<Vector3<f64>>().component_mul(by_k)
        };
        let squares = by.iter().map(one).sum::<Vector3<f64>>().sum();
        (squares / 3.0).max(0.0).sqrt()
    };
    let sigma = |at: usize| covariance[(at, at)].max(0.0).sqrt();
    let lens = |at: &Option<usize>| [0, 1, 2, 3, 4].map(|i| at.map_or(0.0, |at| sigma(at + i)));
    let centres: Vec<Vector3<f64>> = shots.iter().map(|s| s.pose.centre().coords).collect();
    let middle = centres.iter().sum::<Vector3<f64>>() / shots.len().max(1) as f64;
    let (mut by_all, mut total) = (DVector::zeros(covariance.nrows()), 0.0);
    for (centre, by) in centres.iter().zip(&by) {
        let out = centre - middle;
        total += out.norm();
        let out = out.try_normalize(1e-12).unwrap_or_default();
        by.iter().for_each(|(i, by)| by_all[*i] += by.dot(&out));
    }
    Sureness {
        centres: by.iter().map(centre).collect(),
        lenses: places.lenses.iter().map(lens).collect(),
        size: by_all.dot(&(&covariance * &by_all)).max(0.0).sqrt() / total.max(1e-12),
    }
}

/// How a camera's centre −Rᵀ t moves by each unknown that moves it. By its pose, R ← exp(ω) R and t ← t + τ:
/// Rᵀ ([−t]× ω − τ).
fn by_unknowns(scene: &Scene, places: &Places, shot: usize) -> Vec<(usize, Vector3<f64>)> {
    let pose = &scene.shots[shot].pose;
    let mut by_shot = SMatrix::<f64, 3, SHOT>::zeros();
    by_shot
        .fixed_columns_mut::<3>(0)
        .copy_from(&-pose.translation.cross_matrix());
    by_shot.fixed_columns_mut::<3>(3).fill_diagonal(-1.0);
    let by_shot = pose.rotation.matrix().transpose() * by_shot;
    let mut all = Vec::new();
    for way in places.ways(scene, shot) {
        let by = way.by(&by_shot);
        all.extend((0..way.count).map(|k| (way.at + k, by.column(k).into_owned())));
    }
    all
}
