//! The stage that makes a subject sway about its ankles, and step elsewhere for each photo.

use crate::dice::Dice;
use crate::paced::paced;
use nalgebra::{Rotation3, Vector3};
use shape::{Cameras, PhotoId, Pose, Sway};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How much, and how.
    pub struct SwayParams {
        /// Greatest way of the breast from rest.
        #[range(0.0..=200.0)]
        #[source(structural)]
        sway_mm: f64 = 0.0,
        /// Height at which that is so.
        #[range(1.0..=3000.0)]
        #[source(structural)]
        breast_mm: f64 = 1280.0,
        /// Height of the axis about which the subject leans.
        #[range(0.0..=1000.0)]
        #[source(structural)]
        ankle_mm: f64 = 60.0,
        /// Standard deviation of where the feet are, along each side of the floor, as of somebody who turns by small
        /// steps: 0 on a disk.
        #[range(0.0..=200.0)]
        #[source(structural)]
        shuffle_mm: f64 = 0.0,
        /// How many photos are from step to step, between which feet go smoothly, as in a film.
        #[range(1..=720)]
        #[source(structural)]
        pace: u32 = 1,
        /// Seed of the movement.
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}

stage::inputs! {
    /// The photos in which the subject moves.
    pub struct SwayInput {
        /// The cameras.
        cameras: Arc<Cameras>,
    }
}

/// `synth.sway`: cameras → motion.
pub struct MakeSway;

impl Stage for MakeSway {
    const NAME: &'static str = "synth.sway";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Lets the subject lean about its ankles, slowly, a little in each photo, and move its feet.";
    type Params = SwayParams;
    type Input = SwayInput;
    type Output = Sway;

    fn run(p: &SwayParams, input: SwayInput, _: &Ctx<'_>) -> Result<Sway, Stop> {
        let ids: Vec<PhotoId> = input.cameras.views.iter().map(|(id, _)| id).collect();
        let leans = leans(ids.len(), p.seed);
        let angle = p.sway_mm / (p.breast_mm - p.ankle_mm).max(1.0);
        let mut dice = Dice::new(p.seed, 3);
        let mut step = || p.shuffle_mm * dice.normal();
        let steps: Vec<[f64; 2]> = (0..=ids.len()).map(|_| [step(), step()]).collect();
        let pose = |(i, [x, y]): (usize, [f64; 2])| {
            // A lean towards (x, y) turns about (-y, x).
            let rotation = Rotation3::new(Vector3::new(-y, x, 0.0) * angle);
            let [aside, ahead] = paced(i as f64, p.pace, |k| steps[k as usize]);
            let ankle = Vector3::new(0.0, 0.0, p.ankle_mm);
            Pose {
                rotation,
                translation: ankle - rotation * ankle + Vector3::new(aside, ahead, 0.0),
            }
        };
        let poses = leans.into_iter().enumerate().map(pose);
        Ok(Sway {
            views: ids.into_iter().zip(poses).collect(),
        })
    }
}

/// Slow leans, two numbers a photo, the greatest of length 1 and their mean 0: three waves in each
/// direction, of chance phase and falling strength.
fn leans(count: usize, seed: u32) -> Vec<[f64; 2]> {
    let mut dice = Dice::new(seed, 2);
    let mut waves = [[(0.0, 0.0, 0.0); 3]; 2];
    for side in &mut waves {
        for (k, wave) in side.iter_mut().enumerate() {
            let speed = 1.3 * (k as f64 + 1.0) + 0.7 * dice.unit();
            let strength = (0.6 + dice.unit()) / (k as f64 + 1.0);
            *wave = (strength, speed, std::f64::consts::TAU * dice.unit());
        }
    }
    let at = |i: usize, side: usize| -> f64 {
        let t = i as f64 / count.max(1) as f64 * std::f64::consts::TAU;
        waves[side]
            .iter()
            .map(|(a, w, p)| a * libm::sin(w * t + p))
            .sum()
    };
    let mut leans: Vec<[f64; 2]> = (0..count).map(|i| [at(i, 0), at(i, 1)]).collect();
    for side in 0..2 {
        let mean = leans.iter().map(|l| l[side]).sum::<f64>() / count.max(1) as f64;
        leans.iter_mut().for_each(|l| l[side] -= mean);
    }
    let most = leans
        .iter()
        .map(|l| libm::hypot(l[0], l[1]))
        .fold(0.0, f64::max);
    if most > 0.0 {
        leans.iter_mut().for_each(|l| *l = l.map(|x| x / most));
    }
    leans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::{MakeRing, RingInput, RingParams};

    fn moved(p: &SwayParams) -> Vec<Pose> {
        let ring = MakeRing::run(&RingParams::default(), RingInput {}, &Ctx::alone()).unwrap();
        let input = SwayInput {
            cameras: Arc::new(ring),
        };
        let sway = MakeSway::run(p, input, &Ctx::alone()).unwrap();
        sway.views.values().copied().collect()
    }

    #[test]
    fn feet_are_elsewhere_only_where_that_is_asked_for() {
        let still = SwayParams::default();
        let soles = Vector3::new(0.0, 0.0, still.ankle_mm);
        let rest = moved(&still);
        assert!(rest.iter().all(|p| p.translation.norm() == 0.0));
        let shuffle_mm = 30.0;
        let on_the_spot = moved(&SwayParams {
            shuffle_mm,
            ..still
        });
        let far = |p: &Pose| (p.apply(&soles.into()) - soles).norm_squared();
        let mean = on_the_spot.iter().map(far).sum::<f64>() / on_the_spot.len() as f64;
        proof::near(mean.sqrt(), shuffle_mm * 2f64.sqrt(), 12.0);
        assert!(on_the_spot.iter().all(|p| p.translation.z.abs() < 1e-9));
    }
}
