//! Cameras of a walk, and what is refused.

use crate::walk::scene::{Listening, UP, aligned, tracks, walk, walked};
use nalgebra::{Rotation3, Vector3};
use proof::Dice;
use shape::Camera;

#[test]
fn cameras_of_a_walk_are_found_upright_and_sideways() {
    let truth = walk(16);
    let host = Listening::default();
    let found = walked(16, tracks(&truth, 0.4), &host).unwrap();
    assert_eq!(found.views.len(), 16);
    assert_eq!(*host.0.lock().unwrap(), Vec::<String>::new());
    let got: Vec<_> = found.views.values().map(|v| v.camera.centre()).collect();
    let want: Vec<_> = truth.iter().map(|c| c.centre()).collect();
    let (turn, _, off) = aligned(&got, &want);
    let radius = want.iter().map(|c| c.coords.norm()).sum::<f64>() / 16.0;
    assert!(
        off.iter().all(|o| o / radius < 0.002),
        "{off:?} of {radius}"
    );
    // z is up, and the origin is where they look.
    assert!((turn * Vector3::z()).angle(&Vector3::from(UP)) < 0.02);
    let aside = got.iter().map(|c| c.coords.xy().norm()).sum::<f64>() / 16.0;
    proof::near(aside, 1000.0, 1e-6);
    for (view, camera) in found.views.values().zip(&truth) {
        let (lens, want) = (&view.camera.lens, &camera.lens);
        assert_eq!((lens.width, lens.height), (want.width, want.height));
        proof::near(lens.focal[0] / want.focal[0], 1.0, 0.004);
        let off = libm::hypot(
            lens.centre[0] - want.centre[0],
            lens.centre[1] - want.centre[1],
        );
        assert!(off < 4.0, "{:?} for {:?}", lens.centre, want.centre);
        let turned = view.camera.pose.rotation.matrix()
            * turn.transpose()
            * camera.pose.rotation.matrix().transpose();
        assert!(Rotation3::from_matrix_unchecked(turned).angle() < 0.004);
        assert!(view.points > 100 && view.rms_px.unwrap() < 1.0 && view.sigma_mm.unwrap() < 10.0);
    }
}

#[test]
fn the_same_bytes_come_with_any_number_of_threads() {
    let truth = walk(10);
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let found = pool.install(|| walked(10, tracks(&truth, 0.4), &Listening::default()));
        stage::to_bytes(&found.unwrap())
    };
    let one = bytes(1);
    assert!(one == bytes(2) && one == bytes(5));
}

#[test]
fn a_photo_of_something_else_is_named_and_many_are_refused() {
    let truth = walk(12);
    let without = |gone: &[u32]| {
        let mut tracks = tracks(&truth, 0.4);
        let mut dice = Dice(3);
        for observation in tracks
            .points
            .iter_mut()
            .flatten()
            .filter(|s| gone.contains(&s.photo.0))
        {
            observation.at_px = [
                dice.within(0.0, 1199.0) as f32,
                dice.within(0.0, 1199.0) as f32,
            ];
        }
        tracks
    };
    let host = Listening::default();
    let found = walked(12, without(&[4]), &host).unwrap();
    assert_eq!(found.views.len(), 11);
    let warnings = host.0.lock().unwrap().clone();
    assert!(
        warnings.len() == 1
            && warnings[0].contains("0004.jpg")
            && warnings[0].contains("has no camera"),
        "{warnings:?}"
    );
    let error = walked(12, without(&[4, 6, 9, 11]), &Listening::default()).unwrap_err();
    assert!(
        error.contains("only 8 of 12 photos fit") && error.contains("0011.jpg"),
        "{error}"
    );
}

#[test]
fn a_camera_that_only_turned_on_the_spot_is_refused() {
    let truth: Vec<Camera> = walk(10)
        .into_iter()
        .map(|mut camera| {
            camera.pose.translation = Vector3::zeros();
            camera
        })
        .collect();
    let error = walked(10, tracks(&truth, 0.2), &Listening::default()).unwrap_err();
    assert!(error.contains("from places well apart"), "{error}");
}

#[test]
fn features_that_scatter_are_refused() {
    let truth = walk(8);
    let error = walked(8, tracks(&truth, 12.0), &Listening::default()).unwrap_err();
    assert!(error.contains("places well apart"), "{error}");
}
