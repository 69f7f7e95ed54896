//! Bundle adjustment: cameras, one lens and points that explain what was seen (Triggs, McLauchlan,
//! Hartley and Fitzgibbon 1999).
//!
//! Minimises Σ ρ(‖r‖²/σ²) + priors by Levenberg–Marquardt; points are eliminated by the Schur
//! complement, so that the system solved has 5 + 6 · cameras unknowns. ρ is Cauchy's,
//! ρ(s) = c² ln(1 + s/c²), by reweighting.

use crate::adjust::lens::{LENS, lens_values, lens_with};
use crate::adjust::scene::{Beliefs, PointObservation, Scene, Settings, cost, look};
use crate::adjust::system::{System, spread, system};
use nalgebra::{DVector, Vector3};

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
    /// known of sizes, which then are held.
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
    let mut now = cost(scene, observations, beliefs, settings.loss);
    let (mut costs, mut damping) = (vec![now], 1e-4);
    for _ in 0..settings.steps {
        let mut system = system(scene, &by_point, beliefs, settings.loss, damping);
        (0..system.right.len()).for_each(|i| {
            let d = &mut system.matrix[(i, i)];
            *d = *d * (1.0 + damping) + 1e-12;
        });
        let stepped = system.matrix.clone().cholesky().map(|c| {
            let step = c.solve(&system.right);
            moved(scene, &system, &step)
        });
        let next = stepped.map(|s| (cost(&s, observations, beliefs, settings.loss), s));
        match next {
            Some((better, stepped)) if better < now => {
                let gain = (now - better) / now.max(f64::MIN_POSITIVE);
                (*scene, now) = (stepped, better);
                costs.push(now);
                damping = (damping * 0.2f64).max(1e-12);
                if gain < settings.gain {
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
    let spread = spread(scene, &by_point, beliefs, settings.loss);
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

/// The scene after a step of the unknowns, points by back-substitution.
fn moved(scene: &Scene, system: &System, step: &DVector<f64>) -> Scene {
    let mut moved = scene.clone();
    let mut values = lens_values(&scene.lens);
    (0..LENS).for_each(|i| values[i] += step[i]);
    moved.lens = lens_with(&scene.lens, values);
    let whole = match (&system.tangent, &scene.ring) {
        (Some(tangent), Some(ring)) => {
            let ring = ring.moved(&step.as_slice()[LENS..]);
            moved.poses = ring.poses();
            moved.ring = Some(ring);
            &(tangent * step)
        }
        _ => {
            for (c, pose) in moved.poses.iter_mut().enumerate() {
                let at = LENS + 6 * c;
                let turn = Vector3::new(step[at], step[at + 1], step[at + 2]);
                pose.rotation = nalgebra::Rotation3::new(turn) * pose.rotation;
                pose.rotation.renormalize();
                pose.translation += Vector3::new(step[at + 3], step[at + 4], step[at + 5]);
            }
            step
        }
    };
    if let Some(rim) = &scene.rim {
        let rim = rim.moved(&whole.as_slice()[LENS + 6 * scene.poses.len()..]);
        moved.points[rim.first..scene.known].copy_from_slice(&rim.corners());
        moved.rim = Some(rim);
    }
    let steps = system.reduced.point_steps(whole);
    for (point, step) in moved.points[scene.known..].iter_mut().zip(steps) {
        *point += step;
    }
    moved
}
