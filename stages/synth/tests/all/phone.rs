//! The faults of a made phone are as large as given, and each is by itself.

use shape::{Photo, Photos, Rgb, rgb_to_png};
use stage::{Ctx, Params, Stage, Value};
use std::collections::BTreeMap;
use std::sync::Arc;
use synth::{Phone, PhoneInput};

const COUNT: usize = 18;

/// A turn of equal photos of a grey wall with a blue border at two sides, and a plate.
fn turn() -> Arc<Photos> {
    let mut pixels = Rgb::filled(64, 48, [150; 3]);
    for (i, p) in pixels.data.iter_mut().enumerate() {
        if i % 64 < 8 || i / 64 < 6 {
            *p = [60, 120, 240];
        }
    }
    let photo = |name: String| Photo::of(name, [64, 48], rgb_to_png(&pixels));
    Arc::new(Photos {
        photos: (0..COUNT).map(|i| photo(format!("{i:04}.png"))).collect(),
        plate: Some(photo("plate.png".into())),
        ..Photos::default()
    })
}

fn taken(values: &[(&str, f64)]) -> Photos {
    let value = |name: &str, v: f64| match name {
        "shaken" | "jpeg_quality" | "seed" => Value::Int(v as i64),
        _ => Value::Float(v),
    };
    let stated: BTreeMap<String, Value> = values
        .iter()
        .map(|(k, v)| ((*k).to_owned(), value(k, *v)))
        .collect();
    let input = PhoneInput { photos: turn() };
    Phone::run(&Params::read(&stated).unwrap(), input, &Ctx::alone()).unwrap()
}

/// Light of a channel in the middle of a photo, in proportion to that of level 150.
fn light(photo: &Photo, c: usize) -> f64 {
    let pixels = photo.decode().unwrap();
    let level = f32::from(pixels.at(40, 24)[c]);
    f64::from(shape::light_of_level(level) / shape::light_of_level(150.0))
}

#[test]
fn without_faults_the_very_files_come_out() {
    assert_eq!(taken(&[]), *turn());
}

#[test]
fn an_exposure_of_a_tenth_of_a_stop_changes_light_by_as_much_and_all_channels_alike() {
    let photos = taken(&[("exposure_ev", 0.1)]);
    let stops: Vec<f64> = photos
        .photos
        .iter()
        .map(|p| libm::log2(light(p, 1)))
        .collect();
    let most = stops.iter().map(|s| s.abs()).fold(0.0, f64::max);
    assert!((most - 0.1).abs() < 0.01, "{stops:?}");
    // It drifts, and it steps.
    let mut way: Vec<f64> = stops.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    way.sort_by(f64::total_cmp);
    let (usual, most) = (way[way.len() / 2], way[way.len() - 1]);
    assert!(usual > 0.005 && most > 2.0 * usual, "{way:?}");
    for photo in &photos.photos {
        assert!((light(photo, 0) / light(photo, 1) - 1.0).abs() < 0.011);
    }
}

#[test]
fn white_moves_red_and_blue_and_leaves_green() {
    let photos = taken(&[("white", 0.04)]);
    let most = |c: usize| {
        let off = photos.photos.iter().map(|p| (light(p, c) - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    assert_eq!(most(1), 0.0);
    for c in [0, 2] {
        assert!((most(c) - 0.04).abs() < 0.008, "{}", most(c));
    }
}

#[test]
fn so_many_photos_are_shaken_and_no_other_is_touched() {
    let (before, after) = (turn(), taken(&[("shaken", 2.0)]));
    let pixels =
        |p: &Photos| -> Vec<Rgb> { p.photos.iter().map(|p| p.decode().unwrap()).collect() };
    let pairs = pixels(&before).into_iter().zip(pixels(&after));
    assert_eq!(pairs.filter(|(a, b)| a != b).count(), 2);
    assert_eq!(after.plate.unwrap().decode().unwrap(), pixels(&before)[0]);
}

#[test]
fn one_fault_moves_no_other_and_another_seed_all() {
    let drift = |more: &[(&str, f64)]| -> Vec<f64> {
        let all: Vec<_> = [("exposure_ev", 0.3)].iter().chain(more).copied().collect();
        taken(&all).photos.iter().map(|p| light(p, 1)).collect()
    };
    let alone = drift(&[]);
    assert_eq!(alone, drift(&[("white", 0.1), ("shift_px", 0.5)]));
    assert_ne!(alone, drift(&[("seed", 2.0)]));
}

#[test]
fn a_quality_makes_jpegs_of_another_size() {
    let size = |quality: f64| {
        let photos = taken(&[("jpeg_quality", quality)]);
        assert!(photos.photos[0].name.ends_with(".jpg"));
        photos.photos[0].file.len()
    };
    assert!(size(50.0) < size(95.0));
}
