//! A rectangle around the subject: checked, nothing beyond it is body, and colours alone cut within it.

use proof::Dice;
use shape::{Image, Mask, Photo, Photos, Rgb, rgb_to_png};
use silhouette::{GrabCut, GrabCutInput, GrabCutParams, Known, Rectangle};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

/// A background of two shades, a body of two other ones, and far from it a ball of the body's colour.
fn photo(dice: &mut Dice) -> (Rgb, Image<bool>) {
    let (w, h) = (240, 320);
    let body = |i: usize| {
        let (x, y) = ((i % w) as f64 - 100.0, (i / w) as f64 - 170.0);
        (x / 50.0).powi(2) + (y / 110.0).powi(2) < 1.0
    };
    let ball = |i: usize| libm::hypot((i % w) as f64 - 215.0, (i / w) as f64 - 40.0) < 18.0;
    let mut photo = Rgb::filled(w, h, [0; 3]);
    for (i, p) in photo.data.iter_mut().enumerate() {
        let shown = match (body(i), ball(i)) {
            (true, _) if i / w < 150 => [206.0, 150.0, 118.0],
            (true, _) | (_, true) => [60.0, 70.0, 160.0],
            _ if i / w < 220 => [170.0, 172.0, 168.0],
            _ => [110.0, 90.0, 70.0],
        };
        *p = shown.map(|v| (v + 2.0 * dice.normal()).round() as u8);
    }
    let data = (0..w * h).map(body).collect();
    let truth = Image {
        width: w,
        height: h,
        data,
    };
    (photo, truth)
}

/// What the stage makes of one photo without plate and cameras.
fn masked(photo: &Rgb, box_px: Vec<f64>) -> Result<Mask, String> {
    let most_mpx = GrabCutParams::default().most_mpx;
    masked_within(most_mpx, photo, box_px)
}

/// The same where it is looked at with so many million pixels at most.
fn masked_within(most_mpx: f64, photo: &Rgb, box_px: Vec<f64>) -> Result<Mask, String> {
    let photo = Photo::of(
        "0000.png",
        [photo.width as u32, photo.height as u32],
        rgb_to_png(photo),
    );
    let photos = Photos {
        photos: vec![photo],
        ..Photos::default()
    };
    let input = GrabCutInput {
        photos: Arc::new(photos),
        cameras: None,
        people: None,
    };
    let params = GrabCutParams {
        most_mpx,
        box_px,
        ..Default::default()
    };
    match GrabCut::run(&params, input, &Ctx::alone()) {
        Ok(masks) => Ok(masks.views.values().next().expect("a mask").pixels()),
        Err(Stop::Failed(why)) => Err(why.to_string()),
        Err(Stop::Cancelled) => Err("cancelled".into()),
    }
}

#[test]
fn a_rectangle_alone_is_enough_where_colours_differ() {
    let (photo, truth) = photo(&mut Dice(1));
    let mask = masked(&photo, vec![40.0, 45.0, 165.0, 295.0]).unwrap();
    assert!(overlap(&mask, &truth) > 0.97, "{}", overlap(&mask, &truth));
    // The ball is of the body's colour, but beyond the rectangle.
    assert_eq!(mask.at(215, 40), 0);
}

/// Intersection over union.
fn overlap(mask: &Mask, truth: &Image<bool>) -> f64 {
    let pairs = || mask.data.iter().map(|m| *m > 127).zip(&truth.data);
    let both = pairs().filter(|(a, b)| *a && **b).count() as f64;
    both / pairs().filter(|(a, b)| *a || **b).count() as f64
}

#[test]
fn a_photo_that_is_looked_at_smaller_has_a_mask_of_its_own_size() {
    let (photo, truth) = photo(&mut Dice(1));
    // Of 240 × 320 pixels, 158 × 210.
    let mask = masked_within(0.0333, &photo, vec![40.0, 45.0, 165.0, 295.0]).unwrap();
    assert_eq!((mask.width, mask.height), (240, 320));
    assert!(overlap(&mask, &truth) > 0.97, "{}", overlap(&mask, &truth));
    assert_eq!(mask.at(215, 40), 0);
}

#[test]
fn without_a_rectangle_a_photo_alone_reports_what_is_missing() {
    let (photo, _) = photo(&mut Dice(1));
    let stated = masked(&photo, vec![]).unwrap_err();
    assert!(
        stated.contains("plate") && stated.contains("box_px"),
        "{stated}"
    );
}

#[test]
fn a_rectangle_that_is_none_is_refused() {
    let (photo, _) = photo(&mut Dice(1));
    for (stated, what) in [
        (vec![1.0, 2.0, 3.0], "has 3 numbers"),
        (
            vec![90.0, 10.0, 20.0, 200.0],
            "no part of a photo of 240×320",
        ),
        (
            vec![300.0, 10.0, 400.0, 200.0],
            "no part of a photo of 240×320",
        ),
        (vec![0.0, 0.0, 240.0, 320.0], "left over around it"),
    ] {
        let reported = masked(&photo, stated.clone()).unwrap_err();
        assert!(reported.contains(what), "{stated:?}: {reported}");
    }
}

#[test]
fn nothing_beyond_a_rectangle_is_body() {
    let rectangle = Rectangle::read(&[10.0, 20.0, 30.0, 40.0], 100, 100).unwrap();
    let mut known = vec![Known::Unknown; 50 * 50];
    rectangle.unwrap().close(&mut known, 50, 2);
    let open = |i: &usize| known[*i] == Known::Unknown;
    let all: Vec<usize> = (0..2500).filter(open).collect();
    assert_eq!(all.len(), 10 * 10);
    assert!(
        all.iter()
            .all(|i| (5..15).contains(&(i % 50)) && (10..20).contains(&(i / 50)))
    );
}
