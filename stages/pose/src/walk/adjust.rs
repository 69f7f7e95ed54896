//! Adjusts lenses, shots and points together: Levenberg–Marquardt with Cauchy's loss, as the bundle
//! adjustment of a turn, but for several lenses, each photo's focus, and some shots at a time.

use crate::adjust::damped::{
    FIXED, Problem, System, cauchy, centre_sigma, descend, farthest, pose_moved,
};
use crate::adjust::lens::{LENS, LensPrior, lens_values, lens_with};
use crate::adjust::normal::Normal;
use crate::walk::model::{Model, Shot};
use crate::walk::normal::{Places, reduce};
use nalgebra::DVector;
use rayon::prelude::*;
use shape::Pose;

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

/// A step that lowers the cost by less than this share is the last (structural: a search's end).
const GAIN: f64 = 1e-6;

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
    let walk = Walk {
        places: places(model, free),
        terms,
        whole: free.shots.is_none(),
    };
    descend(&walk, model, terms.steps, GAIN)
}

/// What is believed of a walk, and what of it is adjusted.
struct Walk<'a> {
    places: Places,
    terms: &'a Terms,
    /// All shots are: their size is fixed.
    whole: bool,
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
            let one = |(s, px): &(usize, [f64; 2])| {
                let off = Model::off_px(&cameras[*s], &spot.at, *px);
                cauchy(off.map(|off| (off / terms.sigma_px).powi(2)), c2)
            };
            spot.observations.iter().map(one).sum()
        })
        .collect();
    let seen: f64 = each.iter().sum();
    let lenses = model.lenses.iter().zip(&terms.lenses);
    let lenses: f64 = lenses.map(|(lens, prior)| prior.cost(lens)).sum();
    let zoom = |s: &Shot| (s.zoom / terms.zoom_sigma).powi(2);
    seen + lenses + model.shots.iter().map(zoom).sum::<f64>()
}

impl Problem for Walk<'_> {
    type State = Model;
    type Rest = Normal;

    fn cost(&self, model: &Model) -> f64 {
        cost(model, self.terms)
    }

    fn system(&self, model: &Model, damping: f64) -> System<Normal> {
        let (terms, places) = (self.terms, &self.places);
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
        if let (true, Some((d, size))) = (self.whole, scale(model, places)) {
            matrix += &d * d.transpose() * (FIXED / (size * size));
        }
        System {
            matrix,
            right,
            rest: reduced,
        }
    }

    fn moved(&self, model: &Model, step: &DVector<f64>, reduced: &Normal) -> Model {
        let mut moved = model.clone();
        for (at, lens) in self.places.lenses.iter().zip(&mut moved.lenses) {
            let Some(at) = *at else { continue };
            let mut values = lens_values(lens);
            (0..LENS).for_each(|i| values[i] += step[at + i]);
            *lens = lens_with(lens, values);
        }
        for (at, shot) in self.places.shots.iter().zip(&mut moved.shots) {
            let Some(at) = *at else { continue };
            shot.pose = pose_moved(&shot.pose, &step.as_slice()[at..]);
            shot.zoom += step[at + 6];
        }
        let steps = moved.spots.iter_mut().zip(reduced.point_steps(step));
        steps.for_each(|(spot, step)| spot.at += step);
        moved
    }
}

/// The step that moves the farthest shot away from the first, and how far it is.
fn scale(model: &Model, places: &Places) -> Option<(DVector<f64>, f64)> {
    let poses: Vec<Pose> = model.shots.iter().map(|s| s.pose).collect();
    let (last, along, size) = farthest(&poses)?;
    let at = places.shots[last]?;
    let mut d = DVector::zeros(places.count);
    (0..3).for_each(|i| d[at + 3 + i] = along[i]);
    Some((d, size))
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
    let walk = Walk {
        places: places(model, &free),
        terms,
        whole: true,
    };
    let covariance = walk.system(model, 1e-9).matrix.cholesky()?.inverse();
    let places = &walk.places;
    let centre = |(shot, at): (&Shot, &Option<usize>)| {
        let Some(at) = *at else { return 0.0 };
        centre_sigma(
            &shot.pose,
            &covariance.fixed_view::<6, 6>(at, at).into_owned(),
        )
    };
    let focal = |at: &Option<usize>| at.map_or(0.0, |at| covariance[(at, at)].max(0.0).sqrt());
    Some(Sureness {
        centres: model.shots.iter().zip(&places.shots).map(centre).collect(),
        focals_px: places.lenses.iter().map(focal).collect(),
    })
}
