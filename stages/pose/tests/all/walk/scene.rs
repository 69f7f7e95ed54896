//! A made scene: a figure before a background, cameras that walk around it, and what their photos show.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use pose::{Walk, WalkInput, WalkParams};
use proof::Dice;
use shape::{Camera, Cameras, Intrinsics, Observation, Photo, PhotoId, Photos, Pose, Tracks};
use stage::{Ctx, Host, Metric, Stage, Stop, hash};
use std::sync::{Arc, Mutex};

pub(crate) const FOCAL: f64 = 1350.0;
pub(crate) const UP: [f64; 3] = [0.3, -0.2, 0.93];

/// A photo whose file has 1600 × 1200 pixels; every third one was taken sideways.
pub(crate) fn photo(i: usize) -> Photo {
    let (width, height, orientation) = if i.is_multiple_of(3) {
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
        file: Vec::new().into(),
    }
}

/// Cameras of upright photos on a walk around the origin, up as given, in a mixed order.
pub(crate) fn walk(count: usize) -> Vec<Camera> {
    let mut dice = Dice(17);
    let up = Vector3::from(UP).normalize();
    let tilt = Rotation3::rotation_between(&Vector3::z(), &up).unwrap();
    let one = |i: usize| {
        let angle = ((7 * i) % count) as f64 / count as f64 * std::f64::consts::TAU;
        let far = dice.within(1.6, 2.6);
        let from = Vector3::new(
            far * libm::cos(angle),
            far * libm::sin(angle),
            dice.within(-0.3, 0.7),
        );
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
        // The same place of the sensor, 8 and -5 px off its middle, however it was turned.
        let [x, y] = lens.centre;
        lens.centre = if i.is_multiple_of(3) {
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

/// Points of a figure and of what is around, and whether a point faces a camera.
pub(crate) fn scene() -> Vec<(Point3<f64>, Option<Vector3<f64>>)> {
    let mut dice = Dice(5);
    let up = Vector3::from(UP).normalize();
    let tilt = Rotation3::rotation_between(&Vector3::z(), &up).unwrap();
    let mut points = Vec::new();
    for k in 0..2600 {
        let angle = dice.within(0.0, std::f64::consts::TAU);
        let out = Vector3::new(libm::cos(angle), libm::sin(angle), 0.0);
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

/// Where photos show points, to `noise_px`; one observation in twenty is elsewhere.
pub(crate) fn tracks(cameras: &[Camera], noise_px: f64) -> Tracks {
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
                track.push(Observation {
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

/// Keeps the warnings.
#[derive(Default)]
pub(crate) struct Listening(pub(crate) Mutex<Vec<String>>);

impl Host for Listening {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.into());
    }
    fn metric(&self, _: Metric) {}
}

pub(crate) fn walked(count: usize, tracks: Tracks, host: &Listening) -> Result<Cameras, String> {
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

pub(crate) fn why(stop: Stop) -> String {
    match stop {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => "cancelled".into(),
    }
}

/// The similarity that takes points nearest to target points (Umeyama 1991): turn, size, and what is left.
pub(crate) fn aligned(from: &[Point3<f64>], to: &[Point3<f64>]) -> (Matrix3<f64>, f64, Vec<f64>) {
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
