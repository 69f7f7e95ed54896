//! The last adjustments: all points, observations as sure as they turn out to be.

use crate::adjust::residual::MEDIAN_SIGMAS;
use crate::walk::adjust::{Free, Sureness, Terms, adjusted, sureness};
use crate::walk::grow::Grown;
use crate::walk::model::Model;
use crate::walk::points::offs;
use crate::walk::rules::Growth;

/// How many rounds (structural: a search's end).
const ROUNDS: usize = 4;

/// An adjusted walk.
pub(crate) struct Finished {
    /// Shots by photo, rising.
    pub(crate) model: Model,
    /// Standard deviations; none where something is not determined.
    pub(crate) sure: Option<Sureness>,
    /// Root mean square of the residuals, far ones left out. \[px\]
    pub(crate) rms_px: f64,
}

/// Adjusts everything with at most `most` points, observations within what most are within.
pub(crate) fn finished(
    mut grown: Grown<'_>,
    rules: &Growth,
    most: usize,
    steps: usize,
) -> Finished {
    let mut terms = Terms {
        steps,
        ..rules.terms.clone()
    };
    let free = Free {
        lenses: true,
        shots: None,
    };
    let mut near_px = rules.near_px;
    let mut model = grown.with_spots(most).0;
    for _ in 0..ROUNDS {
        adjusted(&mut model, &terms, &free);
        let sigma = sigma_px(&model).max(rules.terms.sigma_px);
        terms.sigma_px = sigma;
        near_px = (6.0 * sigma).min(near_px);
        grown.adopt(model, near_px);
        model = grown.with_spots(most).0;
    }
    let mut order: Vec<usize> = (0..model.shots.len()).collect();
    order.sort_by_key(|s| model.shots[*s].photo);
    // The first shot is the one that stays, wherever it comes to be in the list.
    adjusted(&mut model, &terms, &free);
    let model = sorted(&model, &order);
    let near: Vec<f64> = offs(&model)
        .into_iter()
        .map(|(_, off)| off)
        .filter(|off| *off < 3.0 * terms.loss * terms.sigma_px)
        .collect();
    let rms = near.iter().map(|o| o * o).sum::<f64>() / near.len().max(1) as f64;
    Finished {
        sure: sureness(&model, &terms),
        rms_px: rms.sqrt(),
        model,
    }
}

/// Standard deviation of an observation along one axis, by the median. \[px\]
fn sigma_px(model: &Model) -> f64 {
    let middle = shape::upper_median(offs(model).into_iter().map(|(_, off)| off));
    middle.map_or(1.0, |off| off.min(100.0) / MEDIAN_SIGMAS)
}

/// The model with its shots in another order.
fn sorted(model: &Model, order: &[usize]) -> Model {
    let mut place = vec![0; order.len()];
    order
        .iter()
        .enumerate()
        .for_each(|(new, old)| place[*old] = new);
    let mut sorted = model.clone();
    sorted.shots = order.iter().map(|s| model.shots[*s].clone()).collect();
    for spot in &mut sorted.spots {
        spot.observations
            .iter_mut()
            .for_each(|(s, _)| *s = place[*s]);
        spot.observations.sort_by_key(|(s, _)| *s);
    }
    sorted
}
