//! Bundle adjustment: cameras, lenses and points that explain what was seen (Triggs, McLauchlan,
//! Hartley and Fitzgibbon 1999).
//!
//! Minimises Σ ρ(‖r‖²/σ²) + what is believed by Levenberg–Marquardt; points are eliminated by the Schur
//! complement, so that the system solved has 5 unknowns a lens and 6 a camera, one on a ring. ρ is Cauchy's,
//! ρ(s) = c² ln(1 + s/c²), by reweighting.

use crate::adjust::belief::{Beliefs, terms};
use crate::adjust::damped::{Problem, System, cauchy, descend};
use crate::adjust::lens::LENS;
use crate::adjust::normal::Normal;
use crate::adjust::places::Places;
use crate::adjust::residual::off_px;
use crate::adjust::scene::{PointObservation, Scene, offs};
use crate::adjust::sureness::sureness;
use crate::adjust::system::system;
use nalgebra::{DVector, Point3};
use rayon::prelude::*;

/// How to adjust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Residuals beyond this many standard deviations lose weight (Cauchy's c).
    pub loss: f64,
    /// Most steps.
    pub steps: usize,
    /// A step that lowers the cost by less than this share is the last.
    pub gain: f64,
}

/// How well an adjusted scene fits, and how sure it is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fit {
    /// Root mean square of the residuals, those beyond three times the loss left out. \[px\]
    pub(crate) rms_px: f64,
    /// Standard deviation of each camera's centre. \[mm\]
    pub(crate) sigma_mm: Vec<Option<f64>>,
    /// Standard deviations of each lens' unknowns.
    pub(crate) lens_sigmas: Vec<[f64; LENS]>,
    /// Standard deviation of the ring's size, as a share of it; next to nothing where nothing is
    /// known of sizes, which then are fixed.
    pub(crate) size_sigma: f64,
}

/// Adjusts a scene in place; how it fits.
pub(crate) fn adjust(
    scene: &mut Scene,
    observations: &[PointObservation],
    beliefs: &Beliefs,
    settings: &Settings,
) -> Fit {
    adjusted(scene, observations, beliefs, settings, None);
    fit(scene, observations, beliefs, settings)
}

/// Adjusts all of a scene in place, or some of its shots and its points alone. Returns the costs before and after each
/// accepted step, which never rise. Where neither points nor a ring's axis are known, the first shot stays, and so does
/// its distance from the farthest.
pub fn adjusted(
    scene: &mut Scene,
    observations: &[PointObservation],
    beliefs: &Beliefs,
    settings: &Settings,
    some: Option<&[bool]>,
) -> Vec<f64> {
    let bundle = Bundle::new(scene, observations, beliefs, settings.loss, some);
    descend(&bundle, scene, settings.steps, settings.gain)
}

/// How an adjusted scene fits.
pub(crate) fn fit(
    scene: &Scene,
    observations: &[PointObservation],
    beliefs: &Beliefs,
    settings: &Settings,
) -> Fit {
    let bundle = Bundle::new(scene, observations, beliefs, settings.loss, None);
    let sure = sureness(scene, &bundle.places, bundle.normal(scene, 1e-9));
    let near = offs(scene, observations).into_iter().zip(observations);
    let near: Vec<f64> = near
        .filter(|(off, o)| *off < 3.0 * settings.loss * o.sigma_px)
        .map(|(off, _)| off * off)
        .collect();
    Fit {
        rms_px: (near.iter().sum::<f64>() / near.len().max(1) as f64).sqrt(),
        sigma_mm: sure.centres.into_iter().map(Some).collect(),
        lens_sigmas: sure.lenses,
        size_sigma: sure.size,
    }
}

/// What was seen and believed of a scene, and what of it is adjusted.
struct Bundle<'a> {
    by_point: Vec<Vec<PointObservation>>,
    beliefs: &'a Beliefs,
    loss: f64,
    places: Places,
}

impl<'a> Bundle<'a> {
    fn new(
        scene: &Scene,
        observations: &[PointObservation],
        beliefs: &'a Beliefs,
        loss: f64,
        some: Option<&[bool]>,
    ) -> Bundle<'a> {
        let mut by_point = vec![Vec::new(); scene.points.len()];
        observations.iter().for_each(|o| by_point[o.point].push(*o));
        Bundle {
            by_point,
            beliefs,
            loss,
            places: Places::new(scene, beliefs.zoom_sigma.is_some(), some),
        }
    }

    fn normal(&self, scene: &Scene, damping: f64) -> Normal {
        let (seen, places) = (&self.by_point, &self.places);
        system(scene, seen, self.beliefs, places, self.loss, damping)
    }
}

impl Problem for Bundle<'_> {
    type State = Scene;
    type Rest = Normal;

    fn cost(&self, scene: &Scene) -> f64 {
        let (cameras, c2) = (scene.cameras(), self.loss * self.loss);
        let one = |(at, seen): (&Point3<f64>, &Vec<PointObservation>)| -> f64 {
            let cost = |o: &PointObservation| {
                let off = off_px(&cameras[o.camera], at, o.at_px);
                cauchy(off.map(|off| (off / o.sigma_px).powi(2)), c2)
            };
            seen.iter().map(cost).sum()
        };
        let points = scene.points.par_iter().zip(&self.by_point);
        let seen: Vec<f64> = points.map(one).collect();
        let believed = terms(scene, self.beliefs, &self.places);
        let believed = believed.iter().map(|t| t.off * t.off * t.weight);
        seen.iter().sum::<f64>() + believed.sum::<f64>()
    }

    fn system(&self, scene: &Scene, damping: f64) -> System<Normal> {
        let normal = self.normal(scene, damping);
        System {
            matrix: normal.matrix.clone(),
            right: normal.right.clone(),
            rest: normal,
        }
    }

    /// Points by back-substitution.
    fn moved(&self, scene: &Scene, step: &DVector<f64>, normal: &Normal) -> Scene {
        let mut moved = self.places.moved(scene, step.as_slice());
        let free = moved.points[scene.known..].iter_mut();
        free.zip(normal.point_steps(step))
            .for_each(|(point, step)| *point += step);
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::belief::Steps;
    use crate::adjust::lens::{LensPrior, lens_values};
    use crate::adjust::ring::Ring;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Camera, Intrinsics, PhotoId};

    /// A scene through two lenses on one ring, what is seen of it, and what is believed.
    fn truth(dice: &mut proof::Dice) -> (Scene, Vec<PointObservation>, Beliefs) {
        let ring = Ring {
            turn: Rotation3::from_euler_angles(1.7, 0.02, -0.01),
            offset: Vector3::new(10.0, 60.0, 2000.0),
            angles: (0..12).map(|k| 0.5 * f64::from(k)).collect(),
        };
        let lenses = [900.0, 1100.0].map(|focal| Intrinsics::simple(600, 800, focal));
        let shots = (0..).map(PhotoId).zip(ring.poses());
        let mut scene = Scene::of_one_lens(lenses[0], shots);
        scene.lenses = lenses.to_vec();
        scene.shots.iter_mut().skip(6).for_each(|s| s.lens = 1);
        scene.ring = Some(ring);
        let mut seen = Vec::new();
        for point in 0..150 {
            let mut x = || dice.within(-300.0, 300.0);
            let at = Point3::new(x(), x(), x());
            let one = |(camera, c): (usize, &Camera)| PointObservation {
                camera,
                point,
                at_px: c.project(&at).unwrap().into(),
                sigma_px: 0.5,
            };
            scene.points.push(at);
            seen.extend(scene.cameras().iter().enumerate().map(one));
        }
        let prior = |lens: &Intrinsics| LensPrior {
            mean: lens_values(lens),
            sigma: [100.0, 5.0, 5.0, 0.1, 0.1],
        };
        let steps = Steps {
            turns: vec![0.5; 11],
            sigma: 0.01,
        };
        let beliefs = Beliefs {
            lenses: lenses.iter().map(prior).collect(),
            steps: Some(steps),
            ..Beliefs::default()
        };
        (scene, seen, beliefs)
    }

    /// Changes the ring, and the poses with it.
    fn turn(scene: &mut Scene, change: impl FnOnce(&mut Ring)) {
        let ring = scene.ring.as_mut().unwrap();
        change(ring);
        let poses = scene.shots.iter_mut().zip(ring.poses());
        poses.for_each(|(shot, pose)| shot.pose = pose);
    }

    const HOW: Settings = Settings {
        loss: 3.0,
        steps: 60,
        gain: 1e-9,
    };

    #[test]
    fn two_lenses_on_one_ring_come_back_to_the_truth() {
        let mut dice = proof::Dice(3);
        let (truth, seen, beliefs) = truth(&mut dice);
        let mut scene = truth.clone();
        for lens in &mut scene.lenses {
            lens.focal = lens.focal.map(|f| f * 1.03);
        }
        scene.points.iter_mut().for_each(|p| p.x += dice.normal());
        turn(&mut scene, |ring| {
            let angles = ring.angles.iter_mut();
            angles.for_each(|a| *a += 0.01 * dice.normal());
            ring.offset.x += 3.0;
        });
        let costs = adjusted(&mut scene, &seen, &beliefs, &HOW, None);
        assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
        let fit = fit(&scene, &seen, &beliefs, &HOW);
        assert!(fit.rms_px < 0.01, "{}", fit.rms_px);
        let lenses = scene.lenses.iter().zip(&truth.lenses);
        for ((found, truth), sigmas) in lenses.zip(&fit.lens_sigmas) {
            proof::near(found.focal[0], truth.focal[0], 0.2);
            assert!(sigmas[0] > 0.0 && sigmas[0] < 5.0, "{sigmas:?}");
        }
        let sure = |mm: &Option<f64>| mm.is_some_and(|mm| mm > 0.0 && mm < 10.0);
        assert!(fit.sigma_mm.iter().all(sure), "{:?}", fit.sigma_mm);
    }

    #[test]
    fn only_named_shots_and_points_move() {
        let mut dice = proof::Dice(4);
        let (truth, seen, beliefs) = truth(&mut dice);
        let mut scene = truth.clone();
        turn(&mut scene, |ring| {
            ring.angles[4] += 0.01;
            ring.angles[7] += 0.01;
        });
        let mut some = [false; 12];
        some[4] = true;
        let before = scene.clone();
        adjusted(&mut scene, &seen, &beliefs, &HOW, Some(&some));
        assert_eq!(scene.lenses, truth.lenses);
        let (before, now) = (before.ring.unwrap(), scene.ring.unwrap());
        proof::near(now.angles[4], 2.0, 2e-3);
        let moved = |s: &usize| now.angles[*s] != before.angles[*s];
        assert_eq!((0..12).filter(moved).collect::<Vec<_>>(), [4]);
        assert_eq!((now.turn, now.offset), (before.turn, before.offset));
    }
}
