//! Adjusts lenses, shots and points together: Levenberg–Marquardt with Cauchy's loss, as the bundle
//! adjustment of a turn, but for several lenses, each photo's focus, and some shots at a time.

use crate::adjust::lens::{LENS, LensPrior, lens_values, lens_with};
use crate::walk::model::{Model, Shot};
use crate::walk::normal::{Places, reduce};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, SMatrix, Vector3};
use rayon::prelude::*;

/// What is believed before anything is seen, and how to adjust.
#[derive(Debug, Clone, PartialEq)]
pub struct Terms {
    /// The prior of each lens.
    pub lenses: Vec<LensPrior>,
    /// How far focusing may change a photo's focal length, as a share; standard deviation.
    pub zoom_sigma: f64,
    /// Standard deviation of an observation. \[px\]
    pub sigma_px: f64,
    /// Residuals beyond this many standard deviations lose weight (Cauchy's c).
    pub loss: f64,
    /// Most steps.
    pub steps: usize,
}

/// Which unknowns are adjusted.
pub(crate) struct Free {
    /// The lenses.
    pub(crate) lenses: bool,
    /// The shots; all but the first where there is nothing here.
    pub(crate) shots: Option<Vec<bool>>,
}

/// Weight that holds what nothing tells.
const HELD: f64 = 1e8;
/// A step that lowers the cost by less than this share is the last.
const GAIN: f64 = 1e-6;
/// Cost of a point behind a camera.
const BEHIND: f64 = 1e6;

/// Adjusts all of a model in place and returns the costs, which never rise. The first shot stays,
/// and so does its distance from the farthest.
pub fn adjust_model(model: &mut Model, terms: &Terms) -> Vec<f64> {
    let free = Free {
        lenses: true,
        shots: None,
    };
    adjusted(model, terms, &free)
}

/// Adjusts what is free.
pub(crate) fn adjusted(model: &mut Model, terms: &Terms, free: &Free) -> Vec<f64> {
    let places = places(model, free);
    let mut now = cost(model, terms);
    let (mut costs, mut damping) = (vec![now], 1e-4);
    for _ in 0..terms.steps {
        let (mut matrix, right, reduced) = system(model, terms, &places, damping, free);
        (0..right.len()).for_each(|i| {
            let d = &mut matrix[(i, i)];
            *d = *d * (1.0 + damping) + 1e-12;
        });
        let stepped = matrix.cholesky().map(|c| {
            let step = c.solve(&right);
            moved(model, &places, &step, &reduced.point_steps(&step))
        });
        match stepped.map(|s| (cost(&s, terms), s)) {
            Some((better, stepped)) if better < now => {
                let gain = (now - better) / now.max(f64::MIN_POSITIVE);
                (*model, now) = (stepped, better);
                costs.push(now);
                damping = (damping * 0.2f64).max(1e-12);
                if gain < GAIN {
                    break;
                }
            }
            _ => {
                damping *= 8.0;
                if damping > 1e10 {
                    break;
                }
            }
        }
    }
    costs
}

fn places(model: &Model, free: &Free) -> Places {
    let all: Vec<bool> = (0..model.shots.len()).map(|s| s > 0).collect();
    let shots = free.shots.as_ref().unwrap_or(&all);
    Places::new(&vec![free.lenses; model.lenses.len()], shots)
}

/// The cost that is minimised.
pub(crate) fn cost(model: &Model, terms: &Terms) -> f64 {
    let (cameras, c2) = (model.cameras(), terms.loss * terms.loss);
    let each: Vec<f64> = model
        .spots
        .par_iter()
        .map(|spot| {
            let one = |(s, px): &(usize, [f64; 2])| match Model::off_px(&cameras[*s], &spot.at, *px)
            {
                Some(off) => c2 * libm::log1p((off / terms.sigma_px).powi(2) / c2),
                None => BEHIND,
            };
            spot.observations.iter().map(one).sum()
        })
        .collect();
    let seen: f64 = each.iter().sum();
    let lens = |(lens, prior): (&shape::Intrinsics, &LensPrior)| {
        let off = |(i, v): (usize, f64)| ((v - prior.mean[i]) / prior.sigma[i]).powi(2);
        lens_values(lens)
            .into_iter()
            .enumerate()
            .map(off)
            .sum::<f64>()
    };
    let lenses: f64 = model.lenses.iter().zip(&terms.lenses).map(lens).sum();
    let zoom = |s: &Shot| (s.zoom / terms.zoom_sigma).powi(2);
    seen + lenses + model.shots.iter().map(zoom).sum::<f64>()
}

type Whole = (DMatrix<f64>, DVector<f64>, crate::walk::normal::Reduced);

/// The system with what is believed and what is held.
fn system(model: &Model, terms: &Terms, places: &Places, damping: f64, free: &Free) -> Whole {
    let reduced = reduce(model, places, terms.sigma_px, terms.loss, damping);
    let (mut matrix, mut right) = (reduced.matrix.clone(), reduced.right.clone());
    for ((at, lens), prior) in places.lenses.iter().zip(&model.lenses).zip(&terms.lenses) {
        let Some(at) = *at else { continue };
        for (i, value) in lens_values(lens).into_iter().enumerate() {
            let weight = 1.0 / (prior.sigma[i] * prior.sigma[i]);
            matrix[(at + i, at + i)] += weight;
            right[at + i] -= weight * (value - prior.mean[i]);
        }
    }
    for (at, shot) in places.shots.iter().zip(&model.shots) {
        let Some(at) = *at else { continue };
        let weight = 1.0 / (terms.zoom_sigma * terms.zoom_sigma);
        matrix[(at + 6, at + 6)] += weight;
        right[at + 6] -= weight * shot.zoom;
    }
    if let (None, Some((d, size))) = (&free.shots, scale(model, places)) {
        matrix += &d * d.transpose() * (HELD / (size * size));
    }
    (matrix, right, reduced)
}

/// The step that moves the farthest shot away from the first, and how far it is.
fn scale(model: &Model, places: &Places) -> Option<(DVector<f64>, f64)> {
    let from = model.shots.first()?.pose.centre();
    let far = |s: &usize| (model.shots[*s].pose.centre() - from).norm();
    let last = (1..model.shots.len()).max_by(|a, b| far(a).total_cmp(&far(b)))?;
    let at = places.shots[last]?;
    let size = far(&last).max(1e-9);
    let pose = &model.shots[last].pose;
    let along = pose.rotation * (pose.centre() - from) / size;
    let mut d = DVector::zeros(places.count);
    (0..3).for_each(|i| d[at + 3 + i] = along[i]);
    Some((d, size))
}

/// The model after a step.
fn moved(model: &Model, places: &Places, step: &DVector<f64>, points: &[Vector3<f64>]) -> Model {
    let mut moved = model.clone();
    for (at, lens) in places.lenses.iter().zip(&mut moved.lenses) {
        let Some(at) = *at else { continue };
        let mut values = lens_values(lens);
        (0..LENS).for_each(|i| values[i] += step[at + i]);
        *lens = lens_with(lens, values);
    }
    for (at, shot) in places.shots.iter().zip(&mut moved.shots) {
        let Some(at) = *at else { continue };
        let turn = Vector3::new(step[at], step[at + 1], step[at + 2]);
        shot.pose.rotation = Rotation3::new(turn) * shot.pose.rotation;
        shot.pose.rotation.renormalize();
        shot.pose.translation += Vector3::new(step[at + 3], step[at + 4], step[at + 5]);
        shot.zoom += step[at + 6];
    }
    let steps = moved.spots.iter_mut().zip(points);
    steps.for_each(|(spot, step)| spot.at += step);
    moved
}

/// Standard deviations, from the inverse of the undamped system.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sureness {
    /// Of each shot's centre against the first shot, a coordinate's root mean square.
    pub(crate) centres: Vec<f64>,
    /// Of each lens' focal length. \[px\]
    pub(crate) focals_px: Vec<f64>,
}

/// Those of an adjusted model; none where something is not determined.
pub(crate) fn sureness(model: &Model, terms: &Terms) -> Option<Sureness> {
    let free = Free {
        lenses: true,
        shots: None,
    };
    let places = places(model, &free);
    let (matrix, ..) = system(model, terms, &places, 1e-9, &free);
    let covariance = matrix.cholesky()?.inverse();
    let centre = |(shot, at): (&Shot, &Option<usize>)| {
        let Some(at) = *at else { return 0.0 };
        // centre = -Rᵀ t, with R ← exp(ω) R and t ← t + τ: d centre = Rᵀ ([ω]× t - τ).
        let mut j = SMatrix::<f64, 3, 6>::zeros();
        let cross = shot.pose.translation.cross_matrix();
        j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-cross);
        j.fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&-Matrix3::identity());
        let block = covariance.fixed_view::<6, 6>(at, at).into_owned();
        ((j * block * j.transpose()).trace() / 3.0).max(0.0).sqrt()
    };
    let focal = |at: &Option<usize>| at.map_or(0.0, |at| covariance[(at, at)].max(0.0).sqrt());
    Some(Sureness {
        centres: model.shots.iter().zip(&places.shots).map(centre).collect(),
        focals_px: places.lenses.iter().map(focal).collect(),
    })
}
