//! What the crate calls true is true: surfaces, silhouettes, bytes.

use nalgebra::{Point2, Point3, Vector3};
use shape::{Camera, Cameras, Mesh, PhotoId, Solid};
use stage::{Ctx, Params, Stage, Value};
use std::collections::BTreeMap;
use std::sync::Arc;
use synth::{
    BodyInput, BodyParams, Field, MakeBody, MakeRing, MakeSolid, MakeSway, MaskInput, MaskParams,
    RingInput, SolidInput, SwayInput, TakePhotos, TrueMasks, TurnInput,
};

/// Params with some values given.
fn stated<P: Params>(values: &[(&str, Value)]) -> P {
    let map: BTreeMap<_, _> = values
        .iter()
        .map(|(k, v)| ((*k).to_owned(), v.clone()))
        .collect();
    P::read(&map).unwrap()
}

fn text(word: &str) -> Value {
    Value::Text(word.into())
}

fn solid(values: &[(&str, Value)]) -> Solid {
    MakeSolid::run(&stated(values), SolidInput {}, &Ctx::alone()).unwrap()
}

fn mesh(solid: &Solid, cell_mm: f64) -> Mesh {
    let solid = Arc::new(solid.clone());
    MakeBody::run(&BodyParams { cell_mm }, BodyInput { solid }, &Ctx::alone()).unwrap()
}

/// A small ring around things of a hand's size.
fn ring(views: i64, k1: f64) -> Cameras {
    let values = [
        ("views", Value::Int(views)),
        ("width", Value::Int(120)),
        ("height", Value::Int(160)),
        ("distance_mm", Value::Float(700.0)),
        ("camera_mm", Value::Float(300.0)),
        ("look_mm", Value::Float(90.0)),
        ("disk_mm", Value::Float(150.0)),
        ("k1", Value::Float(k1)),
    ];
    MakeRing::run(&stated(&values), RingInput {}, &Ctx::alone()).unwrap()
}

#[test]
fn every_figure_is_closed_smooth_and_where_its_formula_has_it() {
    for figure in ["body", "cylinder", "ellipsoid", "torus"] {
        let solid = solid(&[("figure", text(figure))]);
        let mesh = mesh(&solid, 11.0);
        mesh.validate_closed().unwrap();
        assert!(mesh.volume() > 0.0, "{figure} looks inward");
        let field = Field::new(&solid);
        let far = (0..mesh.positions.len() as u32).map(|v| field.value(&mesh.point(v)).abs());
        let far = far.fold(0.0, f64::max);
        assert!(far < 1e-2, "{figure}: a vertex is {far} mm off");
    }
}

#[test]
fn a_far_part_changes_no_value() {
    let whole = solid(&[]);
    let field = Field::new(&whole);
    let mut dice = proof::Dice(3);
    for _ in 0..3000 {
        let p = Point3::new(
            dice.within(-700.0, 700.0),
            dice.within(-250.0, 250.0),
            dice.within(-100.0, 1850.0),
        );
        // All parts, one after another, none left out.
        let one = |part: &shape::SolidPart| Solid {
            parts: vec![part.clone()],
            ..whole.clone()
        };
        let values = whole
            .parts
            .iter()
            .map(|part| Field::new(&one(part)).value(&p));
        let soft = |a: f64, b: f64| {
            let h = (whole.blend_mm - (a - b).abs()).max(0.0);
            a.min(b) - h * h / (4.0 * whole.blend_mm)
        };
        let want = values.reduce(soft).unwrap();
        proof::near(field.value(&p), want, 1e-9);
    }
}

#[test]
fn volumes_are_those_of_the_formulas() {
    use std::f64::consts::PI;
    let ellipsoid = solid(&[
        ("figure", text("ellipsoid")),
        ("stature_mm", Value::Float(300.0)),
    ]);
    let want = 4.0 / 3.0 * PI * 160.0 * 110.0 * 150.0;
    proof::near(mesh(&ellipsoid, 4.0).volume() / want, 1.0, 1e-3);
    let torus = solid(&[("figure", text("torus")), ("deep_mm", Value::Float(40.0))]);
    let want = 2.0 * PI * PI * 160.0 * 40.0 * 40.0;
    proof::near(mesh(&torus, 3.0).volume() / want, 1.0, 2e-3);
}

/// Whether a ray meets an ellipsoid on the ground, by the quadratic equation.
fn meets(camera: &Camera, at_px: Point2<f64>, half: [f64; 3]) -> bool {
    let shrink = |v: Vector3<f64>| Vector3::new(v.x / half[0], v.y / half[1], v.z / half[2]);
    let from = shrink(camera.centre() - Point3::new(0.0, 0.0, half[2]));
    let along = shrink(camera.ray(at_px).into_inner());
    let (a, b, c) = (
        along.norm_squared(),
        from.dot(&along),
        from.norm_squared() - 1.0,
    );
    b * b >= a * c
}

#[test]
fn silhouettes_are_those_of_the_projected_solid() {
    let half = [60.0, 40.0, 80.0];
    let values = [
        ("figure", text("ellipsoid")),
        ("stature_mm", Value::Float(160.0)),
        ("wide_mm", Value::Float(60.0)),
        ("deep_mm", Value::Float(40.0)),
    ];
    let mesh = Arc::new(mesh(&solid(&values), 1.5));
    for k1 in [0.0, -0.2] {
        let cameras = Arc::new(ring(4, k1));
        let input = MaskInput {
            mesh: mesh.clone(),
            cameras: cameras.clone(),
            sway: None,
        };
        let masks = TrueMasks::run(&MaskParams { rays: 4 }, input, &Ctx::alone()).unwrap();
        for (_, mask, view) in masks.views.join(&cameras.views) {
            let mask = mask.pixels();
            let (mut differ, mut inside) = (0.0, 0.0);
            for y in 0..mask.height {
                for x in 0..mask.width {
                    let ray = |k: usize| {
                        let place = |i: usize| (i as f64 + 0.5) / 4.0 - 0.5;
                        Point2::new(x as f64 + place(k % 4), y as f64 + place(k / 4))
                    };
                    let met = (0..16)
                        .filter(|k| meets(&view.camera, ray(*k), half))
                        .count();
                    let got = f64::from(mask.at(x, y)) / 255.0;
                    inside += met as f64 / 16.0;
                    differ += (got - met as f64 / 16.0).abs();
                }
            }
            assert!(inside > 500.0, "{inside} px are too few to tell");
            assert!(differ < 0.003 * inside, "{differ} of {inside} px differ");
        }
    }
}

#[test]
fn a_subject_sways_about_its_ankles_and_never_farther_than_given() {
    let cameras = Arc::new(ring(18, 0.0));
    let breast = Point3::new(0.0, 0.0, 1280.0);
    for seed in 0..20 {
        let values = [("sway_mm", Value::Float(8.0)), ("seed", Value::Int(seed))];
        let input = SwayInput {
            cameras: cameras.clone(),
        };
        let sway = MakeSway::run(&stated(&values), input, &Ctx::alone()).unwrap();
        let way = |p: &Point3<f64>| {
            let all = sway.views.values().map(|m| (m.apply(p) - p.coords).norm());
            all.fold(0.0, f64::max)
        };
        proof::near(way(&breast), 8.0, 1e-3);
        proof::near(way(&Point3::new(0.0, 0.0, 60.0)), 0.0, 1e-9);
    }
}

#[test]
fn photos_are_the_same_bytes_with_any_number_of_threads() {
    let values = [
        ("figure", text("ellipsoid")),
        ("stature_mm", Value::Float(160.0)),
    ];
    let mesh = Arc::new(mesh(&solid(&values), 6.0));
    let take = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let input = TurnInput {
                mesh: mesh.clone(),
                cameras: Arc::new(ring(3, 0.0)),
                sway: None,
            };
            let photos = TakePhotos::run(&stated(&[]), input, &Ctx::alone()).unwrap();
            stage::to_bytes(&photos)
        })
    };
    assert!(take(1) == take(4));
}

#[test]
fn photos_show_the_body_within_the_masks_and_the_background_elsewhere() {
    let values = [
        ("figure", text("torus")),
        ("wide_mm", Value::Float(70.0)),
        ("deep_mm", Value::Float(25.0)),
    ];
    let mesh = Arc::new(mesh(&solid(&values), 3.0));
    let cameras = Arc::new(ring(1, 0.0));
    let look = [
        ("jpeg_quality", Value::Int(0)),
        ("noise_levels", Value::Float(0.0)),
        ("rays", Value::Int(4)),
    ];
    let input = TurnInput {
        mesh: mesh.clone(),
        cameras: cameras.clone(),
        sway: None,
    };
    let photos = TakePhotos::run(&stated(&look), input, &Ctx::alone()).unwrap();
    let input = MaskInput {
        mesh,
        cameras,
        sway: None,
    };
    let masks = TrueMasks::run(&MaskParams { rays: 4 }, input, &Ctx::alone()).unwrap();
    let mask = masks.views.get(PhotoId(0)).unwrap().pixels();
    let photo = photos.photos[0].decode().unwrap();
    let plate = photos.plate.as_ref().unwrap().decode().unwrap();
    let (mut body, mut reported) = (0, 0);
    for ((p, q), m) in photo.data.iter().zip(&plate.data).zip(&mask.data) {
        match m {
            0 => assert_eq!(p, q),
            255 => (body, reported) = (body + 1, reported + usize::from(p != q)),
            _ => {}
        }
    }
    assert!(
        body > 500 && reported * 100 > body * 98,
        "{reported} of {body}"
    );
}

#[test]
fn a_surface_with_colours_wears_them() {
    let values = [
        ("figure", text("torus")),
        ("wide_mm", Value::Float(70.0)),
        ("deep_mm", Value::Float(25.0)),
    ];
    let mut mesh = mesh(&solid(&values), 3.0);
    mesh.colors = vec![[200, 40, 90]; mesh.positions.len()];
    let cameras = Arc::new(ring(1, 0.0));
    let look = [
        ("jpeg_quality", Value::Int(0)),
        ("noise_levels", Value::Float(0.0)),
        ("contrast", Value::Float(0.0)),
        ("ambient", Value::Float(1.0)),
    ];
    let take = |mesh: &Arc<shape::Mesh>| {
        let input = TurnInput {
            mesh: mesh.clone(),
            cameras: cameras.clone(),
            sway: None,
        };
        let photos = TakePhotos::run(&stated(&look), input, &Ctx::alone()).unwrap();
        photos.photos[0].decode().unwrap()
    };
    let mesh = Arc::new(mesh);
    let input = MaskInput {
        mesh: mesh.clone(),
        cameras: cameras.clone(),
        sway: None,
    };
    let masks = TrueMasks::run(&MaskParams { rays: 3 }, input, &Ctx::alone()).unwrap();
    let mask = masks.views.get(PhotoId(0)).unwrap().pixels();
    let photo = take(&mesh);
    let body = photo
        .data
        .iter()
        .zip(&mask.data)
        .filter(|(_, m)| **m == 255);
    let like = |p: &[u8; 3]| p.iter().zip([200, 40, 90]).all(|(a, b)| a.abs_diff(b) <= 1);
    let all: Vec<_> = body.map(|(p, _)| p).collect();
    assert!(all.len() > 500 && all.iter().all(|p| like(p)));
}
