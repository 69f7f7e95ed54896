//! The adjustment of lenses, shots and points.

use crate::walk::scene::{FOCAL, aligned, scene as points_seen, walk};
use nalgebra::{Rotation3, Vector3};
use pose::{Beliefs, LensPrior, PointObservation, Scene, Settings, adjusted};
use proof::Dice;
use shape::PhotoId;

#[test]
fn an_adjustment_never_rises_and_comes_back_to_the_truth() {
    let truth = walk(6);
    let mut dice = Dice(8);
    let lens = truth[0].lens;
    let shots = (0..).map(PhotoId).zip(truth.iter().map(|c| c.pose));
    let mut scene = Scene::of_one_lens(lens, shots);
    let mut seen = Vec::new();
    for (at, _) in points_seen().into_iter().take(300) {
        let observations: Vec<(usize, [f64; 2])> = (0..6)
            .filter_map(|s| Some((s, scene.camera(s).project(&at)?.into())))
            .filter(|(_, px): &(usize, [f64; 2])| px.iter().all(|v| v.abs() < 2500.0))
            .collect();
        if observations.len() >= 2 {
            let point = scene.points.len();
            seen.extend(observations.iter().map(|(camera, at_px)| PointObservation {
                camera: *camera,
                point,
                at_px: *at_px,
                sigma_px: 0.5,
            }));
            scene.points.push(at);
        }
    }
    let before = scene.clone();
    for at in &mut scene.points {
        *at += Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01;
    }
    for shot in &mut scene.shots[1..] {
        shot.pose.rotation =
            Rotation3::new(Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01)
                * shot.pose.rotation;
        shot.pose.translation += Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01;
    }
    scene.lenses[0].focal = [FOCAL * 1.02; 2];
    let mut beliefs = Beliefs::of_lens(LensPrior {
        mean: [FOCAL, lens.centre[0], lens.centre[1], 0.04, -0.03],
        sigma: [100.0, 20.0, 20.0, 0.1, 0.1],
    });
    beliefs.zoom_sigma = Some(1e-4);
    let settings = Settings {
        loss: 2.0,
        steps: 60,
        gain: 1e-6,
    };
    let costs = adjusted(&mut scene, &seen, &beliefs, &settings, None);
    assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
    proof::near(scene.lenses[0].focal[0], FOCAL, 0.5);
    let centres = |m: &Scene| m.shots.iter().map(|s| s.pose.centre()).collect::<Vec<_>>();
    let (_, _, off) = aligned(&centres(&scene), &centres(&before));
    assert!(off.iter().all(|o| *o < 1e-3), "{off:?}");
}
