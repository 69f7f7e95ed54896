//! The cameras around the subject as a drawing.

use nalgebra::{Point3, Vector3};
use shape::{Cameras, Cylinder, Unit, View, bounding_cylinder};
use std::fmt::Write;

/// The cameras around the subject, seen from above at a slant: their path, where each looks, the
/// disk, the cylinder that all of them have in view, and the points that hold them (the paper's Fig. 2).
pub fn cameras_to_svg(cameras: &Cameras) -> String {
    let centres: Vec<Point3<f64>> = cameras.views.values().map(|v| v.camera.centre()).collect();
    let far = |c: &Point3<f64>| libm::hypot(c.x, c.y);
    let radius = centres.iter().map(far).fold(1.0f64, f64::max);
    let (sin, cos) = libm::sincos(35f64.to_radians());
    let slant = Slant {
        sin,
        cos,
        unit: 260.0 / radius,
    };
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-320 -330 640 600\" font-family=\"sans-serif\" font-size=\"11\">\n<rect x=\"-320\" y=\"-330\" width=\"640\" height=\"600\" fill=\"white\"/>\n",
    );
    points(&mut svg, cameras, &slant);
    if let Some(disk) = cameras.disk_radius_mm {
        let rim = |i: i32| {
            let (s, c) = libm::sincos(angle(i));
            Point3::new(disk * c, disk * s, 0.0)
        };
        let rim: Vec<_> = (0..72).map(rim).collect();
        let line = slant.path(&rim);
        let _ = writeln!(
            svg,
            "<polygon points=\"{line}\" fill=\"none\" stroke=\"#b80\"/>"
        );
    }
    if let Some(cylinder) = bounding_cylinder(cameras) {
        in_view(&mut svg, &cylinder, cameras.scale.unit(), &slant);
    }
    let line = slant.path(&centres);
    let _ = writeln!(
        svg,
        "<polyline points=\"{line}\" fill=\"none\" stroke=\"#bbb\" stroke-dasharray=\"3 3\"/>"
    );
    for view in cameras.views.values() {
        pyramid(&mut svg, view, 0.12 * radius, &slant);
    }
    svg.push_str("</svg>\n");
    svg
}

/// Steps of 5° as an angle. \[rad\]
fn angle(step: i32) -> f64 {
    f64::from(step) * 5f64.to_radians()
}

/// A view along -y and down by 35°.
struct Slant {
    sin: f64,
    cos: f64,
    unit: f64,
}

impl Slant {
    fn flat(&self, p: &Point3<f64>) -> [f64; 2] {
        [
            p.x * self.unit,
            -(p.y * self.sin + p.z * self.cos) * self.unit,
        ]
    }

    fn path(&self, points: &[Point3<f64>]) -> String {
        let one = |p: &Point3<f64>| {
            let [x, y] = self.flat(p);
            format!("{x:.1},{y:.1} ")
        };
        points.iter().map(one).collect()
    }
}

/// The points that hold the cameras, 3000 at most.
fn points(svg: &mut String, cameras: &Cameras, slant: &Slant) {
    svg.push_str("<g fill=\"#888\">\n");
    let every = cameras.points.len().div_ceil(3000).max(1);
    for p in cameras.points.iter().step_by(every) {
        let [x, y] = slant.flat(&Point3::from(p.map(f64::from)));
        if libm::hypot(x, y) < 900.0 {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"0.8\"/>");
        }
    }
    svg.push_str("</g>\n");
}

/// The cylinder that all cameras have in view, with its outline as seen from here.
fn in_view(svg: &mut String, cylinder: &Cylinder, unit: Unit, slant: &Slant) {
    for share in [0.0, 1.0] {
        let rim: Vec<_> = (0..72).map(|i| cylinder.point(angle(i), share)).collect();
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"#d43\" fill-opacity=\"0.13\" stroke=\"#c33\"/>",
            slant.path(&rim)
        );
    }
    for i in [0, 36] {
        let side = [0.0, 1.0].map(|share| cylinder.point(angle(i), share));
        let line = slant.path(&side);
        let _ = writeln!(svg, "<polyline points=\"{line}\" stroke=\"#c33\"/>");
    }
    let unit = match unit {
        Unit::Metric => " mm",
        Unit::Relative => " of a ring of 1000",
    };
    let _ = writeln!(
        svg,
        "<text x=\"-310\" y=\"-312\" fill=\"#c33\">in view of all cameras: radius {:.0}{unit}, height {:.0} to {:.0}{unit}</text>",
        cylinder.radius, cylinder.bottom, cylinder.top
    );
}

/// A camera as a pyramid of this height, with its photo's name. \[mm\]
fn pyramid(svg: &mut String, view: &View, height: f64, slant: &Slant) {
    let (lens, centre) = (&view.camera.lens, view.camera.centre());
    let corner = |x: f64, y: f64| {
        let ray = Vector3::new(
            (x * f64::from(lens.width) - lens.centre[0]) / lens.focal[0],
            (y * f64::from(lens.height) - lens.centre[1]) / lens.focal[1],
            1.0,
        );
        centre + view.camera.pose.rotation.inverse() * ray * height
    };
    let frame = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| corner(x, y));
    let _ = writeln!(
        svg,
        "<polygon points=\"{}\" fill=\"#7ac\" fill-opacity=\"0.27\" stroke=\"#27a\"/>",
        slant.path(&frame)
    );
    for c in &frame {
        let line = slant.path(&[centre, *c]);
        let _ = writeln!(svg, "<polyline points=\"{line}\" stroke=\"#27a\"/>");
    }
    let [x, y] = slant.flat(&centre);
    let name = view.name.replace('&', "&amp;").replace('<', "&lt;");
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
        x + 4.0,
        y - 4.0
    );
}
