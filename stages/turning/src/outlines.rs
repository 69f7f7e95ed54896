//! How well outlines of a motion agree: each point of an outline lies on a ray, and the body that all other photos show
//! touches that ray (silhouette coherence: Hernández, Schmitt and Cipolla 2007).
//!
//! The depth of a ray is the greatest, along it, of the least depth in all other photos' silhouettes. Where all agree it is
//! what the hull of the others overshoots between views, a few millimetres; a step or turn that is wrong makes it deeper on
//! one side of the body and shallower on the other. So depths are drawn to their middle, if that is above 0.

use crate::joints::{Equations, median};
use crate::outline::Outline;
use crate::rays::{Ray, rays};
use crate::scene::Motion;
use rayon::prelude::*;

/// What outlines come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// The middle depth of rays. \[distance to the axis\]
    pub middle: f64,
    /// How far they are from it, one standard deviation by the middle deviation. \[distance to the axis\]
    pub spread: f64,
}

/// The same of rays (Holland and Welsch 1977).
const CAUCHY: f64 = 2.385;

/// What outlines ask of steps and pitch, added to `to`; `weight` of a photo's outline as a whole, in sights, and how many
/// times farther off than usual a ray may be. `None` where no two photos see the same.
pub fn equations(
    outlines: &[Outline],
    motion: &Motion,
    (weight, lax): (f64, f64),
    to: &mut Equations,
) -> Option<Agreement> {
    let rays: Vec<Ray> = (0..outlines.len())
        .into_par_iter()
        .flat_map_iter(|i| rays(outlines, motion, i))
        .collect();
    if rays.is_empty() {
        return None;
    }
    let trunk = || rays.iter().filter(|r| r.weight >= 1.0);
    let mut depths: Vec<f64> = trunk().map(|r| r.depth).collect();
    // A hull never is less than its outlines: what agrees in being too shallow agrees on nothing.
    let middle = median(&mut depths).max(0.0);
    let mut off: Vec<f64> = trunk().map(|r| (r.depth - middle).abs()).collect();
    let spread = (1.4826 * median(&mut off)).max(1e-6);
    let mut counts = vec![0.0; outlines.len()];
    rays.iter().for_each(|r| counts[r.photo] += 0.5);
    for r in &rays {
        let miss = r.depth - middle;
        let share = (miss / (CAUCHY * lax * spread)).powi(2);
        let weight = weight * r.weight / counts[r.photo] / (spread * spread * (1.0 + share));
        to.add(&r.slopes, miss, weight);
    }
    Some(Agreement { middle, spread })
}

/// The depth of each of the trunk's rays of a photo's outline in all others' silhouettes. \[distance to the axis\]
pub(crate) fn depths(outlines: &[Outline], motion: &Motion, photo: usize) -> Vec<f64> {
    let all = rays(outlines, motion, photo);
    let trunk = all.into_iter().filter(|r| r.weight >= 1.0);
    trunk.map(|r| r.depth).collect()
}

#[cfg(test)]
#[path = "outlines_tests.rs"]
mod tests;
