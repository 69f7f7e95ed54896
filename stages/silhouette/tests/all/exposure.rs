//! A plate that is brighter, darker or of another white than the photos serves all the same.

use proof::Dice;
use shape::{Image, Rgb};
use silhouette::{Backdrop, Settings, coarse, exposure, prepare};

/// A background of plain patches, and a body before it that covers a third.
fn scene(dice: &mut Dice) -> (Rgb, Rgb, Image<bool>) {
    let (w, h) = (240, 320);
    let mut background = Rgb::filled(w, h, [0; 3]);
    let shades: Vec<[f64; 3]> = (0..48)
        .map(|_| [0; 3].map(|_| dice.within(30.0, 190.0)))
        .collect();
    let at = |i: usize| shades[(i % w / 40) + 6 * (i / w / 40)];
    for (i, p) in background.data.iter_mut().enumerate() {
        *p = at(i).map(|v| (v + dice.normal()).round() as u8);
    }
    let body = |i: usize| {
        let (x, y) = ((i % w) as f64 - 120.0, (i / w) as f64 - 160.0);
        (x / 70.0).powi(2) + (y / 130.0).powi(2) < 1.0
    };
    let mut photo = Rgb::filled(w, h, [0; 3]);
    for (i, p) in photo.data.iter_mut().enumerate() {
        let shown = if body(i) {
            [206.0, 150.0, 118.0]
        } else {
            at(i)
        };
        *p = shown.map(|v| (v + dice.normal()).round() as u8);
    }
    let truth = Image {
        width: w,
        height: h,
        data: (0..w * h).map(body).collect(),
    };
    (background, photo, truth)
}

fn changed(plate: &Rgb, by: [f64; 3]) -> Rgb {
    plate.map(|p| [0, 1, 2].map(|c| (f64::from(p[c]) * by[c]).round().min(255.0) as u8))
}

fn overlap(photo: &Rgb, plate: &Rgb, truth: &Image<bool>) -> f64 {
    let settings = Settings {
        gamma: 40.0,
        rounds: 2,
        clusters: 6,
        thinner: 0.0,
    };
    let ready = prepare(
        photo,
        &Backdrop::whole(plate.clone()),
        None,
        800,
        0.0,
        &|_, _| vec![],
    );
    let (sides, _) = coarse(&ready, &settings).unwrap();
    let pairs = || sides.data.iter().zip(&truth.data);
    let both = pairs().filter(|(a, b)| **a && **b).count();
    both as f64 / pairs().filter(|(a, b)| **a || **b).count() as f64
}

#[test]
fn a_plate_a_fifth_brighter_darker_or_of_another_white_cuts_as_well() {
    let (plate, photo, truth) = scene(&mut Dice(1));
    for by in [[1.2; 3], [0.8; 3], [1.08, 1.0, 0.9], [0.7, 0.75, 0.8]] {
        let other = changed(&plate, by);
        let before = overlap(&photo, &other, &truth);
        let levels = exposure(&photo, &other).expect("another exposure");
        let after = overlap(&photo, &shape::toned(&other, &levels), &truth);
        // What is darker than the plate may be a shadow, what is brighter may not; another white is noise.
        let fails = by.iter().all(|b| *b < 1.0);
        assert!(
            after > 0.98 && (!fails || before < 0.9),
            "{by:?}: {before}, then {after}"
        );
    }
}

#[test]
fn a_plate_exposed_alike_is_left_as_it_is() {
    let (plate, photo, _) = scene(&mut Dice(2));
    assert_eq!(exposure(&photo, &plate), None);
}

#[test]
fn a_plate_of_another_place_tells_nothing() {
    let (_, photo, _) = scene(&mut Dice(3));
    let (other, ..) = scene(&mut Dice(4));
    assert_eq!(exposure(&photo, &other), None);
    assert_eq!(exposure(&photo, &Rgb::filled(20, 20, [90; 3])), None);
}
