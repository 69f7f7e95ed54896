//! The cylinder that is drawn among the cameras.

use nalgebra::Point2;
use shape::{Cameras, Cylinder};

/// The cylinder around the axis that every camera sees whole.
pub(crate) fn bounding_cylinder(cameras: &Cameras) -> Cylinder {
    let (mut radius, mut low, mut high) = (f64::MAX, f64::MIN, f64::MAX);
    for view in cameras.views.values() {
        let camera = &view.camera;
        let centre = camera.centre();
        let away = libm::hypot(centre.x, centre.y);
        let (w, h) = (f64::from(camera.lens.width), f64::from(camera.lens.height));
        let slope = (w / 2.0) / camera.lens.focal[0];
        radius = radius.min(away * slope / (1.0 + slope * slope).sqrt());
        let at_axis = |y: f64| {
            let ray = camera.ray(Point2::new(w / 2.0, y));
            centre.z + ray.z * away / libm::hypot(ray.x, ray.y).max(1e-9)
        };
        (low, high) = (low.max(at_axis(h)), high.min(at_axis(0.0)));
    }
    let (radius, bottom, top) = match radius < f64::MAX && low < high {
        true => (radius, low, high),
        false => (1.0, 0.0, 1.0),
    };
    Cylinder {
        radius,
        bottom,
        top,
    }
}
