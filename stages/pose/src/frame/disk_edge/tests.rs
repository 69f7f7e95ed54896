//! A disk's edge is found on what was drawn.

use super::*;
use nalgebra::Rotation3;
use shape::{Intrinsics, Pose};

/// A camera, and what it sees where a disk of radius 210 is on a floor: levels by a place's distance from the axis, and whether that
/// is on the far side.
fn seen(level: impl Fn(f64, bool) -> f32) -> (Camera, Gray) {
    let camera = Camera {
        lens: Intrinsics::simple(400, 300, 500.0),
        pose: Pose {
            rotation: Rotation3::from_euler_angles(2.0, 0.0, 0.0),
            translation: Vector3::new(5.0, 60.0, 1000.0),
        },
    };
    let mut gray = Gray::filled(400, 300, 0.0);
    let from = camera.centre();
    for (y, x) in (0..300).flat_map(|y| (0..400).map(move |x| (y, x))) {
        let ray = camera.ray([x as f64, y as f64].into());
        let at = from + *ray * ((-40.0 - from.z) / ray.z);
        let far = is_far(&camera, 210.0, libm::atan2(at.y, at.x));
        *gray.at_mut(x, y) = level(libm::hypot(at.x, at.y), far);
    }
    (camera, gray)
}

/// A brighter disk on a dark floor.
fn lit(bright: f32) -> impl Fn(f64, bool) -> f32 {
    move |r, _| if r < 210.0 { bright } else { 60.0 }
}

#[test]
fn a_bright_disk_on_a_dark_floor_is_found() {
    let (camera, gray) = seen(lit(180.0));
    let found = disk_edge(&gray, &camera, [-150.0, 80.0], [100.0, 300.0], &|_, _| true).unwrap();
    proof::near(found.radius, 210.0, 2.0);
    proof::near(found.height, -40.0, 3.0);
}

#[test]
fn what_is_on_the_disk_within_its_edge_is_not_the_edge() {
    let floor = lit(130.0);
    let (camera, gray) = seen(|r, far| if r < 190.0 { 240.0 } else { floor(r, far) });
    let edge = |least| {
        disk_edge(&gray, &camera, [-44.0, -39.0], [100.0, 300.0], &|_, r| {
            r >= least
        })
        .unwrap()
    };
    proof::near(edge(0.0).radius, 190.0, 2.0);
    proof::near(edge(194.0).radius, 210.0, 2.0);
}

#[test]
fn where_a_wall_meets_the_floor_is_no_disk() {
    let (camera, mut gray) = seen(lit(100.0));
    let far = (0..300).find(|y| gray.at(200, *y) > 80.0).unwrap();
    for (y, x) in (0..far - 12).flat_map(|y| (0..400).map(move |x| (y, x))) {
        *gray.at_mut(x, y) = 220.0;
    }
    let found = disk_edge(&gray, &camera, [-150.0, 150.0], [60.0, 300.0], &|_, _| true).unwrap();
    proof::near(found.radius, 210.0, 3.0);
    proof::near(found.height, -40.0, 4.0);
}

#[test]
fn a_disk_may_be_brighter_than_its_own_side_and_darker_than_the_floor() {
    let (camera, gray) = seen(|r, far| match (r < 210.0, far) {
        (true, _) => 100.0,
        (false, true) => 160.0,
        (false, false) => 40.0,
    });
    let found = disk_edge(&gray, &camera, [-150.0, 80.0], [100.0, 300.0], &|_, _| true).unwrap();
    assert!(found.round);
    proof::near(found.radius, 210.0, 1.0);
    proof::near(found.height, -40.0, 1.5);
}
