//! Masks of a walk around a made figure whose outline is known, and what is refused or warned of.

mod background;
mod scene;

use scene::{Made, Scene};
use shape::{Mask, Masks, Photos};
use silhouette::{Walk, WalkInput, WalkParams};
use stage::{Ctx, Host, Stage, Stop};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

/// Who listens to warnings.
#[derive(Default)]
struct Listening(Mutex<Vec<String>>);

impl Host for Listening {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.into());
    }
}

/// What comes of a scene, with the true masks and the warnings.
struct Came {
    masks: Result<Masks, String>,
    truth: Arc<Vec<Mask>>,
    stated: Vec<String>,
}

/// Photos of a scene and the true masks.
type Shown = (Arc<Photos>, Arc<Vec<Mask>>);

/// Those that were asked for, by their scenes: several tests ask for the same.
fn photos(made: Made) -> Shown {
    static KNOWN: LazyLock<Mutex<HashMap<String, Arc<OnceLock<Shown>>>>> =
        LazyLock::new(Mutex::default);
    let of = format!("{made:?}");
    let known = KNOWN.lock().unwrap().entry(of).or_default().clone();
    let make = || {
        let (photos, truth) = Scene::new(made).photos();
        (Arc::new(photos), Arc::new(truth))
    };
    known.get_or_init(make).clone()
}

fn cut(made: Made, p: &WalkParams) -> Came {
    let scene = Scene::new(made);
    let (photos, truth) = photos(made);
    let input = WalkInput {
        photos,
        cameras: Arc::new(scene.truth()),
        tracks: Some(Arc::new(scene.tracks(1500))),
    };
    let host = Listening::default();
    let masks = Walk::run(
        p,
        input,
        &Ctx::new(&host, stage::hash(b""), stage::hash(b"")),
    )
    .map_err(|stop| match stop {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => "cancelled".into(),
    });
    Came {
        masks,
        truth,
        stated: host.0.into_inner().unwrap(),
    }
}

/// Fewer cells than a real walk needs: the photos are small.
fn small() -> WalkParams {
    WalkParams {
        cells: 96,
        ..WalkParams::default()
    }
}

/// Intersection over union of masks.
fn shared(a: &Mask, b: &Mask) -> f64 {
    let pairs = || {
        a.data
            .iter()
            .zip(&b.data)
            .map(|(a, b)| (*a > 127, *b > 127))
    };
    let both = pairs().filter(|(a, b)| *a && *b).count();
    both as f64 / pairs().filter(|(a, b)| *a || *b).count() as f64
}

/// What masks share with the true ones: mean and least.
fn against(masks: &Masks, truth: &[Mask]) -> (f64, f64) {
    let all: Vec<f64> = masks
        .views
        .iter()
        .map(|(id, m)| shared(&m.pixels(), &truth[id.0 as usize]))
        .collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    (mean, all.into_iter().fold(1.0, f64::min))
}

#[test]
fn a_figure_before_walls_is_cut_out_of_a_walk_around_it() {
    let came = cut(Made::default(), &small());
    let masks = came.masks.unwrap();
    let (mean, least) = against(&masks, &came.truth);
    assert_eq!(masks.views.len(), 12);
    assert!(
        mean > 0.93 && least > 0.9,
        "{mean} {least} {:?}",
        came.stated
    );
    assert_eq!(came.stated, Vec::<String>::new());
}

#[test]
fn where_skin_has_the_floor_s_colour_what_is_lacking_is_warned_of() {
    let floor = [128.0, 104.0, 82.0];
    let came = cut(
        Made {
            floor,
            ..Made::default()
        },
        &small(),
    );
    let (mean, _) = against(&came.masks.unwrap(), &came.truth);
    assert!(mean > 0.8, "{mean}");
    let reported = |stated: &String| stated.contains("features amid the cameras are in no outline");
    assert!(came.stated.iter().any(reported), "{:?}", came.stated);
}

#[test]
fn the_height_that_is_given_is_where_the_subject_ends() {
    let p = WalkParams {
        bottom_mm: 600.0,
        ..small()
    };
    let made = Made::default();
    let (scene, came) = (Scene::new(made), cut(made, &p));
    let masks = came.masks.unwrap();
    // Just above the height, on the front of a thigh, and well below it.
    for (k, camera) in scene.cameras.iter().enumerate() {
        let mask = masks.views.values().nth(k).unwrap().pixels();
        let at = |z: f64| {
            camera
                .project(&nalgebra::Point3::new(95.0, 0.0, z))
                .unwrap()
        };
        assert!(mask.shows(at(800.0)) && !mask.shows(at(350.0)), "photo {k}");
    }
}

#[test]
fn the_same_bytes_come_with_any_number_of_threads() {
    let made = Made {
        photos: 8,
        width: 100,
        ..Made::default()
    };
    let p = WalkParams {
        cells: 48,
        least_by_color: 0.5,
        least_agreement: 0.0,
        most_lacking: 1.0,
        ..WalkParams::default()
    };
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        stage::to_bytes(&pool.install(|| cut(made, &p)).masks.unwrap())
    };
    let one = bytes(1);
    assert!(one == bytes(2) && one == bytes(5));
}

#[test]
fn what_would_be_a_guess_is_refused() {
    let made = Made {
        width: 120,
        ..Made::default()
    };
    let skin = made.colors[1];
    for (made, expected) in [
        (Made { photos: 1, ..made }, "only 1 photos have a camera"),
        (Made { photos: 5, ..made }, "only 5 photos have a camera"),
        (Made { round: 0.4, ..made }, "leave 2"),
        (
            Made {
                plain: true,
                colors: [skin; 3],
                ..made
            },
            "colours",
        ),
    ] {
        let came = cut(made, &small());
        let why = came.masks.map(|m| against(&m, &came.truth));
        let refused = why.as_ref().is_err_and(|why| why.contains(expected));
        assert!(refused, "{expected}: {why:?} {:?}", came.stated);
    }
}

#[test]
fn a_figure_that_photos_cut_off_is_warned_of() {
    let made = Made {
        width: 120,
        near: 1250.0,
        ..Made::default()
    };
    let came = cut(made, &small());
    let reported = |what: &str| came.stated.iter().any(|stated| stated.contains(what));
    assert!(
        came.masks.is_ok() && reported("over the border of 0000.png"),
        "{:?}",
        came.stated
    );
    assert!(reported("begin to cut it off"), "{:?}", came.stated);
}

#[test]
fn a_figure_far_aside_is_refused_or_warned_of() {
    let came = cut(
        Made {
            aside: 520.0,
            ..Made::default()
        },
        &small(),
    );
    let reported = !came.stated.is_empty();
    let share = came.masks.map(|m| against(&m, &came.truth));
    assert!(share.is_err() || reported, "{share:?}");
}
