//! Photos whose outline fits nowhere near where its joints put it: sought all around, and left out if it fits nowhere.

use crate::joints::median;
use crate::outline::Outline;
use crate::outlines::depths;
use crate::scene::Motion;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// An outline that is so many times farther off than the middle one is odd. By hand: of 24 photos of a scanned person none was
/// beyond 2 but one whose joints were wrong.
const ODD: f64 = 3.0;
/// Azimuths at which an odd one is tried.
const TRIED: usize = 36;

/// How far each photo's outline is from all others': the middle of its rays. \[distance to the axis\]
fn off(outlines: &[Outline], motion: &Motion, photo: usize) -> f64 {
    let mut all: Vec<f64> = depths(outlines, motion, photo);
    all.iter_mut().for_each(|d| *d = d.abs());
    match all.is_empty() {
        true => f64::MAX,
        false => median(&mut all),
    }
}

/// The photos whose outlines are odd.
pub(crate) fn odd(outlines: &[Outline], motion: &Motion) -> Vec<usize> {
    let photos = 0..outlines.len();
    let all: Vec<f64> = photos
        .into_par_iter()
        .map(|i| off(outlines, motion, i))
        .collect();
    let middle = median(&mut all.clone());
    (0..all.len()).filter(|i| all[*i] > ODD * middle).collect()
}

/// Puts each odd photo where its outline fits best, all around.
pub(crate) fn sought(outlines: &[Outline], motion: &mut Motion) {
    for photo in odd(outlines, motion) {
        let at = motion.steps[photo].azimuth;
        let place = |k: usize| {
            let mut tried = motion.clone();
            tried.steps[photo].azimuth = at + k as f64 / TRIED as f64 * TAU;
            off(outlines, &tried, photo)
        };
        let all: Vec<f64> = (0..TRIED).into_par_iter().map(place).collect();
        let best = (0..TRIED).min_by(|a, b| all[*a].total_cmp(&all[*b]));
        let turn = crate::azimuth::wrapped(best.unwrap_or(0) as f64 / TRIED as f64 * TAU);
        motion.steps[photo].azimuth = at + turn;
    }
}
