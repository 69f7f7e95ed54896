//! What carving answers to impossible masks, cameras and cells: a sentence, never a panic.

use hull::{Carve, CarveInput, CarveParams};
use nalgebra::Point3;
use shape::{Camera, Cameras, Intrinsics, Mask, Masks, PhotoId, Scale, View};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

/// Cameras 2 m from the axis, looking at it or away from it, and masks that show a body.
fn turn(away: bool) -> (Masks, Cameras) {
    let one = |k: u32| {
        let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 8.0);
        let lens = Intrinsics::simple(80, 120, 150.0);
        let from = Point3::new(2000.0 * c, 2000.0 * s, 500.0);
        let to = if away { 2.0 } else { 0.0 };
        let at = Point3::new(to * from.x, to * from.y, 500.0);
        let camera = Camera::looking(lens, from, at);
        let name = format!("{k:04}.jpg");
        (PhotoId(k), View::of(name, camera))
    };
    let cameras = Cameras::of((0..8).map(one), Scale::Given);
    let mut mask = Mask::filled(80, 120, 0);
    for y in 20..90 {
        (30..50).for_each(|x| *mask.at_mut(x, y) = 255);
    }
    let masks = (0..8).map(|k| (PhotoId(k), &mask));
    (masks.collect(), cameras)
}

/// The error for a turn whose mask 3 is another one.
#[track_caller]
fn refusal(masks: Masks, cameras: Cameras, voxel_mm: f64) -> String {
    let params = CarveParams {
        voxel_mm,
        ..Default::default()
    };
    let input = CarveInput {
        masks: Arc::new(masks),
        cameras: Arc::new(cameras),
    };
    match Carve::run(&params, input, &Ctx::alone()) {
        Err(Stop::Failed(why)) => why.to_string(),
        Err(Stop::Cancelled) => panic!("cancelled"),
        Ok(mesh) => panic!("a hull of {} faces", mesh.faces.len()),
    }
}

/// The masks of a turn, that of photo 3 replaced.
fn with(mask: Mask) -> (Masks, Cameras) {
    let (mut masks, cameras) = turn(false);
    *masks.views.get_mut(PhotoId(3)).unwrap() = mask.into();
    (masks, cameras)
}

#[test]
fn masks_that_are_empty_full_inverted_or_of_another_size_are_named() {
    // Around a small body an inverted mask is nearly full.
    let mut small = Mask::filled(80, 120, 255);
    (40..44).for_each(|x| *small.at_mut(x, 60) = 0);
    let cases = [
        (Mask::filled(80, 120, 0), "empty"),
        (Mask::filled(80, 120, 255), "full, or inverted"),
        (small, "full, or inverted"),
        (Mask::filled(40, 60, 0), "empty"),
    ];
    for (mask, what) in cases {
        let (masks, cameras) = with(mask);
        let error = refusal(masks, cameras, 10.0);
        assert!(
            error.contains("0003.jpg") && error.contains(what),
            "{error}"
        );
    }
    let mut half = Mask::filled(40, 60, 0);
    (10..30).for_each(|x| *half.at_mut(x, 30) = 255);
    let (masks, cameras) = with(half);
    let error = refusal(masks, cameras, 10.0);
    assert!(
        error.contains("0003.jpg") && error.contains("another size"),
        "{error}"
    );
}

#[test]
fn an_inverted_mask_is_named_however_large_the_body_is() {
    let (good, _) = turn(false);
    let inverted = good.views.get(PhotoId(3)).unwrap();
    let inverted = inverted.pixels().map(|c| 255 - c);
    let (masks, cameras) = with(inverted);
    let error = refusal(masks, cameras, 10.0);
    assert!(
        error.contains("0003.jpg") && error.contains("inverted"),
        "{error}"
    );
}

#[test]
fn fewer_than_three_masks_with_a_camera_are_counted() {
    let (masks, cameras) = turn(false);
    let few = masks.views.iter().filter(|(id, _)| id.0 < 2);
    let few = few.map(|(id, m)| (id, m.clone()));
    let error = refusal(few.collect(), cameras, 10.0);
    assert!(
        error.contains("only 2 photos") && error.contains("at least 3"),
        "{error}"
    );
}

#[test]
fn missing_masks_of_some_views_are_passed_over() {
    let (masks, cameras) = turn(false);
    let some = masks.views.iter().filter(|(id, _)| id.0 != 3);
    let some = some.map(|(id, m)| (id, m.clone()));
    let input = CarveInput {
        masks: Arc::new(some.collect()),
        cameras: Arc::new(cameras),
    };
    let params = CarveParams {
        voxel_mm: 20.0,
        ..Default::default()
    };
    assert!(Carve::run(&params, input, &Ctx::alone()).unwrap().volume() > 1e6);
}

#[test]
fn cameras_that_see_nothing_together_are_refused() {
    let (masks, cameras) = turn(true);
    let error = refusal(masks, cameras, 10.0);
    assert!(
        error.contains("do masks and cameras belong together"),
        "{error}"
    );
}

#[test]
fn cells_that_need_more_memory_than_may_be_taken_are_refused_with_a_size_that_fits() {
    let (masks, cameras) = turn(false);
    let error = refusal(masks.clone(), cameras.clone(), 0.25);
    let before = |unit: &str, after: &str| -> f64 {
        let rest = &error[error.find(after).unwrap() + after.len()..];
        rest[..rest.find(unit).unwrap()].trim().parse().unwrap()
    };
    let (need, fits) = (before("MB", "about"), before("mm fits", "taken:"));
    assert!(need > 3000.0 && fits > 0.25, "{error}");
    // And what is named to fit does.
    let params = CarveParams {
        voxel_mm: 1.0,
        memory_mb: 64.0,
        ..Default::default()
    };
    let (masks, cameras) = (Arc::new(masks), Arc::new(cameras));
    let run = |params: &CarveParams| {
        let input = CarveInput {
            masks: masks.clone(),
            cameras: cameras.clone(),
        };
        Carve::run(params, input, &Ctx::alone())
    };
    let Err(Stop::Failed(why)) = run(&params) else {
        panic!("1 mm fits in 64 MB")
    };
    let error = why.to_string();
    let rest = &error[error.find("taken:").unwrap() + 6..];
    let fits: f64 = rest[..rest.find("mm fits").unwrap()]
        .trim()
        .parse()
        .unwrap();
    let params = CarveParams {
        voxel_mm: fits,
        ..params
    };
    assert!(run(&params).is_ok(), "{fits} mm");
}

/// Three photos from one place see a cone without an end: it is cut off, and closed.
#[test]
fn a_hull_without_an_end_is_closed_all_the_same() {
    let (masks, cameras) = turn(false);
    let first = cameras.views.get(PhotoId(0)).unwrap().clone();
    let views = (0..3).map(|k| (PhotoId(k), first.clone())).collect();
    let params = CarveParams {
        voxel_mm: 20.0,
        ..CarveParams::default()
    };
    let input = CarveInput {
        masks: Arc::new(masks),
        cameras: Arc::new(Cameras { views, ..cameras }),
    };
    let mesh = Carve::run(&params, input, &Ctx::alone()).unwrap();
    assert_eq!(mesh.validate_closed(), Ok(()));
    assert!(mesh.volume() > 0.0);
}

#[test]
fn a_photo_that_leaves_nothing_of_what_all_other_photos_show_is_named() {
    // A speck in the corner: no empty mask, but nothing that the other photos see.
    let mut speck = Mask::filled(80, 120, 0);
    (2..8).for_each(|x| *speck.at_mut(x, 4) = 255);
    let (masks, cameras) = with(speck);
    let error = refusal(masks, cameras, 10.0);
    assert!(
        error.contains("the outline on 0003.jpg cuts away up to 100 %"),
        "{error}"
    );
}
