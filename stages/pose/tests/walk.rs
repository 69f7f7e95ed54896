//! Cameras of a walk: a made scene, photos in no order, upright and sideways, from near and far.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use pose::{
    LinkInput, LinkParams, LinkUp, Shot, Spot, Terms, Walk, WalkInput, WalkModel, WalkParams,
    settle,
};
use proof::Dice;
use shape::{
    Camera, Cameras, Features, Intrinsics, Keypoint, Keypoints, Photo, PhotoId, Photos, Pose,
    Sighting, Tracks,
};
use stage::{Ctx, Host, Metric, Stage, Stop, hash};
use std::sync::{Arc, Mutex};

const FOCAL: f64 = 1350.0;
const UP: [f64; 3] = [0.3, -0.2, 0.93];

/// A photo whose file has 1600 × 1200 pixels; every third one was held sideways.
fn photo(i: usize) -> Photo {
    let (width, height, orientation) = if i % 3 == 0 {
        (1600, 1200, 1)
    } else {
        (1200, 1600, 6)
    };
    Photo {
        name: format!("{i:04}.jpg"),
        width,
        height,
        orientation,
        // A tenth off, as a phone's is that crops.
        focal_35mm: Some((FOCAL / 2000.0 * 43.27 * 1.1).round()),
        device: "Phone 3".into(),
        time_s: None,
        file: Arc::from([]),
    }
}

/// Cameras of upright photos on a walk around the origin, up as said, in a mixed order.
fn walk(count: usize) -> Vec<Camera> {
    let mut dice = Dice(17);
    let up = Vector3::from(UP).normalize();
    let tilt = Rotation3::rotation_between(&Vector3::z(), &up).unwrap();
    let one = |i: usize| {
        let angle = ((7 * i) % count) as f64 / count as f64 * std::f64::consts::TAU;
        let far = dice.within(1.6, 2.6);
        let from = Vector3::new(far * angle.cos(), far * angle.sin(), dice.within(-0.3, 0.7));
        let forward =
            (Vector3::new(0.05 * dice.normal(), 0.05 * dice.normal(), 0.0) - from).normalize();
        let right = forward.cross(&Vector3::z()).normalize();
        let rows = [right, forward.cross(&right), forward].map(|r| r.transpose());
        let roll = Rotation3::from_euler_angles(0.0, 0.0, 0.03 * dice.normal());
        let rotation =
            roll * Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows)) * tilt.inverse();
        let photo = photo(i);
        let mut lens = Intrinsics::simple(photo.width, photo.height, FOCAL);
        lens.radial = [0.04, -0.03];
        // The same place of the sensor, 8 and -5 px off its middle, however it is held.
        let [x, y] = lens.centre;
        lens.centre = if i % 3 == 0 {
            [x + 8.0, y - 5.0]
        } else {
            [x + 5.0, y + 8.0]
        };
        let translation = -(rotation * (tilt * from));
        Camera {
            lens,
            pose: Pose {
                rotation,
                translation,
            },
        }
    };
    (0..count).map(one).collect()
}

/// Points of a figure and of the room around, and whether a point faces a camera.
fn scene() -> Vec<(Point3<f64>, Option<Vector3<f64>>)> {
    let mut dice = Dice(5);
    let up = Vector3::from(UP).normalize();
    let tilt = Rotation3::rotation_between(&Vector3::z(), &up).unwrap();
    let mut points = Vec::new();
    for k in 0..2600 {
        let angle = dice.within(0.0, std::f64::consts::TAU);
        let out = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let (at, facing) = match k % 2 {
            0 => (
                0.3 * out + Vector3::z() * dice.within(-0.8, 0.8),
                Some(tilt * out),
            ),
            _ => (
                dice.within(4.0, 6.0) * out + Vector3::z() * dice.within(-1.0, 2.0),
                None,
            ),
        };
        points.push((Point3::from(tilt * at), facing));
    }
    points
}

/// Where photos show points, to `noise_px`; one sighting in twenty is elsewhere.
fn tracks(cameras: &[Camera], noise_px: f64) -> Tracks {
    let mut dice = Dice(9);
    let mut points = Vec::new();
    for (at, facing) in scene() {
        let mut track = Vec::new();
        for (i, camera) in cameras.iter().enumerate() {
            let hidden = facing.is_some_and(|f| f.dot(&(camera.centre() - at).normalize()) < 0.4);
            let Some(px) = camera
                .project(&at)
                .filter(|px| !hidden && camera.holds(*px))
            else {
                continue;
            };
            let mut at_px = [px.x, px.y].map(|v| v + noise_px * dice.normal());
            if dice.unit() < 0.05 {
                at_px = at_px.map(|v| v + dice.within(-80.0, 80.0));
            }
            if dice.unit() < 0.6 {
                track.push(Sighting {
                    photo: PhotoId(i as u32),
                    at_px: at_px.map(|v| v as f32),
                    scale_px: 2.0,
                });
            }
        }
        if track.len() >= 2 {
            points.push(track);
        }
    }
    Tracks { points }
}

/// Keeps what is told.
#[derive(Default)]
struct Listening(Mutex<Vec<String>>);

impl Host for Listening {
    fn warn(&self, text: &str) {
        self.0.lock().unwrap().push(text.into());
    }
    fn metric(&self, _: Metric) {}
}

fn walked(count: usize, tracks: Tracks, host: &Listening) -> Result<Cameras, String> {
    let photos = Photos {
        photos: (0..count).map(photo).collect(),
        ..Photos::default()
    };
    let input = WalkInput {
        photos: Arc::new(photos),
        tracks: Arc::new(tracks),
    };
    let ctx = Ctx::new(host, hash(b"recipe"), hash(b"action"));
    Walk::run(&WalkParams::default(), input, &ctx).map_err(why)
}

fn why(stop: Stop) -> String {
    match stop {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => "cancelled".into(),
    }
}

/// The similarity that takes points nearest to others (Umeyama 1991): turn, size, and what is left.
fn aligned(from: &[Point3<f64>], to: &[Point3<f64>]) -> (Matrix3<f64>, f64, Vec<f64>) {
    let mean =
        |all: &[Point3<f64>]| all.iter().map(|p| p.coords).sum::<Vector3<f64>>() / all.len() as f64;
    let (a, b) = (mean(from), mean(to));
    let pairs = || {
        from.iter()
            .zip(to)
            .map(|(p, q)| (p.coords - a, q.coords - b))
    };
    let spread: Matrix3<f64> = pairs().map(|(p, q)| q * p.transpose()).sum();
    let svd = spread.svd(true, true);
    let (u, vt) = (svd.u.unwrap(), svd.v_t.unwrap());
    let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, (u * vt).determinant())) * vt;
    let size = pairs().map(|(p, q)| q.dot(&(turn * p))).sum::<f64>()
        / pairs().map(|(p, _)| p.norm_squared()).sum::<f64>();
    (
        turn,
        size,
        pairs().map(|(p, q)| (turn * p * size - q).norm()).collect(),
    )
}

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
        let off = (lens.centre[0] - want.centre[0]).hypot(lens.centre[1] - want.centre[1]);
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
        for sighting in tracks
            .points
            .iter_mut()
            .flatten()
            .filter(|s| gone.contains(&s.photo.0))
        {
            sighting.at_px = [
                dice.within(0.0, 1199.0) as f32,
                dice.within(0.0, 1199.0) as f32,
            ];
        }
        tracks
    };
    let host = Listening::default();
    let found = walked(12, without(&[4]), &host).unwrap();
    assert_eq!(found.views.len(), 11);
    let told = host.0.lock().unwrap().clone();
    assert!(
        told.len() == 1 && told[0].contains("0004.jpg") && told[0].contains("has no camera"),
        "{told:?}"
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
    let truth = walk(12);
    let error = walked(12, tracks(&truth, 12.0), &Listening::default()).unwrap_err();
    assert!(
        error.contains("photos fit one arrangement")
            || error.contains("is to be trusted")
            || error.contains("places well apart"),
        "{error}"
    );
}

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
        let sights: Vec<(usize, [f64; 2])> = (0..6)
            .filter_map(|s| Some((s, model.camera(s).project(&at)?.into())))
            .filter(|(_, px): &(usize, [f64; 2])| px.iter().all(|v| v.abs() < 2500.0))
            .collect();
        if sights.len() >= 2 {
            model.spots.push(Spot { at, sights });
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
        lenses: vec![pose::LensPrior {
            mean: [FOCAL, lens.centre[0], lens.centre[1], 0.04, -0.03],
            sigma: [100.0, 20.0, 20.0, 0.1, 0.1],
        }],
        zoom_sigma: 1e-4,
        sigma_px: 0.5,
        loss: 2.0,
        steps: 60,
    };
    let costs = settle(&mut model, &terms);
    assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
    proof::near(model.lenses[0].focal[0], FOCAL, 0.5);
    let centres = |m: &WalkModel| m.shots.iter().map(|s| s.pose.centre()).collect::<Vec<_>>();
    let (_, _, off) = aligned(&centres(&model), &centres(&before));
    assert!(off.iter().all(|o| *o < 1e-3), "{off:?}");
}

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
fn a_camera_that_stood_still_is_told_so() {
    let one = walk(8)[0];
    let found = linked(keypoints(&[one; 5], 5), 2).map(|t| t.points.len());
    let error = found.unwrap_err();
    assert!(error.contains("the camera did not walk"), "{error}");
}
