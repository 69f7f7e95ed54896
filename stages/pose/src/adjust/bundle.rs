//! Bundle adjustment: cameras, one lens and points that explain what was seen (Triggs, McLauchlan,
//! Hartley and Fitzgibbon 1999).
//!
//! Minimises Σ ρ(‖r‖²/σ²) + priors by Levenberg–Marquardt; points are eliminated by the Schur
//! complement, so that the system solved has 5 + 6 · cameras unknowns. ρ is Cauchy's,
//! ρ(s) = c² ln(1 + s/c²), by reweighting.

use crate::adjust::damped::{Problem, System, descend, pose_moved};
use crate::adjust::lens::{LENS, lens_values, lens_with};
use crate::adjust::scene::{Beliefs, PointObservation, Scene, Settings, cost, look};
use crate::adjust::system::{Rest, spread, system};
use nalgebra::DVector;

/// What came out beside the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root mean square of the residuals, those beyond three times the loss left out. \[px\]
    pub rms_px: f64,
    /// The cost before and after each accepted step; never rises.
    pub costs: Vec<f64>,
    /// Standard deviation of each camera's centre. \[mm\]
    pub sigma_mm: Vec<Option<f64>>,
    /// Standard deviation of the lens' unknowns.
    pub lens_sigma: [f64; LENS],
    /// Standard deviation of the ring's size, as a share of it; next to nothing where nothing is
    /// known of sizes, which then are fixed.
    pub size_sigma: f64,
}

/// Adjusts a scene in place.
pub fn adjust(
    scene: &mut Scene,
    observations: &[PointObservation],
    beliefs: &Beliefs,
    settings: &Settings,
) -> Fit {
    let mut by_point: Vec<Vec<PointObservation>> = vec![Vec::new(); scene.points.len()];
    observations.iter().for_each(|s| by_point[s.point].push(*s));
    let turn = Turn {
        observations,
        by_point,
        beliefs,
        loss: settings.loss,
    };
    let costs = descend(&turn, scene, settings.steps, settings.gain);
    let spread = spread(scene, &turn.by_point, beliefs, settings.loss);
    Fit {
        rms_px: rms(scene, observations, settings.loss),
        costs,
        sigma_mm: spread.centres_mm.into_iter().map(Some).collect(),
        lens_sigma: spread.lens,
        size_sigma: spread.size,
    }
}

fn rms(scene: &Scene, observations: &[PointObservation], loss: f64) -> f64 {
    let near = observations.iter().filter_map(|s| {
        let r2 = look(scene, s)?.residual.norm_squared();
        (r2.sqrt() < 3.0 * loss).then_some(r2 * s.sigma_px * s.sigma_px)
    });
    let near: Vec<f64> = near.collect();
    (near.iter().sum::<f64>() / near.len().max(1) as f64).sqrt()
}

/// What was seen and believed of a scene.
struct Turn<'a> {
    observations: &'a [PointObservation],
    by_point: Vec<Vec<PointObservation>>,
    beliefs: &'a Beliefs,
    loss: f64,
}

impl Problem for Turn<'_> {
    type State = Scene;
    type Rest = Rest;

    fn cost(&self, scene: &Scene) -> f64 {
        cost(scene, self.observations, self.beliefs, self.loss)
    }

    fn system(&self, scene: &Scene, damping: f64) -> System<Rest> {
        system(scene, &self.by_point, self.beliefs, self.loss, damping)
    }

    /// Points by back-substitution.
    fn moved(&self, scene: &Scene, step: &DVector<f64>, rest: &Rest) -> Scene {
        let mut moved = scene.clone();
        let mut values = lens_values(&scene.lens);
        (0..LENS).for_each(|i| values[i] += step[i]);
        moved.lens = lens_with(&scene.lens, values);
        let whole = match (&rest.tangent, &scene.ring) {
            (Some(tangent), Some(ring)) => {
                let ring = ring.moved(&step.as_slice()[LENS..]);
                moved.poses = ring.poses();
                moved.ring = Some(ring);
                &(tangent * step)
            }
            _ => {
                for (c, pose) in moved.poses.iter_mut().enumerate() {
                    *pose = pose_moved(pose, &step.as_slice()[LENS + 6 * c..]);
                }
                step
            }
        };
        if let Some(rim) = &scene.rim {
            let rim = rim.moved(&whole.as_slice()[LENS + 6 * scene.poses.len()..]);
            moved.points[rim.first..scene.known].copy_from_slice(&rim.corners());
            moved.rim = Some(rim);
        }
        let steps = rest.reduced.point_steps(whole);
        for (point, step) in moved.points[scene.known..].iter_mut().zip(steps) {
            *point += step;
        }
        moved
    }
}
