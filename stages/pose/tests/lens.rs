//! What one turned mat leaves open of the lens, and that a calibrated lens closes it.

use nalgebra::{Rotation3, Vector3};
use pose::{Calibrate, CalibrateInput, CalibrateParams, Ring, mat_corners};
use proof::Dice;
use shape::{Camera, Cameras, Intrinsics, Mat, Photo, PhotoId, Photos, Rig, Tag, Tags};
use stage::{Ctx, Stage};
use std::sync::Arc;

const MAT: Mat = Mat {
    tag_mm: 60.0,
    first_id: 0,
    count: 12,
    ring_mm: 187.0,
};

/// A level camera whose principal point lies off the photo's middle.
fn truth() -> Vec<Camera> {
    let mut lens = Intrinsics::simple(1600, 2400, 3350.0);
    lens.centre = [805.0, 1191.0];
    let ring = Ring {
        turn: Rotation3::from_euler_angles(1.84, 0.0, 0.0),
        offset: Vector3::new(2.0, 342.0, 1774.0),
        angles: (0..18).map(|i| f64::from(i) * 0.349).collect(),
    };
    let poses = ring.poses().into_iter();
    poses.map(|pose| Camera { lens, pose }).collect()
}

fn tags(cameras: &[Camera]) -> Tags {
    let mut dice = Dice(5);
    let mut seen = |camera: &Camera, id: u32| Tag {
        id,
        corners: mat_corners(&MAT, id).unwrap().map(|corner| {
            let at = camera.project(&corner).unwrap();
            [at.x + 0.03 * dice.normal(), at.y + 0.03 * dice.normal()]
        }),
    };
    let of = |(i, camera): (usize, &Camera)| {
        let tags = (0..MAT.count).map(|id| seen(camera, id)).collect();
        (PhotoId(i as u32), tags)
    };
    Tags {
        views: cameras.iter().enumerate().map(of).collect(),
    }
}

fn calibrated(rig: Rig) -> Cameras {
    let cameras = truth();
    let photo = |i: usize| Photo {
        name: format!("{i:04}.jpg"),
        width: 1600,
        height: 2400,
        orientation: 1,
        focal_35mm: None,
        device: String::new(),
        time_s: None,
        file: Arc::from([]),
    };
    let photos = Photos {
        photos: (0..cameras.len()).map(photo).collect(),
        plate: None,
        rig: Rig {
            mat: Some(MAT),
            focal_35mm: Some(3350.0 / 1.004 / 2400.0 * 36.0),
            ..rig
        },
    };
    let input = CalibrateInput {
        photos: Arc::new(photos),
        tags: Some(Arc::new(tags(&cameras))),
        tracks: None,
    };
    let found = Calibrate::run(&CalibrateParams::default(), input, &Ctx::alone());
    found.unwrap_or_else(|_| panic!("no cameras"))
}

/// How far the ring is too large, as a share of it.
fn oversize(found: &Cameras) -> f64 {
    let radius = |c: &Camera| c.centre().x.hypot(c.centre().y);
    let real = radius(&truth()[0]);
    let sum: f64 = found.views.values().map(|v| radius(&v.camera)).sum();
    sum / found.views.len() as f64 / real - 1.0
}

#[test]
fn a_level_camera_leaves_the_size_open_and_says_so() {
    let found = calibrated(Rig::default());
    let off = oversize(&found).abs();
    assert!(off > 0.001, "{off}: the mat alone told the principal row?");
    assert!(off < 2.5 * found.scale_sigma, "{off} {}", found.scale_sigma);
}

#[test]
fn a_principal_point_that_is_given_closes_it() {
    let found = calibrated(Rig {
        centre_px: Some([805.0, 1191.0]),
        ..Rig::default()
    });
    let off = oversize(&found).abs();
    assert!(off < 0.0005, "{off}");
    assert!(found.scale_sigma < 0.0005, "{}", found.scale_sigma);
    let focal = found.views.values().next().unwrap().camera.lens.focal[0];
    assert!((focal / 3350.0 - 1.0).abs() < 0.0005, "{focal}");
}
