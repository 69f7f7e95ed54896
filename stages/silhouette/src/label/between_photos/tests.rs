//! Holes, gaps and reflections on a made turn.

use super::*;
use nalgebra::{Matrix3, Point2, Point3, Rotation3, Vector3};
use shape::{Camera, Intrinsics, Pose, Scale};

const SIZE: (usize, usize) = (240, 320);

/// A trunk on two legs, 22 mm apart, on a board. \[mm\]
fn body(x: &Point3<f64>) -> bool {
    if x.x.abs() > 112.0 || x.y.abs() > 55.0 {
        return false;
    }
    let leg = libm::hypot(x.x.abs() - 61.0, x.y) < 50.0;
    let trunk = (x.x / 112.0).powi(2) + (x.y / 55.0).powi(2) < 1.0;
    let board = x.x.abs() < 112.0 && x.y.abs() < 50.0 && (0.0..20.0).contains(&x.z);
    board || (0.0..260.0).contains(&x.z) && leg || (250.0..520.0).contains(&x.z) && trunk
}

fn camera(angle: f64) -> Camera {
    let (s, c) = libm::sincos(angle);
    let rows = Matrix3::new(c, s, 0.0, 0.0, 0.0, -1.0, -s, c, 0.0);
    Camera {
        lens: Intrinsics::simple(SIZE.0 as u32, SIZE.1 as u32, 800.0),
        pose: Pose {
            rotation: Rotation3::from_matrix_unchecked(rows),
            translation: Vector3::new(0.0, 260.0, 1600.0),
        },
    }
}

fn mask(camera: &Camera) -> Mask {
    let shows = |i: usize| {
        let at = Point2::new((i % SIZE.0) as f64, (i / SIZE.0) as f64);
        let (from, ray) = (camera.centre(), camera.ray(at).into_inner());
        (0..84).any(|k| body(&(from + ray * (1430.0 + 4.0 * f64::from(k)))))
    };
    let pixels = (0..SIZE.0 * SIZE.1).map(|i| if shows(i) { 255 } else { 0 });
    raster(SIZE.0, SIZE.1, pixels.collect())
}

/// Masks of so many photos of a turn, and their cameras.
fn turn(photos: usize) -> (Vec<(PhotoId, Mask)>, Cameras) {
    let angle = |k: usize| k as f64 * std::f64::consts::TAU / photos as f64;
    let all: Vec<Camera> = (0..photos).map(|k| camera(angle(k))).collect();
    let masks: Vec<(PhotoId, Mask)> = (0..photos as u32)
        .map(PhotoId)
        .zip(all.iter().map(mask))
        .collect();
    let view = |camera: &Camera| shape::View {
        name: String::new(),
        camera: *camera,
        sigma_mm: None,
        rms_px: None,
        points: 0,
    };
    let views = masks.iter().map(|m| m.0).zip(all.iter().map(view));
    let cameras = Cameras {
        views: views.collect(),
        scale: Scale::Given,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: vec![],
    };
    (masks, cameras)
}

/// Whether a pixel of the first photo is in a square amid the trunk.
fn amid(i: usize) -> bool {
    (110..126).contains(&(i % SIZE.0)) && (90..106).contains(&(i / SIZE.0))
}

/// Pixels of the first photo between the legs.
fn between_legs(first: &Mask) -> Vec<usize> {
    (0..first.data.len())
        .filter(|i| first.data[*i] == 0 && (117..123).contains(&(i % SIZE.0)))
        .filter(|i| (170..280).contains(&(i / SIZE.0)))
        .collect()
}

#[test]
fn a_hole_amid_the_trunk_is_body_by_all_other_photos_and_a_gap_or_a_reflection_is_not() {
    let (mut masks, cameras) = turn(18);
    let gap = between_legs(&masks[0].1);
    let reflected = |i: usize| (30..50).contains(&(i % SIZE.0)) && i / SIZE.0 >= 300;
    for i in 0..SIZE.0 * SIZE.1 {
        if amid(i) {
            masks[0].1.data[i] = 0;
        } else if reflected(i) {
            masks[0].1.data[i] = 255;
        }
    }
    let all = Together::of(&masks, &cameras).expect("a hull");
    let odds = &by_all_but_one(&all)[&PhotoId(0)];
    let share = |of: &dyn Fn(usize) -> bool, such: &dyn Fn(f32) -> bool| {
        let of: Vec<usize> = (0..odds.len()).filter(|i| of(*i)).collect();
        of.iter().filter(|i| such(odds[**i])).count() as f64 / of.len() as f64
    };
    let [hole, open, false_body] = [
        share(&amid, &|o| o > SURE),
        share(&|i| gap.contains(&i), &|o| o <= 0.0),
        share(&reflected, &|o| o < -SURE),
    ];
    assert!(
        hole > 0.9 && open > 0.9 && false_body > 0.9,
        "{hole} {open} {false_body}"
    );
}

#[test]
fn a_slot_through_the_trunk_is_a_gap_if_the_photo_from_the_other_side_shows_it_too() {
    let slot = |i: usize| (116..124).contains(&(i % SIZE.0)) && (130..170).contains(&(i / SIZE.0));
    let (whole, cameras) = turn(18);
    let of_body = |seen_by: &[usize]| {
        let mut masks = whole.clone();
        for i in (0..SIZE.0 * SIZE.1).filter(|i| slot(*i)) {
            seen_by.iter().for_each(|k| masks[*k].1.data[i] = 0);
        }
        let all = Together::of(&masks, &cameras).expect("a hull");
        let odds = &by_all_but_one(&all)[&PhotoId(0)];
        let body = (0..odds.len()).filter(|i| slot(*i) && odds[*i] > SURE);
        body.count() as f64 / (8.0 * 40.0)
    };
    let [alone, both] = [of_body(&[0]), of_body(&[0, 9])];
    assert!(alone > 0.8 && both < 0.3, "{alone} {both}");
}
