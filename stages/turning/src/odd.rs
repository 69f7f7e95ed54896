//! Photos whose outline does not fit where joints and the outlines of all photos put it, such as somebody else's.

use crate::outline::Outline;
use crate::outlines::{Agreement, off};
use crate::scene::Motion;
use rayon::prelude::*;

/// An outline whose middle ray is so many standard deviations off is odd (three-sigma rule: Pukelsheim 1994).
const ODD: f64 = 3.0;

/// The photos whose outlines are odd.
pub(crate) fn odd(outlines: &[Outline], motion: &Motion, all: &Agreement) -> Vec<usize> {
    let photos = 0..outlines.len();
    let off: Vec<f64> = photos
        .into_par_iter()
        .map(|i| off(outlines, motion, i, all))
        .collect();
    (0..off.len()).filter(|i| off[*i] > ODD).collect()
}
