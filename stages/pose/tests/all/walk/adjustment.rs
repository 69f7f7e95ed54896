//! The adjustment of lenses, shots and points.

use crate::walk::scene::{FOCAL, aligned, scene, walk};
use nalgebra::{Rotation3, Vector3};
use pose::{LensPrior, Shot, Spot, Terms, WalkModel, adjust_model};
use proof::Dice;
use shape::PhotoId;

#[test]
fn an_adjustment_never_rises_and_comes_back_to_the_truth() {
    let truth = walk(6);
    let mut dice = Dice(8);
    let lens = truth[0].lens;
    let shots: Vec<Shot> = truth
        .iter()
        .enumerate()
        .map(|(i, camera)| Shot {
            photo: PhotoId(i as u32),
            lens: 0,
            pose: camera.pose,
            zoom: 0.0,
        })
        .collect();
    let mut model = WalkModel {
        lenses: vec![lens],
        shots,
        spots: vec![],
    };
    for (at, _) in scene().into_iter().take(300) {
        let observations: Vec<(usize, [f64; 2])> = (0..6)
            .filter_map(|s| Some((s, model.camera(s).project(&at)?.into())))
            .filter(|(_, px): &(usize, [f64; 2])| px.iter().all(|v| v.abs() < 2500.0))
            .collect();
        if observations.len() >= 2 {
            model.spots.push(Spot { at, observations });
        }
    }
    let before = model.clone();
    for spot in &mut model.spots {
        spot.at += Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01;
    }
    for shot in &mut model.shots[1..] {
        shot.pose.rotation =
            Rotation3::new(Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01)
                * shot.pose.rotation;
        shot.pose.translation += Vector3::new(dice.normal(), dice.normal(), dice.normal()) * 0.01;
    }
    model.lenses[0].focal = [FOCAL * 1.02; 2];
    let terms = Terms {
        lenses: vec![LensPrior {
            mean: [FOCAL, lens.centre[0], lens.centre[1], 0.04, -0.03],
            sigma: [100.0, 20.0, 20.0, 0.1, 0.1],
        }],
        zoom_sigma: 1e-4,
        sigma_px: 0.5,
        loss: 2.0,
        steps: 60,
    };
    let costs = adjust_model(&mut model, &terms);
    assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
    proof::near(model.lenses[0].focal[0], FOCAL, 0.5);
    let centres = |m: &WalkModel| m.shots.iter().map(|s| s.pose.centre()).collect::<Vec<_>>();
    let (_, _, off) = aligned(&centres(&model), &centres(&before));
    assert!(off.iter().all(|o| *o < 1e-3), "{off:?}");
}
