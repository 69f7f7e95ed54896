//! What is odd about the people on a turn is reported by photo; the sample and things are passed over in silence.

use person::{FindPeople, FindPeopleInput, FindPeopleParams, InView, InViewInput, InViewParams};
use shape::{People, Photo, Photos, Rgb, rgb_to_png};
use stage::{Ctx, Host, Stage, Stop};
use std::path::Path;
use std::sync::{Arc, Mutex};

fn photo(name: &str, pixels: &Rgb) -> Photo {
    Photo::of(
        name,
        [pixels.width as u32, pixels.height as u32],
        rgb_to_png(pixels),
    )
}

/// A photo of the sample, 800 × 1200.
fn sample(name: &str) -> Rgb {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/mannequin/images");
    let file = std::fs::read(folder.join(name)).unwrap();
    let whole = Photo {
        file: file.into(),
        ..photo(name, &Rgb::filled(800, 1200, [0; 3]))
    };
    whole.decode().unwrap()
}

/// What the stage makes of photos, and its warnings.
fn found(photos: Vec<Photo>) -> (People, Vec<String>) {
    #[derive(Default)]
    struct Heard(Mutex<Vec<String>>);
    impl Host for Heard {
        fn warn(&self, text: &stage::Message) {
            self.0.lock().unwrap().push(text.to_string());
        }
    }
    let heard = Heard::default();
    let nothing = stage::hash(b"");
    let photos = Arc::new(Photos {
        photos,
        ..Photos::default()
    });
    let ctx = Ctx::new(&heard, nothing, nothing);
    let people = FindPeople::run(&FindPeopleParams {}, FindPeopleInput { photos }, &ctx).unwrap();
    (people, heard.0.into_inner().unwrap())
}

/// Each pixel from another place of a photo.
fn moved(of: &Rgb, width: usize, height: usize, from: impl Fn(usize, usize) -> [usize; 2]) -> Rgb {
    let mut to = Rgb::filled(width, height, [0; 3]);
    for (i, pixel) in to.data.iter_mut().enumerate() {
        let [x, y] = from(i % width, i / width);
        *pixel = of.at(x.min(of.width - 1), y.min(of.height - 1));
    }
    to
}

#[test]
fn photos_without_with_two_cut_off_and_turned_people_are_named() {
    let turn = [
        "0000.jpg", "0003.jpg", "0006.jpg", "0009.jpg", "0012.jpg", "0015.jpg",
    ]
    .map(sample);
    let whole = |i: usize| photo(&format!("{i}.png"), &turn[i]);
    let (people, reported) = found((0..6).map(whole).collect());
    assert!(people.person && people.views.values().all(|f| f.len() == 1));
    assert_eq!(
        reported,
        Vec::<String>::new(),
        "nothing is odd about the sample"
    );

    // Somebody beside the one who is followed.
    let mut two = moved(&turn[0], 1400, 1200, |x, y| [x, y]);
    for i in 0..600 * 1200 {
        let (x, y) = (i % 600, i / 600);
        *two.at_mut(800 + x, y) = turn[3].at(100 + x, y);
    }
    let upper = moved(&turn[1], 800, 1200, |x, y| [x, y + 330]);
    let lower = moved(&turn[2], 800, 1200, |x, y| [x, y.saturating_sub(330)]);
    let over = moved(&turn[4], 800, 1200, |x, y| [799 - x, 1199 - y]);
    let odd = [
        ("two", &two),
        ("upper", &upper),
        ("lower", &lower),
        ("over", &over),
        ("empty", &sample("plate.jpg")),
    ];
    let mut photos: Vec<Photo> = (0..6).map(whole).collect();
    photos.extend(odd.map(|(name, pixels)| photo(name, pixels)));
    let (people, reported) = found(photos);
    assert!(people.person);
    let warning = |what: &str| {
        reported
            .iter()
            .find(|t| t.contains(what))
            .map(String::as_str)
    };
    let nobody = warning("nobody is seen").unwrap_or_default();
    assert!(nobody.contains("on empty,"), "{reported:?}");
    let two = warning("more than one person").unwrap_or_default();
    assert!(two.contains("on two:"), "{reported:?}");
    assert!(
        warning("at the upper edge of upper:").is_some(),
        "{reported:?}"
    );
    assert!(
        warning("at the lower edge of lower:").is_some(),
        "{reported:?}"
    );
    assert!(warning("upside down on over:").is_some(), "{reported:?}");
    assert_eq!(reported.len(), 5, "{reported:?}");
}

#[test]
fn feet_that_most_photos_cut_off_stop_the_turn_unless_somebody_is_sure() {
    let turn = ["0000.jpg", "0003.jpg", "0006.jpg", "0009.jpg", "0012.jpg"].map(sample);
    let asked = |cut: usize, stop: bool| {
        let one = |(i, of): (usize, &Rgb)| match i < cut {
            true => moved(of, 800, 1200, |x, y| [x, y.saturating_sub(330)]),
            false => of.clone(),
        };
        let all = turn.iter().enumerate().map(one).enumerate();
        let photos: Vec<Photo> = all.map(|(i, of)| photo(&format!("{i}.png"), &of)).collect();
        let (people, _) = found(photos.clone());
        let input = InViewInput {
            people: Arc::new(people.clone()),
            photos: Arc::new(Photos {
                photos,
                ..Photos::default()
            }),
        };
        let kept = InView::run(&InViewParams { stop }, input, &Ctx::alone());
        kept.map(|kept| assert_eq!(kept, people))
    };
    assert!(asked(2, true).is_ok(), "two of five are a warning");
    let Err(Stop::Failed(why)) = asked(3, true) else {
        panic!("three of five have no feet");
    };
    let why = why.to_string();
    for part in [
        "0.png, 1.png, 2.png",
        "below the feet",
        "in_view.stop=false",
    ] {
        assert!(why.contains(part), "{why}");
    }
    assert!(asked(3, false).is_ok());
}

#[test]
fn somebody_whose_head_does_not_show_on_one_photo_is_seen_where_the_rest_show_that_one() {
    let names = ["0000.jpg", "0003.jpg", "0006.jpg", "0009.jpg", "0012.jpg"];
    let mut photos: Vec<Photo> = names
        .iter()
        .map(|name| photo(name, &sample(name)))
        .collect();
    let (people, _) = found(photos.clone());
    let shoulders = |people: &People| people.subject(shape::PhotoId(2)).unwrap().joints[11].at_px;
    let before = shoulders(&people);
    let (plate, mut headless) = (sample("plate.jpg"), sample(names[2]));
    let above = headless.width * before[1] as usize;
    headless.data[..above].copy_from_slice(&plate.data[..above]);
    photos[2] = photo("headless.png", &headless);
    let (people, reported) = found(photos);
    assert!(people.person && reported.is_empty(), "{reported:?}");
    let after = shoulders(&people);
    assert!(
        (0..2).all(|k| (after[k] - before[k]).abs() < 40.0),
        "{before:?} {after:?}"
    );
}

#[test]
fn a_thing_is_no_person_and_nothing_is_reported() {
    let mut thing = Rgb::filled(800, 1200, [120, 130, 140]);
    for y in 500..900 {
        for x in 300..520 {
            *thing.at_mut(x, y) = [180, 40, (y % 200) as u8];
        }
    }
    let (people, reported) = found((0..4).map(|i| photo(&format!("{i}.png"), &thing)).collect());
    assert!(!people.person && reported.is_empty(), "{reported:?}");
}
