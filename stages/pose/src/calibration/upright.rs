//! Whether the photos are upright: which way the disk's axis runs on them.

use nalgebra::{Point3, Vector3};
use shape::Cameras;

/// Which way up the photos are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Posture {
    Upright,
    OnTheirSide,
    UpsideDown,
}

/// A camera that looks down more steeply does not count. By hand: looked at five captures, halved and doubled: nothing
/// changes, for none looks down so steeply (docs/lab/numbers.md). \[rad\]
const STEEPEST_RAD: f64 = 1.2;

/// Which way up runs on most photos: to the top edge, to one of the sides, or to the bottom edge.
pub(crate) fn posture(cameras: &Cameras) -> Posture {
    let leans = cameras.views.values().filter_map(|v| lean(&v.camera));
    match shape::upper_median(leans) {
        Some(lean) if lean > 0.75 * std::f64::consts::PI => Posture::UpsideDown,
        Some(lean) if lean > 0.25 * std::f64::consts::PI => Posture::OnTheirSide,
        _ => Posture::Upright,
    }
}

/// The angle between the axis on a photo and the photo's own upward direction. \[rad\]
fn lean(camera: &shape::Camera) -> Option<f64> {
    let ahead = camera.pose.rotation.inverse() * Vector3::z();
    if ahead.z.abs() > libm::sin(STEEPEST_RAD) {
        return None;
    }
    let [foot, above] = [0.0, 1.0].map(|z| camera.pose.apply(&Point3::new(0.0, 0.0, z)));
    let run = (above.xy() / above.z) - (foot.xy() / foot.z);
    Some(libm::atan2(run.x.abs(), -run.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use shape::{Camera, Intrinsics, PhotoId, Pose, Scale, View};

    /// Six cameras that look down on the axis by so much, rolled about where they look. \[°\]
    fn turn(down: f64, roll: f64) -> Cameras {
        let view = |i: u32| {
            let about = Rotation3::from_axis_angle(&Vector3::z_axis(), f64::from(i));
            // x right, y down, z ahead: z of the world is up for a level camera.
            let tilt = Rotation3::from_euler_angles((90.0 + down).to_radians(), 0.0, 0.0);
            let rolled = Rotation3::from_axis_angle(&Vector3::z_axis(), roll.to_radians());
            let pose = Pose {
                rotation: rolled * tilt * about,
                translation: Vector3::new(0.0, 0.0, 3000.0),
            };
            let lens = Intrinsics::simple(800, 1200, 1600.0);
            let view = View::of(format!("{i}.jpg"), Camera { lens, pose });
            (PhotoId(i), view)
        };
        Cameras::of((0..6).map(view), Scale::Mat)
    }

    #[test]
    fn the_way_up_is_found_in_the_photos() {
        for down in [0.0, 10.0, 40.0] {
            for roll in [-20.0, 0.0, 30.0] {
                assert_eq!(posture(&turn(down, roll)), Posture::Upright);
                assert_eq!(posture(&turn(down, roll + 180.0)), Posture::UpsideDown);
                assert_eq!(posture(&turn(down, roll + 90.0)), Posture::OnTheirSide);
                assert_eq!(posture(&turn(down, roll - 90.0)), Posture::OnTheirSide);
            }
        }
        assert_eq!(
            posture(&turn(85.0, 180.0)),
            Posture::Upright,
            "from above nothing shows it"
        );
    }
}
