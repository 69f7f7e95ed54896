//! Noise of photos: always reported, warned of where masks may lose parts by it.

use super::place::Place;
use std::path::Path;

/// So many photos show what does not move.
const COUNT: u64 = 8;

/// A photo of the sample at half its size, with noise of so many levels added.
fn put(place: &Place, name: &str, seed: u64, levels: f64) {
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin/images");
    let photo = image::open(sample.join(name)).unwrap();
    let mut photo = photo.thumbnail(400, 600).to_rgb8();
    let mut dice = proof::Dice(seed);
    for value in photo.iter_mut() {
        *value = (f64::from(*value) + levels * dice.normal()).round() as u8;
    }
    let data = photo.pixels().map(|p| p.0).collect();
    let (width, height) = (photo.width() as usize, photo.height() as usize);
    let pixels = shape::Rgb {
        width,
        height,
        data,
    };
    place.write(&format!("turn/{name}"), shape::rgb_to_jpeg(&pixels, 95));
}

fn put_all(place: &Place, levels: f64) {
    (0..COUNT).for_each(|i| put(place, &format!("{i:04}.jpg"), i + 1, levels));
}

/// What doctor finds of the noise: levels, against what, and the warning.
fn found(place: &Place) -> (f64, String, Option<String>) {
    let reported = place.run("doctor turn --json").code(0).json();
    let findings = reported["findings"].as_array().unwrap().iter();
    let words = findings.filter_map(|f| f["what"]["text"].as_str());
    let warned = words.map(str::to_owned).find(|w| w.contains("noise"));
    let against = reported["noise_against"].as_str().map(str::to_owned);
    let levels = reported["noise_levels"].as_f64();
    (levels.unwrap(), against.unwrap(), warned)
}

#[test]
fn doctor_measures_noise_with_and_without_a_plate_and_warns_of_much() {
    let place = Place::sharing();
    put_all(&place, 0.0);
    let line = |place: &Place| {
        let reported = place.run("doctor turn").code(0).out;
        let line = reported.lines().find(|l| l.starts_with("noise: "));
        line.map(str::to_owned).unwrap_or(reported)
    };
    let (clean, against, warned) = found(&place);
    assert!(clean < 2.0 && against == "neighbours", "{clean} {against}");
    assert_eq!(warned, None);
    assert!(line(&place).contains("where nothing moved"));
    put_all(&place, 4.5);
    let (levels, _, warned) = found(&place);
    let expected = (clean * clean + 4.5 * 4.5).sqrt();
    proof::near(levels / expected, 1.0, 0.15);
    assert!(warned.unwrap().contains("grey levels"));
    put(&place, "plate.jpg", 99, 4.5);
    let (with_plate, against, _) = found(&place);
    assert_eq!(against, "plate");
    proof::near(with_plate / levels, 1.0, 0.05);
    let line = line(&place);
    assert!(
        line.ends_with("grey levels (photos against the plate)"),
        "{line}"
    );
}
