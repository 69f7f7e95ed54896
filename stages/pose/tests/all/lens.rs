//! What one turned mat leaves open of the lens, and that a calibrated lens or tags on the rim close it.

use nalgebra::{Point3, Rotation3, Vector2, Vector3};
use pose::{
    Calibrate, CalibrateInput, CalibrateParams, Line, Ring, fitted_line, mat_corners, meeting,
};
use proof::Dice;
use shape::{Camera, Cameras, Intrinsics, Mat, Photo, PhotoId, Photos, Rig, Rim, Tag, Tags};
use stage::{Ctx, Stage};
use std::sync::Arc;

const MAT: Mat = Mat {
    tag_mm: 60.0,
    first_id: 0,
    count: 12,
    ring_mm: 187.0,
};

/// A level camera whose principal point is off the photo's middle.
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

/// A strip as it was given; it was not glued quite so.
const RIM: Rim = Rim {
    tag_mm: 24.0,
    first_id: 12,
    count: 40,
    radius_mm: 225.0,
};

/// The tags of a strip on a rim 0.4 mm wider than given, off the middle, printed a two
/// thousandth too tall, each glued a little beside its place: as a detector sees them that lays
/// straight lines through their sides, to 0.03 px.
fn with_strip(cameras: &[Camera], mut tags: Tags, printed_mm: f64) -> Tags {
    let mut dice = Dice(11);
    for id in RIM.first_id..RIM.first_id + RIM.count {
        let (along, down) = (dice.within(-0.6, 0.6), dice.within(-0.6, 0.6));
        let turn = 1.0 + f64::from(id) / f64::from(RIM.count) * std::f64::consts::TAU;
        let radius = RIM.radius_mm + 0.4;
        let point = |u: f64, v: f64| {
            let (sin, cos) = libm::sincos(turn + (along + u * printed_mm) / radius);
            let z = v * printed_mm * 1.0005 - 15.0 - down;
            Point3::new(0.5 + radius * cos, radius * sin - 0.3, z)
        };
        let out = Vector3::new(libm::cos(turn), libm::sin(turn), 0.0);
        for (i, camera) in cameras.iter().enumerate() {
            if out.dot(&(camera.centre() - point(0.0, 0.0)).normalize()) < 0.3 {
                continue;
            }
            let see = |u: f64, v: f64| camera.project(&point(u, v)).unwrap().coords;
            let sides = [
                line(|t| see(t, 0.5)),
                line(|t| see(0.5, t)),
                line(|t| see(t, -0.5)),
                line(|t| see(-0.5, t)),
            ];
            let corners = [(3, 0), (0, 1), (1, 2), (2, 3)].map(|(a, b)| {
                let at = meeting(sides[a], sides[b]).unwrap();
                [at.x + 0.03 * dice.normal(), at.y + 0.03 * dice.normal()]
            });
            tags.views
                .get_mut(PhotoId(i as u32))
                .unwrap()
                .push(Tag { id, corners });
        }
    }
    tags
}

/// The line of least squares through the middle four fifths of a side.
fn line(see: impl Fn(f64) -> Vector2<f64>) -> Line {
    let points: Vec<Vector2<f64>> = (-40..=40).map(|k| see(f64::from(k) / 100.0)).collect();
    fitted_line(&points).unwrap()
}

fn calibrated(rig: Rig) -> Cameras {
    let cameras = truth();
    let tags = tags(&cameras);
    from(rig, &cameras, tags)
}

fn from(rig: Rig, cameras: &[Camera], tags: Tags) -> Cameras {
    let photo = |i: usize| Photo::of(format!("{i:04}.jpg"), [1600, 2400], Vec::new());
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
        tags: Some(Arc::new(tags)),
        tracks: None,
    };
    let found = Calibrate::run(&CalibrateParams::default(), input, &Ctx::alone());
    found.unwrap_or_else(|_| panic!("no cameras"))
}

/// How far the ring is too large, as a share of it.
fn oversize(found: &Cameras) -> f64 {
    let radius = |c: &Camera| libm::hypot(c.centre().x, c.centre().y);
    let real = radius(&truth()[0]);
    let sum: f64 = found.views.values().map(|v| radius(&v.camera)).sum();
    sum / found.views.len() as f64 / real - 1.0
}

#[test]
fn a_level_camera_leaves_the_size_open_with_a_warning() {
    let found = calibrated(Rig::default());
    let off = oversize(&found).abs();
    assert!(off > 0.001, "{off}: the mat alone gave the principal row?");
    let sigma = found.scale_sigma.unwrap();
    assert!(off < 2.5 * sigma, "{off} {sigma}");
}

#[test]
fn a_principal_point_that_is_given_closes_it() {
    let found = calibrated(Rig {
        centre_px: Some([805.0, 1191.0]),
        ..Rig::default()
    });
    let off = oversize(&found).abs();
    assert!(off < 0.0005, "{off}");
    let sigma = found.scale_sigma.unwrap();
    assert!(sigma < 0.0005, "{sigma}");
    let focal = found.views.values().next().unwrap().camera.lens.focal[0];
    assert!((focal / 3350.0 - 1.0).abs() < 0.0005, "{focal}");
}

#[test]
fn tags_on_the_rim_close_it_however_they_are_glued() {
    let cameras = truth();
    let rig = || Rig {
        rim: Some(RIM),
        ..Rig::default()
    };
    let tags = with_strip(&cameras, tags(&cameras), 24.0);
    let found = from(rig(), &cameras, tags.clone());
    let (off, sigma) = (oversize(&found).abs(), found.scale_sigma.unwrap());
    eprintln!("{off} {sigma}");
    assert!(sigma < 0.0005, "{sigma}");
    assert!(off < 2.0 * sigma, "{off} {sigma}");
    let lens = found.views.values().next().unwrap().camera.lens;
    assert!((lens.centre[1] - 1191.0).abs() < 4.0, "{:?}", lens.centre);
    // Not given, they change nothing.
    let without = from(Rig::default(), &cameras, tags);
    assert_eq!(without, calibrated(Rig::default()));
}

#[test]
fn a_strip_of_another_size_than_given_is_left_out() {
    let cameras = truth();
    let tags = with_strip(&cameras, tags(&cameras), 26.0);
    let rig = Rig {
        rim: Some(RIM),
        ..Rig::default()
    };
    let found = from(rig, &cameras, tags);
    assert_eq!(found.views, calibrated(Rig::default()).views);
}
