//! A turn is calibrated from features alone, whichever way the disk turns and though the subject sways.

use nalgebra::{Point3, Rotation3, Vector3};
use pose::{Calibrate, CalibrateInput, CalibrateParams, Ring, camera_circle};
use proof::Dice;
use shape::{Camera, Cameras, Intrinsics, Observation, Photo, PhotoId, Photos, Rig, Tracks};
use stage::{Ctx, Stage};
use std::sync::Arc;

const PHOTOS: usize = 18;

pub(crate) fn truth(sign: f64) -> Vec<Camera> {
    at(sign, &std::array::from_fn::<i32, PHOTOS, _>(|i| i as i32))
}

/// Cameras of photos at some places of a turn, in steps of 20°.
pub(crate) fn at(sign: f64, places: &[i32]) -> Vec<Camera> {
    let ring = Ring {
        turn: Rotation3::from_euler_angles(1.72, 0.01, -0.015),
        offset: Vector3::new(-8.0, 150.0, 2500.0),
        angles: places
            .iter()
            .map(|i| sign * f64::from(*i) * 20f64.to_radians())
            .collect(),
    };
    let lens = Intrinsics::simple(1600, 2400, 2670.0);
    ring.poses()
        .into_iter()
        .map(|pose| Camera { lens, pose })
        .collect()
}

/// Features on a trunk that sways slowly by so many millimetres, seen to 0.3 px from the side they
/// are on; one in twenty is somewhere else.
pub(crate) fn tracks(cameras: &[Camera], sway_mm: f64) -> Tracks {
    scattered(cameras, sway_mm, 0.3)
}

/// The same, seen to so many pixels.
fn scattered(cameras: &[Camera], sway_mm: f64, noise_px: f64) -> Tracks {
    let mut dice = Dice(7);
    let mut points = Vec::new();
    for _ in 0..1500 {
        let (angle, z) = (
            dice.within(0.0, std::f64::consts::TAU),
            dice.within(-800.0, 700.0),
        );
        let out = Vector3::new(libm::cos(angle), libm::sin(angle), 0.0);
        let at = Point3::new(190.0 * out.x + 30.0, 120.0 * out.y, z);
        let mut track = Vec::new();
        for (i, camera) in cameras.iter().enumerate() {
            let t = i as f64 / PHOTOS as f64 * std::f64::consts::TAU;
            let lean = sway_mm * (z + 900.0) / 1500.0;
            let moved = at
                + Vector3::new(
                    lean * libm::sin(1.7 * t),
                    lean * libm::cos(1.1 * t + 0.6),
                    0.0,
                );
            if out.dot(&(camera.centre() - at).normalize()) < 0.55 {
                continue;
            }
            let px = camera.project(&moved).unwrap();
            let mut at_px = [px.x, px.y].map(|v| v + noise_px * dice.normal());
            if dice.unit() < 0.05 {
                at_px[0] += dice.within(-60.0, 60.0);
            }
            let at_px = at_px.map(|v| v as f32);
            track.push(Observation {
                photo: PhotoId(i as u32),
                at_px,
                scale_px: 2.0,
            });
        }
        if track.len() >= 2 {
            points.push(track);
        }
    }
    Tracks { points }
}

fn calibrated(cameras: &[Camera], tracks: Tracks, rig: Rig) -> Result<Cameras, String> {
    shown(cameras, tracks, rig, |_| vec![])
}

/// The same by other params.
pub(crate) fn calibrated_by(
    p: &CalibrateParams,
    cameras: &[Camera],
    tracks: Tracks,
    rig: Rig,
) -> Result<Cameras, String> {
    shown_by(p, cameras, tracks, rig, |_| vec![])
}

/// The same, of photos with such files.
fn shown(
    cameras: &[Camera],
    tracks: Tracks,
    rig: Rig,
    file: impl Fn(usize) -> Vec<u8>,
) -> Result<Cameras, String> {
    shown_by(&CalibrateParams::default(), cameras, tracks, rig, file)
}

fn shown_by(
    p: &CalibrateParams,
    cameras: &[Camera],
    tracks: Tracks,
    rig: Rig,
    file: impl Fn(usize) -> Vec<u8>,
) -> Result<Cameras, String> {
    let photo = |i: usize| {
        Photo::of(
            format!("{i:04}.jpg"),
            [cameras[0].lens.width, cameras[0].lens.height],
            file(i),
        )
    };
    let photos = Photos {
        photos: (0..cameras.len()).map(photo).collect(),
        plate: None,
        rig,
    };
    let input = CalibrateInput {
        photos: Arc::new(photos),
        tags: None,
        tracks: Some(Arc::new(tracks)),
    };
    Calibrate::run(p, input, &Ctx::alone()).map_err(|e| match e {
        stage::Stop::Failed(why) => why.to_string(),
        stage::Stop::Cancelled => "cancelled".into(),
    })
}

/// Largest error of a camera's centre after scaling and turning about z, as a share of the radius.
pub(crate) fn error(found: &Cameras, truth: &[Camera]) -> f64 {
    let ring = camera_circle(found).unwrap();
    let level = |c: Point3<f64>, z0: f64, r: f64| Point3::new(c.x / r, c.y / r, (c.z - z0) / r);
    let real = truth[0].centre();
    let r = libm::hypot(real.x, real.y);
    let want: Vec<_> = truth.iter().map(|c| level(c.centre(), real.z, r)).collect();
    let z0 = ring.centre.z;
    let got: Vec<_> = found
        .views
        .values()
        .map(|v| level(v.camera.centre(), z0, ring.radius))
        .collect();
    let turn = |a: &Point3<f64>, b: &Point3<f64>| (a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x);
    let sum = got
        .iter()
        .zip(&want)
        .map(|(a, b)| turn(a, b))
        .fold((0.0, 0.0), |s, t| (s.0 + t.0, s.1 + t.1));
    let back = Rotation3::from_axis_angle(&Vector3::z_axis(), libm::atan2(sum.1, sum.0));
    got.iter()
        .zip(&want)
        .map(|(a, b)| (back * a - b).norm())
        .fold(0.0, f64::max)
}

pub(crate) fn rig(focal_35mm: Option<f64>, step_deg: Option<f64>) -> Rig {
    Rig {
        step: step_deg.map(f64::to_radians),
        focal_35mm,
        ..Rig::default()
    }
}

#[test]
fn either_direction_is_found_and_sway_is_borne() {
    for (sign, sway_mm, most) in [(1.0, 0.0, 0.002), (-1.0, 3.0, 0.004), (1.0, 8.0, 0.006)] {
        let truth = truth(sign);
        let film = 2670.0 / 2400.0 * 36.0 / 1.004;
        let rig = rig(Some(film), Some(20.0));
        let found = calibrated(&truth, tracks(&truth, sway_mm), rig).unwrap();
        let off = error(&found, &truth);
        assert!(off < most, "sway {sway_mm} mm: {off} of the radius");
        let focal = found.views.values().next().unwrap().camera.lens.focal[0];
        assert!(
            (focal / 2670.0 - 1.0).abs() < 0.01,
            "sway {sway_mm} mm: focal length {focal} px"
        );
    }
}

#[test]
fn steps_and_focal_length_may_be_unknown() {
    let truth = truth(-1.0);
    let found = calibrated(&truth, tracks(&truth, 0.0), rig(None, None)).unwrap();
    let off = error(&found, &truth);
    assert!(off < 0.01, "{off} of the radius");
}

#[test]
fn features_of_nothing_in_common_are_refused() {
    let truth = truth(1.0);
    let mut few = tracks(&truth, 0.0);
    few.points.truncate(9);
    let error = calibrated(&truth, few, rig(Some(40.0), Some(20.0))).unwrap_err();
    assert!(error.contains("share too few features"), "{error}");
}

#[test]
fn features_too_far_from_where_they_should_be_are_refused() {
    let truth = truth(1.0);
    let film = 2670.0 / 2400.0 * 36.0 / 1.004;
    // 0.8 px a coordinate are 1.1 px together; 2.2 px are 3.1, and 2 are borne.
    let rig = || rig(Some(film), Some(20.0));
    let fine = calibrated(&truth, scattered(&truth, 0.0, 0.8), rig()).unwrap();
    assert!(error(&fine, &truth) < 0.005);
    let why = calibrated(&truth, scattered(&truth, 0.0, 2.2), rig()).unwrap_err();
    assert!(why.contains("at most 2.0 px is to be trusted"), "{why}");
}

#[test]
fn a_photo_that_is_missing_or_swapped_spoils_no_camera() {
    let gap: Vec<i32> = (0..PHOTOS as i32).map(|i| i + i32::from(i > 6)).collect();
    let mut swapped: Vec<i32> = (0..PHOTOS as i32).collect();
    swapped.swap(4, 5);
    for places in [gap, swapped] {
        for sway_mm in [0.0, 8.0] {
            let truth = at(-1.0, &places);
            let rig = rig(Some(2670.0 / 2400.0 * 36.0), Some(20.0));
            let found = calibrated(&truth, tracks(&truth, sway_mm), rig).unwrap();
            let off = error(&found, &truth);
            assert!(off < 0.006, "{places:?}, sway {sway_mm} mm: {off}");
        }
    }
}

/// The file of a photo of a background before which something plain goes to and fro, shifted.
fn background(k: usize, [dx, dy]: [f64; 2]) -> Vec<u8> {
    let mut gray = shape::Image::filled(400, 600, 0u8);
    let left = 150.0 + 15.0 * libm::sin(0.7 * k as f64);
    for (i, level) in gray.data.iter_mut().enumerate() {
        let (x, y) = ((i % 400) as f64 - dx, (i / 400) as f64 - dy);
        let wall = 110.0
            + 40.0 * libm::sin(x / 7.0) * libm::cos(y / 5.0)
            + 30.0 * libm::sin((x + 2.0 * y) / 17.0);
        let body = (left..left + 100.0).contains(&x) && (60.0..540.0).contains(&y);
        *level = if body { 200.0 } else { wall }.round() as u8;
    }
    shape::gray_to_png(&gray)
}

/// Cameras of a rigid body on small photos, each shifted by a stabiliser.
fn stabilised(shifts: &[[f64; 2]]) -> Cameras {
    let truth: Vec<Camera> = truth(1.0).iter().map(|c| c.resized(400, 600)).collect();
    let mut tracks = scattered(&truth, 0.0, 0.1);
    for seen in tracks.points.iter_mut().flatten() {
        let shift = shifts[seen.photo.0 as usize];
        seen.at_px[0] += shift[0] as f32;
        seen.at_px[1] += shift[1] as f32;
    }
    let film = 2670.0 / 2400.0 * 36.0 / 1.004;
    let file = |i: usize| background(i, shifts[i]);
    shown(&truth, tracks, rig(Some(film), Some(20.0)), file).unwrap()
}

#[test]
fn what_a_stabiliser_shifted_is_found_by_the_background_and_taken_out() {
    let mut dice = Dice(4);
    let mut shifts = [[0.0; 2]; PHOTOS];
    let same = |cameras: &Cameras| {
        let mut all = cameras.views.values().map(|v| v.camera.lens);
        let first = all.next();
        all.all(|lens| Some(lens) == first)
    };
    assert!(same(&stabilised(&shifts)));
    // The middle one of all shifts stays none.
    for pair in shifts[1..].chunks_mut(2) {
        let by = [dice.normal(), dice.normal()].map(|d| 0.8 * d);
        pair[0] = by;
        pair[1..]
            .iter_mut()
            .for_each(|other| *other = by.map(|d| -d));
    }
    let last = shifts[PHOTOS - 1];
    let found = stabilised(&shifts);
    assert!(last != [0.0; 2] && error(&found, &truth(1.0)) < 0.002);
    let centre = |i: usize| found.views.values().nth(i).unwrap().camera.lens.centre;
    for i in 0..PHOTOS {
        for axis in [0, 1] {
            let by = (centre(i)[axis] - centre(0)[axis]) - (shifts[i][axis] - shifts[0][axis]);
            assert!(by.abs() < 0.15, "photo {i}: {by} px");
        }
    }
    // A rigid body: how sure cameras are is reported.
    assert!(found.views.values().all(|v| v.sigma_mm.is_some()));
    // Somebody who kicked the tripod is no stabiliser.
    shifts[7..].iter_mut().for_each(|s| s[0] += 8.0);
    assert!(same(&stabilised(&shifts)));
}
