//! The level model as a file: what it gives, what it gives of strangers, and which files are refused.

use measure::{Cover, Level, LevelModel, Place, Reading, Readings};

/// A model of two populations over stature and buttock: waist = 0.3 + 0.68 buttock ± 0.006.
fn text() -> String {
    let population = |name: &str, scope: &str, shift: f64| {
        let buttock = 0.48 + shift;
        format!(
            "[[population]]\nname = \"{name}\"\nscope = \"{scope}\"\nweight = 1.0\nmean = [0.0, {buttock}, {waist}]\n\
             covariance = [[0.0016], [0.0, 0.0001], [0.0, 0.000068, {var}]]\n",
            waist = 0.3 + 0.68 * buttock,
            var = 0.68f64.powi(2) * 0.0001 + 0.006f64.powi(2),
        )
    };
    format!(
        "format = 1\nreadings_version = {version}\nabout = \"test\"\nreadings = [\"ln_stature\", \"buttock\"]\nlevels = [\"waist\"]\n\
         limit = [6.6, 9.2]\nreading_sigma = [0.001, 0.002]\nrepeat = [[0.0], [0.0, 0.000004]]\n{people}{made}\n{notch}{laws}\n[[table]]\nname = \"t\"\n[[held_out]]\nlevel = \"waist\"\n[end]\nheld_out = 1\n",
        version = measure::READINGS_VERSION,
        people = population("people", "people", 0.0),
        made = population("made", "made", -0.1),
        notch = notch(),
        laws = laws(),
    )
}

/// A law of a place: 0.1 for each unit of one feature.
fn law(place: Place, by_features: usize) -> String {
    let n = place.features().len();
    let row = |i: usize| {
        let mut row = vec![0.0; i + 1];
        row[i] = if i < n { 0.01 } else { 0.0002 };
        if i == n {
            row[by_features] = 0.001;
        }
        format!("{row:?}")
    };
    let covariance: Vec<String> = (0..=n).map(row).collect();
    format!(
        "[[law]]\nplace = \"{place}\"\nfeatures = {features:?}\nmean = {mean:?}\ncovariance = [{rows}]\nsigma = 0.06\nlimit = 21.7\n",
        place = place.name(),
        features = place.features(),
        mean = vec![0.0; n + 1],
        rows = covariance.join(", "),
    )
}

/// A law of the notch, estimated by `head`.
fn notch() -> String {
    law(Place::Notch, 3)
}

/// Laws of all other places.
fn laws() -> String {
    let all = Place::ALL.into_iter().filter(|p| *p != Place::Notch);
    all.map(|place| law(place, 0)).collect()
}

fn read(text: &str) -> Result<LevelModel, String> {
    LevelModel::read("own.toml", text).map_err(|e| e.to_string())
}

fn readings(stature_mm: f64, buttock: f64) -> Readings {
    Readings::default()
        .with(Reading::LnStature, Some(libm::log(stature_mm / 1700.0)))
        .with(Reading::Buttock, Some(buttock))
}

#[test]
fn a_level_comes_with_its_scatter_and_what_repeats() {
    let model = read(&text()).unwrap();
    let reported = model
        .estimate(&readings(1700.0, 0.49), 1700.0, Level::Waist)
        .unwrap();
    proof::near(reported.height_mm, 1700.0 * (0.3 + 0.68 * 0.49), 0.05);
    // Who is near the middle is a little surer than by normal tails.
    proof::near(reported.sigma_mm, 1700.0 * 0.006, 0.5);
    proof::near(reported.repeat_mm.unwrap(), 1700.0 * 0.68 * 0.002, 0.01);
    assert_eq!(reported.cover, Cover::People);
    // Without the buttock the level scatters as the buttock does, too.
    let blind = Readings::default().with(Reading::LnStature, Some(0.0));
    let reported = model.estimate(&blind, 1700.0, Level::Waist).unwrap();
    proof::near(
        reported.sigma_mm,
        1700.0 * libm::hypot(0.0068f64, 0.006),
        0.8,
    );
    assert!(
        model
            .estimate(&Readings::default(), 1700.0, Level::Waist)
            .is_none()
    );
    assert!(
        model.estimate(&blind, 1700.0, Level::Chest).is_none(),
        "a level that the file has not"
    );
}

#[test]
fn a_body_beyond_the_people_is_known_by_made_ones_and_beyond_both_with_wider_intervals() {
    let model = read(&text()).unwrap();
    let tell = |stature: f64, buttock| {
        let read = readings(stature, buttock);
        model.estimate(&read, stature, Level::Waist).unwrap()
    };
    // People's size but another build: theirs still, with wider intervals.
    let near = tell(1700.0, 0.48);
    let far = [0.38, 0.30].map(|buttock| tell(1700.0, buttock));
    assert!(far.iter().all(|t| t.cover == Cover::Outside));
    assert!(far.iter().all(|t| t.sigma_mm > 1.3 * near.sigma_mm));
    // Another size altogether.
    let small = LevelModel::built_in();
    let child = Readings::default()
        .with(Reading::LnStature, Some(libm::log(900.0f64 / 1700.0)))
        .with(Reading::Buttock, Some(0.50));
    let reported = small.estimate(&child, 900.0, Level::Waist).unwrap();
    assert_ne!(reported.cover, Cover::People);
}

/// A belly that was taken for the bust, and a double chin for the neck.
#[test]
fn readings_that_are_of_something_else_hardly_move_levels() {
    let model = LevelModel::built_in();
    let middle = [
        -0.045, 0.513, 0.863, 0.214, 0.628, 0.53, 0.504, 0.144, 0.727,
    ];
    let read = Reading::ALL.into_iter().zip(middle);
    let read = read.fold(Readings::default(), |all, (r, v)| all.with(r, Some(v)));
    let bad = [(Reading::NeckTape, 0.33), (Reading::Bust, 0.62)];
    let with = |value: &dyn Fn(f64) -> Option<f64>| {
        let all = bad.into_iter();
        all.fold(read.clone(), |all, (r, v)| all.with(r, value(v)))
    };
    for level in Level::ALL {
        let estimate = |readings: &Readings| model.estimate(readings, 1625.0, level).unwrap();
        let (wrong, without) = (estimate(&with(&Some)), estimate(&with(&|_| None)));
        assert!((wrong.height_mm - without.height_mm).abs() < 5.0);
        assert_eq!(
            (wrong.cover, without.cover),
            (Cover::Outside, Cover::People)
        );
        assert!((wrong.height_mm - estimate(&read).height_mm).abs() < 15.0);
    }
}

#[test]
fn a_place_is_known_by_its_law_and_repeats_only_where_the_file_has_how() {
    let model = read(&text()).unwrap();
    let mut features = [0.0; 4];
    features[3] = 0.3;
    let reported = model.law(Place::Notch).estimate(&features).unwrap();
    proof::near(reported.value, 0.03, 1e-9);
    assert_eq!(
        (reported.sigma, reported.repeat, reported.inside),
        (0.06, None, true)
    );
    let shipped = LevelModel::built_in();
    let reported = shipped.law(Place::Notch).estimate(&features).unwrap();
    assert!(reported.repeat.unwrap() < reported.sigma);
}

#[test]
fn files_that_are_no_model_are_refused_with_what_would_fit() {
    let good = text();
    let bad = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        read(&good.replace(from, to)).unwrap_err()
    };
    assert!(bad("format = 1", "format = 9").contains("has format 9, but this program knows 1"));
    let newer = bad("readings_version = ", "readings_version = 9");
    assert!(
        newer.contains("readings_version") && newer.contains("fit-levels.toml"),
        "{newer}"
    );
    assert!(bad("\"buttock\"", "\"girdle\"").contains("`girdle` is neither a reading nor a level"));
    assert!(bad("weight = 1.0", "weight = nan").contains("weight"));
    let stated = bad("[0.0, 0.0001]", "[0.0, nan]");
    assert!(stated.contains("finite covariances"), "{stated}");
    assert!(bad("[0.0, 0.0001]", "[0.0, -0.0001]").contains("not positive definite"));
    assert!(bad("limit = [6.6, 9.2]", "limit = [6.6]").contains("limit"));
    for short in ["[0.001]", "[0.001, nan]"] {
        let stated = bad(
            "reading_sigma = [0.001, 0.002]",
            &format!("reading_sigma = {short}"),
        );
        assert!(stated.contains("reading_sigma"), "{stated}");
    }
    let stated = bad("place = \"notch\"", "place = \"chin\"");
    assert!(
        stated.contains("no law of `chin`; known laws: notch, acromion"),
        "{stated}"
    );
    let stated = bad("\"lean\"", "\"tilt\"");
    assert!(
        stated.contains("needs the features up, low, lean, head"),
        "{stated}"
    );
    assert!(bad("sigma = 0.06", "sigma = nan").contains("positive `sigma`"));
    let twice = notch() + &notch();
    assert!(bad(&notch(), &twice).contains("not one law of `notch`"));
    assert!(bad(&notch(), "").contains("not one law of `notch`"));
    // Cut short anywhere: never taken for a whole one.
    let more = good.replace("held_out = 1", "held_out = 12");
    assert!(read(&more).unwrap_err().contains("cut short: 1 of 12"));
    for cut in (0..good.len() - 1).step_by(7) {
        assert!(read(&good[..cut]).is_err(), "cut at {cut}");
    }
}
