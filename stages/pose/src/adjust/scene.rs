//! What is adjusted, what was seen of it, what is believed of it, and the cost of all that.

use crate::adjust::damped::cauchy;
use crate::adjust::lens::LensPrior;
use crate::adjust::residual::{Derivatives, derivatives};
use crate::adjust::rim::{OnRim, RimBelief};
use crate::adjust::ring::Ring;
use nalgebra::Point3;
use shape::{Camera, Intrinsics, Pose};

/// Where a camera sees a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointObservation {
    /// The camera, by its place in [`Scene::poses`].
    pub camera: usize,
    /// The point, by its place in [`Scene::points`].
    pub point: usize,
    /// Where. \[px\]
    pub at_px: [f64; 2],
    /// Standard deviation of that. \[px\]
    pub sigma_px: f64,
}

/// All that is adjusted.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The lens that all cameras share.
    pub lens: Intrinsics,
    /// camera_from_world of each camera.
    pub poses: Vec<Pose>,
    /// Where the cameras are bound to a turn about one axis: it; the poses follow from it.
    pub ring: Option<Ring>,
    /// Points in the world. \[mm\]
    pub points: Vec<Point3<f64>>,
    /// Points before this one are known and stay; those from it on are free.
    pub known: usize,
    /// Tags on the disk's rim: known points that follow from what is open of them.
    pub(crate) rim: Option<OnRim>,
}

/// What is believed before anything is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Beliefs {
    /// What is believed of the lens.
    pub lens: LensPrior,
    /// Of a ring: how far it turned from photo to photo.
    pub steps: Option<Steps>,
    /// Of tags on the disk's rim.
    pub(crate) rim: Option<RimBelief>,
}

/// A belief about the turns of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Between each photo and the next. \[rad\]
    pub turns: Vec<f64>,
    /// Standard deviation of each. \[rad\]
    pub sigma: f64,
}

/// How to adjust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Residuals beyond this many standard deviations lose weight (Cauchy's c).
    pub loss: f64,
    /// Most steps.
    pub steps: usize,
    /// A step that lowers the cost by less than this share is the last.
    pub gain: f64,
}

/// Residual of an observation in standard deviations, with derivatives. `None` behind the camera.
pub(crate) fn look(scene: &Scene, observation: &PointObservation) -> Option<Derivatives> {
    let camera = Camera {
        lens: scene.lens,
        pose: scene.poses[observation.camera],
    };
    derivatives(
        &camera,
        &scene.points[observation.point],
        observation.at_px,
        observation.sigma_px,
    )
}

/// The cost that is minimised.
pub fn cost(scene: &Scene, observations: &[PointObservation], beliefs: &Beliefs, loss: f64) -> f64 {
    let c2 = loss * loss;
    let seen: f64 = observations
        .iter()
        .map(|o| cauchy(look(scene, o).map(|d| d.residual.norm_squared()), c2))
        .sum();
    let steps: f64 = match (&scene.ring, &beliefs.steps) {
        (Some(ring), Some(steps)) => ring
            .angles
            .windows(2)
            .zip(&steps.turns)
            .map(|(a, turn)| ((a[1] - a[0] - turn) / steps.sigma).powi(2))
            .sum(),
        _ => 0.0,
    };
    let rim: f64 = match (&scene.rim, &beliefs.rim) {
        (Some(rim), Some(b)) => rim.beliefs(b).map(|(v, s)| (v / s).powi(2)).sum(),
        _ => 0.0,
    };
    seen + beliefs.lens.cost(&scene.lens) + steps + rim
}
