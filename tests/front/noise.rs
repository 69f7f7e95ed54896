//! Noise of photos: told always, warned of where masks may lose parts by it.

use crate::place::Place;

/// A photo of a folder with noise of so many levels added.
fn add_noise(path: &std::path::Path, seed: u64, levels: f64) {
    let photo = shape::Photo {
        name: path.display().to_string(),
        width: 800,
        height: 1200,
        orientation: 1,
        focal_35mm: None,
        device: String::new(),
        time_s: None,
        file: std::fs::read(path).unwrap().into(),
    };
    let mut pixels = photo.decode().unwrap();
    let mut dice = proof::Dice(seed);
    for pixel in &mut pixels.data {
        *pixel = pixel.map(|c| (f64::from(c) + levels * dice.normal()).round() as u8);
    }
    std::fs::write(path, shape::rgb_to_jpeg(&pixels, 95)).unwrap();
}

/// What doctor finds of the noise: levels, against what, and the warning.
fn found(place: &Place) -> (f64, String, Option<String>) {
    let told = place.run("doctor turn --json").code(0).json();
    let findings = told["findings"].as_array().unwrap().iter();
    let words = findings.filter_map(|f| f["what"]["text"].as_str());
    let warned = words.map(str::to_owned).find(|w| w.contains("noise"));
    let against = told["noise_against"].as_str().map(str::to_owned);
    let levels = told["noise_levels"].as_f64();
    (levels.unwrap(), against.unwrap(), warned)
}

#[test]
fn doctor_measures_noise_with_and_without_a_plate_and_warns_of_much() {
    let place = Place::sharing();
    place.photos("turn", 12);
    let plate = place.path("turn").join("plate.jpg");
    let line = |place: &Place| {
        let told = place.run("doctor turn").code(0).out;
        let line = told.lines().find(|l| l.starts_with("noise: "));
        line.map(str::to_owned).unwrap_or(told)
    };
    let (clean, against, warned) = found(&place);
    assert!(clean < 2.0 && against == "neighbours", "{clean} {against}");
    assert_eq!(warned, None);
    assert!(line(&place).contains("where nothing moved"));
    for i in 0..12 {
        let photo = place.path("turn").join(format!("{i:04}.jpg"));
        add_noise(&photo, i + 1, 4.5);
    }
    let (levels, _, warned) = found(&place);
    let expected = (clean * clean + 4.5 * 4.5).sqrt();
    proof::near(levels / expected, 1.0, 0.15);
    assert!(warned.unwrap().contains("grey levels"));
    let sample = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/mannequin");
    std::fs::copy(sample.join("images/plate.jpg"), &plate).unwrap();
    add_noise(&plate, 99, 4.5);
    let (with_plate, against, _) = found(&place);
    assert_eq!(against, "plate");
    proof::near(with_plate / levels, 1.0, 0.05);
    let line = line(&place);
    assert!(
        line.ends_with("grey levels (photos against the plate)"),
        "{line}"
    );
}
