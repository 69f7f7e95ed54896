//! Where one turntable frame is in another: both have z along the axis, x may be anywhere.

use nalgebra::{Rotation3, Vector3};
use shape::Cameras;

/// The turn about z from one turntable frame to another, by the centres of cameras that are in both.
pub fn turn_between(from: &Cameras, to: &Cameras) -> Rotation3<f64> {
    let (mut sin, mut cos) = (0.0, 0.0);
    for (_, a, b) in from.views.join(&to.views) {
        let (a, b) = (a.camera.centre(), b.camera.centre());
        cos += a.x * b.x + a.y * b.y;
        sin += a.x * b.y - a.y * b.x;
    }
    let angle = if sin == 0.0 && cos == 0.0 {
        0.0
    } else {
        libm::atan2(sin, cos)
    };
    Rotation3::from_axis_angle(&Vector3::z_axis(), angle)
}
