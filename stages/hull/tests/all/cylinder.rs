//! Carving from true silhouettes of a cylinder: its girth is that of the polygon which the views'
//! tangents form, and the circle's as views are many.

use hull::{Carve, CarveInput, CarveParams};
use nalgebra::{Point2, Point3};
use shape::{Camera, Cameras, Intrinsics, Mask, PhotoId, Scale, View};
use stage::{Ctx, Stage};
use std::f64::consts::TAU;
use std::sync::Arc;

const RADIUS: f64 = 150.0;
const AWAY: f64 = 2500.0;

/// A camera at an angle around the axis, level with the cylinder's middle.
fn camera(angle: f64) -> Camera {
    let lens = Intrinsics::simple(400, 60, 900.0);
    let (s, c) = libm::sincos(angle);
    let from = Point3::new(AWAY * c, AWAY * s, 80.0);
    Camera::looking(lens, from, Point3::new(0.0, 0.0, 80.0))
}

/// How much of each pixel an upright cylinder around the axis covers, by the distance of its rays.
fn silhouette(camera: &Camera) -> Mask {
    let mut mask = Mask::filled(400, 60, 0);
    let centre = camera.centre();
    let size = AWAY / camera.lens.focal[0];
    for (i, c) in mask.data.iter_mut().enumerate() {
        let ray = camera.ray(Point2::new((i % 400) as f64, (i / 400) as f64));
        let (dx, dy) = (-centre.x, -centre.y);
        let beside = (dx * ray.y - dy * ray.x).abs() / libm::hypot(ray.x, ray.y);
        *c = ((0.5 + (RADIUS - beside) / size).clamp(0.0, 1.0) * 255.0).round() as u8;
    }
    mask
}

/// The hull of the cylinder from views all around, with masks edited.
fn carved(views: usize, consensus: f64, edit: impl Fn(usize, &mut Mask)) -> shape::Mesh {
    let all: Vec<Camera> = (0..views)
        .map(|k| camera(k as f64 * TAU / views as f64))
        .collect();
    let id = |k: usize| PhotoId(k as u32);
    let view = |camera: &Camera| View::of(String::new(), *camera);
    let cameras = Cameras::of(
        all.iter().enumerate().map(|(k, c)| (id(k), view(c))),
        Scale::Given,
    );
    let mask = |(k, c): (usize, &Camera)| {
        let mut mask = silhouette(c);
        edit(k, &mut mask);
        (id(k), mask)
    };
    let masks = all.iter().enumerate().map(mask);
    let input = CarveInput {
        masks: Arc::new(masks.collect()),
        cameras: Arc::new(cameras),
    };
    let params = CarveParams {
        voxel_mm: 2.0,
        consensus,
        ..Default::default()
    };
    Carve::run(&params, input, &Ctx::alone()).unwrap()
}

/// Length of the section at a height.
fn girth(mesh: &shape::Mesh, z: f64) -> f64 {
    let mut length = 0.0;
    for face in 0..mesh.faces.len() {
        let corners: [Point3<f64>; 3] = mesh.triangle(face);
        let mut ends = Vec::new();
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if (a.z < z) != (b.z < z) {
                ends.push(a + (b - a) * ((z - a.z) / (b.z - a.z)));
            }
        }
        if let [a, b] = ends[..] {
            length += (b - a).norm();
        }
    }
    length
}

/// Circumference of the polygon that the views' tangents form around a circle.
fn polygon(views: usize) -> f64 {
    let lean = libm::acos(RADIUS / AWAY);
    let mut touch: Vec<f64> = (0..views)
        .flat_map(|k| [lean, -lean].map(|l| (k as f64 * TAU / views as f64 + l).rem_euclid(TAU)))
        .collect();
    touch.sort_by(f64::total_cmp);
    let n = touch.len();
    let gaps = (0..n).map(|i| (touch[(i + 1) % n] - touch[i]).rem_euclid(TAU));
    gaps.map(|gap| 2.0 * RADIUS * libm::tan(gap / 2.0)).sum()
}

#[test]
fn a_cylinders_girth_is_within_three_in_a_thousand_at_two_millimetres() {
    let circle = TAU * RADIUS;
    let many = girth(&carved(36, 1.0, |_, _| ()), 81.0);
    proof::near(many / circle, 1.0, 0.003);
    // Eighteen views form a polygon, and nothing but the polygon makes the hull longer.
    let few = girth(&carved(18, 1.0, |_, _| ()), 81.0);
    proof::near(few / polygon(18), 1.0, 0.001);
    assert!(polygon(18) / circle > 1.002);
}

#[test]
fn a_hole_in_one_mask_goes_through_unless_one_view_may_dissent() {
    let hole = |k: usize, mask: &mut Mask| {
        for y in 20..40 {
            (185..215)
                .filter(|_| k == 4)
                .for_each(|x| *mask.at_mut(x, y) = 0);
        }
    };
    let strict = carved(18, 1.0, hole).volume();
    let lenient = carved(18, 0.94, hole).volume();
    let whole = carved(18, 1.0, |_, _| ()).volume();
    assert!(strict < 0.99 * whole, "{strict} of {whole}");
    assert!(
        lenient > whole && lenient < 1.06 * whole,
        "{lenient} of {whole}"
    );
}
