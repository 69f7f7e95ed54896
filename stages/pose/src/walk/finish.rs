//! The last adjustments: all points, observations as sure as they turn out to be.

use crate::adjust::bundle::{Fit, adjusted, fit};
use crate::adjust::scene::{PointObservation, Scene, scatter_px};
use crate::walk::grow::Grown;
use crate::walk::rules::Growth;

/// How many rounds (structural: a search's end).
const ROUNDS: usize = 4;

/// An adjusted walk.
pub(crate) struct Finished {
    /// Its shots by photo, rising.
    pub(crate) scene: Scene,
    pub(crate) observations: Vec<PointObservation>,
    pub(crate) fit: Fit,
}

/// Adjusts everything with at most `most` points, observations within what most are within.
pub(crate) fn finished(mut grown: Grown<'_>, rules: &Growth, most: usize) -> Finished {
    let (beliefs, how) = (&rules.beliefs, &rules.how);
    let mut near_px = rules.near_px;
    let (mut scene, mut seen) = grown.with_points(most, rules.sigma_px);
    for _ in 0..ROUNDS {
        adjusted(&mut scene, &seen, beliefs, how, None);
        let sigma_px = scatter_px(&scene, &seen).min(100.0).max(rules.sigma_px);
        near_px = (6.0 * sigma_px).min(near_px);
        grown.adopt(scene, near_px);
        (scene, seen) = grown.with_points(most, sigma_px);
    }
    // The first shot is the one that stays, wherever it comes to be in the list.
    adjusted(&mut scene, &seen, beliefs, how, None);
    sort(&mut scene, &mut seen);
    Finished {
        fit: fit(&scene, &seen, beliefs, how),
        scene,
        observations: seen,
    }
}

/// Puts shots in their photos' order.
fn sort(scene: &mut Scene, seen: &mut [PointObservation]) {
    let mut order: Vec<usize> = (0..scene.shots.len()).collect();
    order.sort_by_key(|s| scene.shots[*s].photo);
    let mut place = vec![0; order.len()];
    (0..).zip(&order).for_each(|(new, old)| place[*old] = new);
    scene.shots.sort_by_key(|s| s.photo);
    seen.iter_mut().for_each(|o| o.camera = place[o.camera]);
    seen.sort_by_key(|o| (o.point, o.camera));
}
