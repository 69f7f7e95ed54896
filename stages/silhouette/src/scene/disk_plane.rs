//! The plane of the disk's top: where a pixel's ray meets it; and colours between pixels.

use nalgebra::{Point2, Point3};
use shape::{Camera, Rgb};

/// The point of the disk's top that is seen at a pixel, if it is on the disk. \[mm\]
pub(crate) fn on_disk(camera: &Camera, at_px: Point2<f64>, radius: f64) -> Option<Point3<f64>> {
    let (centre, ray) = (camera.centre(), camera.ray(at_px));
    if ray.z >= -1e-6 || centre.z <= 0.0 {
        return None;
    }
    let hit = centre - ray.into_inner() * (centre.z / ray.z);
    (libm::hypot(hit.x, hit.y) < radius).then_some(hit)
}

/// A pixel between pixels, bilinear; [`None`] outside.
pub(crate) fn sample(image: &Rgb, at: Point2<f64>) -> Option<[f32; 3]> {
    let (x0, y0) = (at.x.floor(), at.y.floor());
    let inside =
        x0 >= 0.0 && y0 >= 0.0 && x0 + 1.0 < image.width as f64 && y0 + 1.0 < image.height as f64;
    if !inside {
        return None;
    }
    let (fx, fy) = ((at.x - x0) as f32, (at.y - y0) as f32);
    let (x, y) = (x0 as usize, y0 as usize);
    let mut color = [0.0; 3];
    for (c, out) in color.iter_mut().enumerate() {
        let at = |x: usize, y: usize| f32::from(image.at(x, y)[c]);
        let top = at(x, y) + fx * (at(x + 1, y) - at(x, y));
        let bottom = at(x, y + 1) + fx * (at(x + 1, y + 1) - at(x, y + 1));
        *out = top + fy * (bottom - top);
    }
    Some(color)
}
