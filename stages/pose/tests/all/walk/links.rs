//! Features followed over photos in any order.

use crate::walk::scene::{Listening, aligned, photo, scene, walk, walked, why};
use pose::{LinkInput, LinkParams, LinkUp};
use proof::Dice;
use shape::{Camera, Features, Keypoint, Keypoints, PhotoId, Photos, Tracks};
use stage::{Ctx, Stage};
use std::sync::Arc;

/// Features of photos of a scene, described alike wherever they are seen; photos from `from` on show
/// other things.
fn keypoints(cameras: &[Camera], from: usize) -> Keypoints {
    let mut dice = Dice(31);
    let mut views: Vec<Features> = vec![Features::default(); cameras.len()];
    for (at, facing) in scene() {
        for half in [0..from, from..cameras.len()] {
            let mut d = [0.0f64; 128];
            d.iter_mut().for_each(|d| *d = dice.normal().abs());
            for i in half {
                let camera = &cameras[i];
                let hidden =
                    facing.is_some_and(|f| f.dot(&(camera.centre() - at).normalize()) < 0.4);
                let Some(px) = camera
                    .project(&at)
                    .filter(|px| !hidden && camera.holds(*px))
                else {
                    continue;
                };
                let seen: Vec<f64> = d
                    .iter()
                    .map(|d| (d + 0.15 * dice.normal()).max(0.0))
                    .collect();
                let length = seen.iter().map(|d| d * d).sum::<f64>().sqrt();
                let mut described = [0u8; 128];
                (0..128).for_each(|k| described[k] = (seen[k] / length * 512.0).round() as u8);
                views[i].descriptors.push(described);
                views[i].points.push(Keypoint {
                    x: (px.x + 0.4 * dice.normal()) as f32,
                    y: (px.y + 0.4 * dice.normal()) as f32,
                    scale: 2.5,
                    angle: 0.0,
                });
            }
        }
    }
    let views = views.into_iter().enumerate();
    Keypoints {
        views: views.map(|(i, f)| (PhotoId(i as u32), f)).collect(),
    }
}

fn linked(keypoints: Keypoints, threads: usize) -> Result<Tracks, String> {
    let count = keypoints.views.len();
    let photos = Photos {
        photos: (0..count).map(photo).collect(),
        ..Photos::default()
    };
    let input = LinkInput {
        keypoints: Arc::new(keypoints),
        photos: Arc::new(photos),
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| LinkUp::run(&LinkParams::default(), input, &Ctx::alone()))
        .map_err(why)
}

#[test]
fn features_are_followed_over_photos_in_any_order() {
    let truth = walk(8);
    let found = linked(keypoints(&truth, 8), 1).unwrap();
    assert!(found.points.len() > 500, "{}", found.points.len());
    assert_eq!(found, linked(keypoints(&truth, 8), 3).unwrap());
    let cameras = walked(8, found, &Listening::default()).unwrap();
    let got: Vec<_> = cameras.views.values().map(|v| v.camera.centre()).collect();
    let want: Vec<_> = truth.iter().map(|c| c.centre()).collect();
    let (_, _, off) = aligned(&got, &want);
    assert!(off.len() == 8 && off.iter().all(|o| *o < 0.02), "{off:?}");
}

#[test]
fn two_sets_of_photos_that_share_nothing_are_refused() {
    let found = linked(keypoints(&walk(8), 4), 2).map(|t| t.points.len());
    let error = found.unwrap_err();
    assert!(
        error.contains("4 of 8 share features") && error.contains("0004.jpg"),
        "{error}"
    );
}

#[test]
fn a_camera_that_stood_still_is_refused() {
    let one = walk(8)[0];
    let found = linked(keypoints(&[one; 5], 5), 2).map(|t| t.points.len());
    let error = found.unwrap_err();
    assert!(error.contains("the camera did not walk"), "{error}");
}
