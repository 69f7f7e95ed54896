//! What is believed of a scene before anything is seen, as terms of the cost.

use crate::adjust::damped::{FIXED, farthest};
use crate::adjust::lens::{LensPrior, lens_values};
use crate::adjust::places::Places;
use crate::adjust::residual::POSE;
use crate::adjust::rim::RimBelief;
use crate::adjust::scene::Scene;

/// What is believed before anything is seen.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Beliefs {
    /// What is believed of each lens.
    pub lenses: Vec<LensPrior>,
    /// How far focusing may change a photo's focal length, as a share; standard deviation. None where it does not.
    pub zoom_sigma: Option<f64>,
    /// Of a ring: how far it turned from photo to photo.
    pub steps: Option<Steps>,
    /// Of tags on the disk's rim.
    pub(crate) rim: Option<RimBelief>,
}

impl Beliefs {
    /// About a lens that all cameras share, and nothing else.
    pub fn of_lens(prior: LensPrior) -> Beliefs {
        Beliefs {
            lenses: vec![prior],
            ..Beliefs::default()
        }
    }
}

/// A belief about the turns of a ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Between each photo and the next. \[rad\]
    pub turns: Vec<f64>,
    /// Standard deviation of each. \[rad\]
    pub sigma: f64,
}

/// A number that is believed to be zero.
pub(crate) struct Term {
    /// What it is.
    pub(crate) off: f64,
    /// One over its variance.
    pub(crate) weight: f64,
    /// The unknowns that it depends on, and its derivative by each.
    pub(crate) by: Vec<(usize, f64)>,
}

impl Term {
    fn new(off: f64, sigma: f64, by: impl IntoIterator<Item = (usize, f64)>) -> Term {
        Term {
            off,
            weight: 1.0 / (sigma * sigma),
            by: by.into_iter().collect(),
        }
    }
}

/// All that is believed.
pub(crate) fn terms(scene: &Scene, beliefs: &Beliefs, places: &Places) -> Vec<Term> {
    let mut terms = Vec::new();
    for ((lens, prior), at) in scene.lenses.iter().zip(&beliefs.lenses).zip(&places.lenses) {
        for (i, value) in lens_values(lens).into_iter().enumerate() {
            let by = at.map(|at| (at + i, 1.0));
            terms.push(Term::new(value - prior.mean[i], prior.sigma[i], by));
        }
    }
    if let Some(sigma) = beliefs.zoom_sigma {
        let shots = scene.shots.iter().zip(&places.shots);
        terms.extend(shots.map(|(shot, at)| {
            let at = at.zip(places.zoom).map(|(at, zoom)| at + zoom);
            Term::new(shot.zoom, sigma, at.map(|at| (at, 1.0)))
        }));
    }
    if let (Some(ring), Some(steps)) = (&scene.ring, &beliefs.steps) {
        let pairs = ring.angles.windows(2).zip(places.shots.windows(2));
        terms.extend(pairs.zip(&steps.turns).map(|((angles, at), turn)| {
            let by = [(at[0], -1.0), (at[1], 1.0)];
            let by = by.into_iter().filter_map(|(at, by)| Some((at?, by)));
            Term::new(angles[1] - angles[0] - turn, steps.sigma, by)
        }));
    }
    if let (Some(rim), Some(belief)) = (&scene.rim, &beliefs.rim) {
        let open = rim.beliefs(belief).enumerate();
        terms.extend(open.map(|(i, (value, sigma))| {
            Term::new(value, sigma, places.rim.map(|at| (at + i, 1.0)))
        }));
    }
    terms
}

/// What keeps a scene where nobody could see it move: directions of a step that change nothing that is seen. None
/// where points are known, or only a part is adjusted.
pub(crate) fn freedoms(scene: &Scene, places: &Places) -> Vec<Term> {
    let fixed = |size: f64, by: Vec<(usize, f64)>| Term {
        off: 0.0,
        weight: FIXED / (size * size),
        by,
    };
    if scene.known > 0 || places.lenses.iter().all(Option::is_none) {
        return vec![];
    }
    if let (Some(ring), Some(at), [Some(first), ..]) = (&scene.ring, places.ring, &places.shots[..])
    {
        let places = (at..at + POSE).chain([*first]);
        let one = |(by, size)| fixed(size, places.clone().zip::<[f64; 7]>(by).collect());
        return ring.freedoms().into_iter().map(one).collect();
    }
    // The first shot stays, and so does its distance to the farthest.
    let poses: Vec<_> = scene.shots.iter().map(|s| s.pose).collect();
    let far = farthest(&poses).and_then(|(last, along, size)| {
        let at = places.shots[last]? + 3;
        Some(fixed(size, (0..3).map(|i| (at + i, along[i])).collect()))
    });
    far.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::places::tests::{by_all, turned};
    use nalgebra::DMatrix;

    #[test]
    fn no_way_to_turn_the_world_is_left_free() {
        let scene = turned();
        let places = Places::new(&scene, false, None);
        let axis = scene.ring.as_ref().unwrap().axis();
        let mut ways = DMatrix::zeros(places.count, 2);
        (0..3).for_each(|i| ways[(places.ring.unwrap() + i, 0)] = axis[i]);
        let angles = places.shots.iter().flatten();
        angles.for_each(|at| ways[(*at, 1)] = 1.0);
        // Both move cameras alike: fixed is what neither, nor their difference, escapes.
        let moved = by_all(&scene, &places) * &ways;
        assert!((moved.column(0) - moved.column(1)).norm() < 1e-12 * moved.norm());
        let mut fixed = DMatrix::zeros(4, places.count);
        for (row, term) in freedoms(&scene, &places).iter().enumerate() {
            term.by.iter().for_each(|(i, by)| fixed[(row, *i)] = *by);
        }
        assert_eq!((fixed * ways).rank(1e-6), 2);
    }
}
