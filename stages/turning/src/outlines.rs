//! How well outlines of a motion agree: each point of an outline is on a ray, and the body that all other photos show
//! touches that ray (silhouette coherence: Hernández, Schmitt and Cipolla 2007).
//!
//! The depth of a ray is the greatest, along it, of the least depth in all other photos' silhouettes. Where all agree it is
//! what the hull of the rest overshoots between views, a few millimetres, and more where steps are wider; a step or
//! turn that is wrong makes it deeper on one side of the body and shallower on the other. So depths are drawn to those of a body
//! as round as the middle one.

use crate::joints::{Equations, median};
use crate::outline::Outline;
use crate::rays::{Ray, rays};
use crate::scene::Motion;
use rayon::prelude::*;
use std::f64::consts::SQRT_2;

/// What outlines come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// How round the body is: the middle of depths by what they would be of a body of radius 1. \[distance to the axis\]
    pub radius: f64,
    /// What the middle ray's depth would be of such a body.
    pub round: f64,
    /// How far depths are from those of a body of that radius, one standard deviation by the middle deviation.
    /// \[distance to the axis\]
    pub spread: f64,
}

impl Agreement {
    /// Of the trunk's rays.
    fn of<'a>(rays: impl Iterator<Item = &'a Ray> + Clone) -> Agreement {
        let mut all: Vec<(f64, f64)> = rays
            .clone()
            .map(|r| (r.depth / r.round.max(1e-9), r.round))
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut left = all.iter().map(|r| r.1).sum::<f64>() / 2.0;
        let middle = all.iter().find(|r| {
            left -= r.1;
            left <= 0.0
        });
        let mut found = Agreement {
            // A hull never is less than its outlines: what agrees in being too shallow agrees on nothing.
            radius: middle.map_or(0.0, |r| r.0.max(0.0)),
            round: median(&mut rays.clone().map(|r| r.round).collect::<Vec<_>>()),
            spread: 0.0,
        };
        let mut off: Vec<f64> = rays.map(|r| found.miss(r).abs()).collect();
        found.spread = (1.4826 * median(&mut off)).max(1e-6);
        found
    }

    /// How far a ray's depth is from what the steps to the photos beside it let expect. \[distance to the axis\]
    fn miss(&self, ray: &Ray) -> f64 {
        ray.depth - self.radius * ray.round
    }

    /// The same in standard deviations: no body is round, so depths differ by more where steps are wider.
    fn off(&self, ray: &Ray) -> f64 {
        let wide = libm::hypot(1.0, ray.round / self.round.max(1e-9)) / SQRT_2;
        self.miss(ray).abs() / (self.spread * wide)
    }
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
    let found = Agreement::of(rays.iter().filter(|r| r.weight >= 1.0));
    let mut counts = vec![0.0; outlines.len()];
    rays.iter().for_each(|r| counts[r.photo] += 0.5);
    let spread = found.spread;
    for r in &rays {
        let miss = found.miss(r);
        let share = (miss / (CAUCHY * lax * spread)).powi(2);
        let weight = weight * r.weight / counts[r.photo] / (spread * spread * (1.0 + share));
        to.add(&r.slopes, miss, weight);
    }
    Some(found)
}

/// How far the trunk's rays of a photo's outline are from what all agree on, in standard deviations; the middle one.
pub(crate) fn off(outlines: &[Outline], motion: &Motion, photo: usize, all: &Agreement) -> f64 {
    let rays = rays(outlines, motion, photo);
    let trunk = rays.iter().filter(|r| r.weight >= 1.0);
    let mut off: Vec<f64> = trunk.map(|r| all.off(r)).collect();
    match off.is_empty() {
        true => f64::MAX,
        false => median(&mut off),
    }
}

#[cfg(test)]
#[path = "outlines_tests.rs"]
mod tests;
