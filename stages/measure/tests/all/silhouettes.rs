//! Girths from silhouettes alone, against an ellipse seen by cameras around it.

use measure::{Tangent, support_girth, tangents};
use nalgebra::Point3;
use shape::{Camera, Intrinsics, Mask};
use std::f64::consts::TAU;

const A: f64 = 160.0;
const B: f64 = 110.0;

fn ellipse(n: u32) -> Vec<Point3<f64>> {
    (0..n)
        .map(|k| libm::sincos(TAU * f64::from(k) / f64::from(n)))
        .map(|(s, c)| Point3::new(A * c, B * s, 1000.0))
        .collect()
}

fn perimeter() -> f64 {
    let points = ellipse(5000);
    (0..5000)
        .map(|i| (points[(i + 1) % 5000] - points[i]).norm())
        .sum()
}

/// A camera 2.5 m from the axis at height 1 m, looking at it, turned by an angle.
fn camera(angle: f64) -> Camera {
    let (s, c) = libm::sincos(angle);
    let eye = Point3::new(2500.0 * c, 2500.0 * s, 1000.0);
    let lens = Intrinsics::simple(600, 60, 900.0);
    Camera::looking(lens, eye, Point3::new(0.0, 0.0, 1000.0))
}

/// The silhouette of the upright elliptic cylinder: exact to a pixel's cover along its rows.
fn silhouette(camera: &Camera) -> Mask {
    let xs: Vec<f64> = ellipse(20_000)
        .iter()
        .map(|p| camera.lens.project(&camera.pose.apply(p)).unwrap().x)
        .collect();
    let (low, high) = xs
        .iter()
        .fold((f64::MAX, f64::MIN), |e, x| (e.0.min(*x), e.1.max(*x)));
    let mut mask = Mask::filled(600, 60, 0);
    for (i, c) in mask.data.iter_mut().enumerate() {
        let x = (i % 600) as f64;
        let cover = (high.min(x + 0.5) - low.max(x - 0.5)).clamp(0.0, 1.0);
        *c = (255.0 * cover).round() as u8;
    }
    mask
}

fn seen(beside: &[&[Point3<f64>]]) -> Vec<Tangent> {
    // What the surface gives is 6 mm too large: silhouettes must not believe it.
    let surface: Vec<Point3<f64>> = ellipse(720)
        .iter()
        .map(|p| Point3::new(p.x * 1.04, p.y * 1.04, p.z))
        .collect();
    (0..18)
        .flat_map(|k| {
            let camera = camera(TAU * f64::from(k) / 18.0);
            let mask = silhouette(&camera);
            tangents(
                &surface,
                beside,
                Point3::new(5.0, -3.0, 1000.0),
                &camera,
                &mask,
            )
        })
        .collect()
}

#[test]
fn eighteen_silhouettes_give_an_ellipses_girth_to_a_tenth_of_a_percent() {
    let all = seen(&[]);
    assert_eq!(all.len(), 36);
    let got = support_girth(&all, |_| 0.0, 0.0).unwrap();
    proof::near(got.girth / perimeter(), 1.0, 1e-3);
    assert!(got.sigma < 0.005 * got.girth);
}

#[test]
fn tangents_behind_an_arm_are_left_out_and_a_wide_gap_widens_the_interval() {
    let arm: Vec<Point3<f64>> = (0..60)
        .map(|k| libm::sincos(TAU * f64::from(k) / 60.0))
        .map(|(s, c)| Point3::new(230.0 + 40.0 * c, 40.0 * s, 1000.0))
        .collect();
    let some = seen(&[&arm]);
    assert!(some.len() < 36 && !some.is_empty());
    for t in &some {
        let (near, far) = arm
            .iter()
            .map(|p| {
                libm::cos(t.angle) * (p.x - 5.0) + libm::sin(t.angle) * (p.y + 3.0) - t.support
            })
            .fold((f64::MAX, f64::MIN), |e, d| (e.0.min(d), e.1.max(d)));
        assert!(near > -3.0 || far < 3.0, "{t:?} runs through the arm");
    }
    let half: Vec<Tangent> = seen(&[])
        .into_iter()
        .filter(|t| libm::cos(t.angle) > -0.3)
        .collect();
    // About a section that is 4 % too long, and about nothing.
    let base = |angle: f64| {
        let (s, c) = libm::sincos(angle);
        1.04 * libm::hypot(A * c, B * s) - 5.0 * c + 3.0 * s
    };
    let of = |tangents: &[Tangent]| support_girth(tangents, base, 1.04 * perimeter()).unwrap();
    let (whole, part) = (of(&seen(&[])), of(&half));
    assert!(part.sigma > 3.0 * whole.sigma, "{part:?} {whole:?}");
    assert!((part.girth - whole.girth).abs() < 2.0 * part.sigma);
}

#[test]
fn one_photo_that_disagrees_hardly_moves_the_girth() {
    let mut all = seen(&[]);
    all[7].support += 40.0;
    proof::near(
        support_girth(&all, |_| 0.0, 0.0).unwrap().girth / perimeter(),
        1.0,
        5e-3,
    );
}

#[test]
fn borders_that_are_wrong_on_one_side_of_the_picture_widen_the_interval_as_far_as_they_bias() {
    let mut all = seen(&[]);
    let before = support_girth(&all, |_| 0.0, 0.0).unwrap();
    all.iter_mut()
        .filter(|t| t.is_left)
        .for_each(|t| t.support -= 10.0);
    let after = support_girth(&all, |_| 0.0, 0.0).unwrap();
    proof::near(before.girth - after.girth, TAU * 5.0, 0.5);
    assert!(
        (after.sigma - TAU * 5.0).abs() < 3.0 + before.sigma,
        "{after:?}"
    );
}
