//! The cameras around the subject, from above and from the side (paper, Fig. 2 a and b).

use crate::{Camera, Cameras, bounding_cylinder};
use nalgebra::{Point2, Point3};
use std::fmt::Write;

/// An SVG of the ring: every camera with its field of view, the disk, and the cylinder about the axis that all of them have in view, if
/// there is one.
pub fn cameras_to_svg(cameras: &Cameras) -> String {
    let centres: Vec<(String, Point3<f64>)> = cameras
        .views
        .iter()
        .map(|(id, v)| (id.0.to_string(), v.camera.centre()))
        .collect();
    let reach = centres
        .iter()
        .map(|(_, c)| libm::hypot(c.x, c.y).max(c.z.abs()))
        .fold(1.0, f64::max)
        * 1.12;
    let seen = bounding_cylinder(cameras).map(|c| [c.radius, c.bottom, c.top]);
    let [radius, low, high] = seen.unwrap_or_default();
    let disk = cameras.disk_radius_mm.unwrap_or(reach * 0.1);
    let mut svg = String::from(
        "<svg class=\"ring\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 840 420\" role=\"img\" \
         aria-label=\"cameras around the subject, from above and from the side\">\
         <style>.ring text{font:12px sans-serif;fill:#888}.ring .disk{fill:#8883;stroke:#888}\
         .ring .ray{stroke:#2a7fff;stroke-width:.6;opacity:.55}.ring .cam{fill:#2a7fff}\
         .ring .cam.on{fill:#ff5a00;r:7px}.ring .cyl{fill:none;stroke:#e07b00}\
         .ring .path{fill:none;stroke:#2a7fff;stroke-dasharray:3 3;opacity:.6}</style>",
    );
    let scale = 190.0 / reach;
    for (panel, side) in [(0.0, false), (420.0, true)] {
        let map = |p: &Point3<f64>| {
            let up = if side { p.z - (low + high) / 2.0 } else { p.y };
            (panel + 210.0 + p.x * scale, 205.0 - up * scale)
        };
        let at = map(&Point3::new(0.0, 0.0, 0.0));
        let [disk, radius, low, high] = [disk, radius, low, high].map(|mm| mm * scale);
        match side {
            true => from_the_side(&mut svg, at, disk, radius, [low, high]),
            false => from_above(&mut svg, at, disk, radius),
        }
        let mut path = String::new();
        for ((label, centre), view) in centres.iter().zip(cameras.views.values()) {
            let (x, y) = map(centre);
            let _ = write!(path, "{x:.1},{y:.1} ");
            for end in field_of_view(&view.camera, reach * 0.22) {
                let (ex, ey) = map(&end);
                let _ = write!(
                    svg,
                    "<line class=\"ray\" x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{ex:.1}\" y2=\"{ey:.1}\"/>"
                );
            }
            let _ = write!(
                svg,
                "<circle class=\"cam\" data-photo=\"{label}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\"/>"
            );
            // From the side they would cover one another.
            if !side {
                let _ = write!(
                    svg,
                    "<text x=\"{:.1}\" y=\"{:.1}\">{label}</text>",
                    x + 5.0,
                    y - 4.0
                );
            }
        }
        let caption = if side { "from the side" } else { "from above" };
        let _ = write!(
            svg,
            "<polyline class=\"path\" points=\"{path}\"/><text x=\"{}\" y=\"414\">{caption}</text>",
            panel + 12.0
        );
    }
    svg + "</svg>"
}

/// Disk and cylinder from the side, in the drawing's units.
fn from_the_side(svg: &mut String, (x, y): (f64, f64), disk: f64, radius: f64, z: [f64; 2]) {
    let [low, high] = z;
    let _ = write!(
        svg,
        "<rect class=\"disk\" x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"4\"/>\
         <rect class=\"cyl\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
        x - disk,
        2.0 * disk,
        x - radius,
        y - high,
        2.0 * radius,
        high - low,
    );
}

/// Disk and cylinder from above.
fn from_above(svg: &mut String, (x, y): (f64, f64), disk: f64, radius: f64) {
    let _ = write!(
        svg,
        "<circle class=\"disk\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{disk:.1}\"/>\
         <circle class=\"cyl\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
    );
}

/// The ends of a camera's view at its photo's four corners. \[mm\]
fn field_of_view(camera: &Camera, length: f64) -> [Point3<f64>; 4] {
    let (w, h) = (f64::from(camera.lens.width), f64::from(camera.lens.height));
    [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)]
        .map(|(x, y)| camera.centre() + camera.ray(Point2::new(x, y)).into_inner() * length)
}
