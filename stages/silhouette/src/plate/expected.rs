//! What a photo would show without the subject: the plate, with the disk turned as it was.
//!
//! What is around the disk is still, so there the plate is the background, pixel for pixel. The
//! disk turns: a pixel that sees the disk's top sees the same point of the disk elsewhere on the
//! plate. Where the disk stood on the plate is found by trying all angles.

use crate::scene::disk_map::RIM;
use crate::scene::disk_plane::{DiskTop, sample};
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{Camera, Pose, Rgb};

/// The camera as if the disk had been turned on by an angle, counter-clockwise from above. \[rad\]
pub(crate) fn turned(camera: &Camera, angle: f64) -> Camera {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
    Camera {
        pose: Pose {
            rotation: camera.pose.rotation * turn,
            ..camera.pose
        },
        ..*camera
    }
}

/// Of so many places of the disk one tells which angle may be right (structural: it decides time alone, for all places
/// are asked after that).
const SOME_PLACES: usize = 16;

/// By how much the disk on the plate is turned against a photo, and how far the two differ there
/// (mean over the outer disk of the capped absolute difference, 0..=60). \[rad, levels\]
pub(crate) fn plate_turn(photo: &Rgb, plate: &Rgb, camera: &Camera, radius: f64) -> (f64, f64) {
    let mut places = Vec::new();
    for ring in 0..12 {
        let r = radius * (0.62 + 0.34 * f64::from(ring) / 11.0);
        for i in 0..180 {
            let (s, c) =
                libm::sincos(f64::from(i) * std::f64::consts::TAU / 180.0 + f64::from(ring));
            let x = Point3::new(r * c, r * s, 0.0);
            let seen = camera.project(&x).and_then(|px| sample(photo, px));
            places.extend(seen.map(|color| (x, color)));
        }
    }
    let off = |there: &Camera, (x, color): &(Point3<f64>, [f32; 3])| {
        let seen = there.project(x).and_then(|px| sample(plate, px));
        let far = seen.map_or(60.0, |s| {
            (0..3).map(|c| (s[c] - color[c]).abs()).sum::<f32>() / 3.0
        });
        f64::from(far.min(60.0))
    };
    let count = places.len().max(1) as f64;
    // What is farther than the limit before all places were asked stays so.
    let differ = |angle: f64, limit: f64| {
        let there = turned(camera, angle);
        let mut sum = 0.0;
        for some in places.chunks(SOME_PLACES) {
            sum = some.iter().fold(sum, |sum, place| sum + off(&there, place));
            if sum / count > limit {
                break;
            }
        }
        sum / count
    };
    let mut best = (0.0, differ(0.0, f64::MAX));
    let (mut middle, mut reach, mut step) = (0.0f64, 180.0f64, 0.5f64);
    for _ in 0..3 {
        let count = (reach / step).round() as i32;
        let angles = (-count..=count).map(|k| (middle + f64::from(k) * step).to_radians());
        // A few places tell which angle to begin with, so that most other angles are soon too far.
        let few = |angle: f64| {
            let there = turned(camera, angle);
            places
                .iter()
                .step_by(SOME_PLACES)
                .map(|place| off(&there, place))
                .sum::<f64>()
        };
        let reported = angles.clone().map(|angle| (few(angle), angle));
        let first = reported
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(0.0, |t| t.1);
        let limit = differ(first, f64::MAX);
        for angle in angles {
            let far = differ(angle, limit.min(best.1));
            if far < best.1 {
                best = (angle, far);
            }
        }
        (middle, reach, step) = (best.0.to_degrees(), step, step / 10.0);
    }
    best
}

/// What the photo of a camera would show without the subject.
pub(crate) fn expected(plate: &Rgb, disk: Option<(&Camera, f64, f64)>) -> Rgb {
    let mut image = plate.clone();
    let Some((camera, radius, angle)) = disk else {
        return image;
    };
    let there = turned(camera, angle);
    let top = DiskTop::of(camera, radius * RIM, [plate.width, plate.height]);
    for (x, y, hit) in top.pixels() {
        let color = there.project(&hit).and_then(|px| sample(plate, px));
        if let Some(color) = color {
            *image.at_mut(x, y) = color.map(|v| v.round().clamp(0.0, 255.0) as u8);
        }
    }
    image
}
