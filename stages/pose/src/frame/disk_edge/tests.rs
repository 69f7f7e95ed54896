//! A disk's edge is found on what was drawn.

use super::*;
use crate::frame::disk_exact::is_far;
use nalgebra::Rotation3;
use shape::{Intrinsics, Pose};

/// A camera, and what it sees where a disk of radius 210 is on a floor: levels by a place's distance from the axis, and whether that
/// is on the far side.
fn seen(level: impl Fn(f64, bool) -> u8) -> (Camera, Rgb) {
    aside_of_the_axis(0.0, level)
}

/// The same of a disk whose middle is so far beside the axis, across the view.
fn aside_of_the_axis(x: f64, level: impl Fn(f64, bool) -> u8) -> (Camera, Rgb) {
    let camera = Camera {
        lens: Intrinsics::simple(400, 300, 500.0),
        pose: Pose {
            rotation: Rotation3::from_euler_angles(2.0, 0.0, 0.0),
            translation: Vector3::new(5.0, 60.0, 1000.0),
        },
    };
    let mut picture = Rgb::filled(400, 300, [0; 3]);
    let from = camera.centre();
    for (row, column) in (0..300).flat_map(|y| (0..400).map(move |x| (y, x))) {
        let ray = camera.ray([column as f64, row as f64].into());
        let at = from + *ray * ((-40.0 - from.z) / ray.z) - Vector3::x() * x;
        let far = is_far(&camera, 210.0, libm::atan2(at.y, at.x));
        *picture.at_mut(column, row) = [level(libm::hypot(at.x, at.y), far); 3];
    }
    (camera, picture)
}

/// A brighter disk on a dark floor.
fn lit(bright: u8) -> impl Fn(f64, bool) -> u8 {
    move |r, _| if r < 210.0 { bright } else { 60 }
}

/// The edge that is found anywhere near the disk.
fn found_in(picture: &Rgb, camera: &Camera) -> DiskEdge {
    let (heights, radii) = ([-150.0, 80.0], [100.0, 300.0]);
    disk_edge(picture, camera, heights, radii, &|_, _| true).unwrap()
}

#[test]
fn a_bright_disk_on_a_dark_floor_is_found() {
    let (camera, picture) = seen(lit(180));
    let found = found_in(&picture, &camera);
    proof::near(found.radius, 210.0, 2.0);
    proof::near(found.height, -40.0, 3.0);
}

#[test]
fn what_is_on_the_disk_within_its_edge_is_not_the_edge() {
    let floor = lit(130);
    let (camera, picture) = seen(|r, far| if r < 190.0 { 240 } else { floor(r, far) });
    let edge = |least| {
        disk_edge(
            &picture,
            &camera,
            [-44.0, -39.0],
            [100.0, 300.0],
            &|_, r| r >= least,
        )
        .unwrap()
    };
    proof::near(edge(0.0).radius, 190.0, 2.0);
    proof::near(edge(194.0).radius, 210.0, 2.0);
}

#[test]
fn where_a_wall_meets_the_floor_is_no_disk() {
    let (camera, mut picture) = seen(lit(100));
    let far = (0..300).find(|y| picture.at(200, *y)[0] > 80).unwrap();
    for (y, x) in (0..far - 12).flat_map(|y| (0..400).map(move |x| (y, x))) {
        *picture.at_mut(x, y) = [220; 3];
    }
    let found = disk_edge(
        &picture,
        &camera,
        [-150.0, 150.0],
        [60.0, 300.0],
        &|_, _| true,
    )
    .unwrap();
    proof::near(found.radius, 210.0, 3.0);
    proof::near(found.height, -40.0, 4.0);
}

#[test]
fn a_disk_may_be_brighter_than_its_own_side_and_darker_than_the_floor() {
    let (camera, picture) = seen(|r, far| match (r < 210.0, far) {
        (true, _) => 100,
        (false, true) => 160,
        (false, false) => 40,
    });
    let found = found_in(&picture, &camera);
    proof::near(found.radius, 210.0, 1.0);
    proof::near(found.height, -40.0, 1.5);
}

#[test]
fn a_disk_whose_front_is_beyond_the_photo_is_found() {
    let (mut camera, picture) = seen(lit(180));
    let front = camera
        .project(&Point3::new(0.0, -210.0, -40.0))
        .unwrap_or_default();
    let rows = (front.y - 8.0) as usize;
    let mut cut = Rgb::filled(400, rows, [0; 3]);
    cut.data.copy_from_slice(&picture.data[..400 * rows]);
    camera.lens.height = rows as u32;
    let found = found_in(&cut, &camera);
    proof::near(found.radius, 210.0, 2.0);
    proof::near(found.height, -40.0, 3.0);
}

#[test]
fn planks_are_no_disk() {
    // Brighter and darker planks of 30 and 70.
    let (camera, picture) = seen(|_, _| 60);
    let from = camera.centre();
    let planks = |x: usize, y: usize| {
        let ray = camera.ray([x as f64, y as f64].into());
        let at = from + *ray * ((-40.0 - from.z) / ray.z);
        let plank = (at.y / 30.0).floor() * 7.0 + (at.x / 70.0).floor();
        (110.0 + 60.0 * libm::sin(plank * plank)) as u8
    };
    let mut floor = picture.clone();
    for (y, x) in (0..300).flat_map(|y| (0..400).map(move |x| (y, x))) {
        *floor.at_mut(x, y) = [planks(x, y); 3];
    }
    let found = disk_edge(&floor, &camera, [-150.0, 80.0], [60.0, 300.0], &|_, _| true);
    let standout = found.map_or(0.0, |f| f.standout);
    assert!(standout < 0.3, "{found:?}");
}

#[test]
fn a_disk_beside_the_axis_is_as_wide() {
    for aside in [-8.0, 8.0] {
        let (camera, picture) = aside_of_the_axis(aside, lit(180));
        let found = found_in(&picture, &camera);
        proof::near(found.radius, 210.0, 1.0);
        proof::near(found.height, -40.0, 1.5);
    }
}
