//! Where the ground is: soles on the surface, compared with the ground of the cameras.

use crate::made;

use made::{built, measured, meshed};
use measure::{GivenGround, ground};
use shape::{Landmarks, Mesh, Refusal, Scale, Solid, SolidPart, Unit};

const TALL: f64 = 1700.0;

/// A standing body, and what is beside it.
fn with(more: impl FnOnce(&mut Solid)) -> Mesh {
    let mut solid = built(TALL, 1.0, 30.0);
    more(&mut solid);
    meshed(&solid, 10.0)
}

fn stated(height_mm: f64) -> GivenGround {
    GivenGround {
        height_mm,
        firm: false,
        sigma_mm: 0.0,
        unit: Unit::Metric,
    }
}

fn mat() -> GivenGround {
    GivenGround {
        height_mm: 0.0,
        firm: true,
        sigma_mm: 2.0,
        unit: Unit::Metric,
    }
}

fn near(mesh: &Mesh, reported: Option<GivenGround>, height: f64) -> measure::Ground {
    let found = ground(mesh, reported.as_ref()).unwrap();
    let off = found.height_mm - height;
    assert!(off.abs() < 7.0, "{} for {height}", found.height_mm);
    assert!(found.sigma_mm > 0.5 && found.sigma_mm < 15.0, "{found:?}");
    found
}

fn landmarks(mesh: &Mesh, ground_mm: f64) -> Landmarks {
    made::Given::on(mesh, made::cameras(Scale::Given, Some(0.001), ground_mm)).landmarks()
}

#[test]
fn a_ground_that_the_body_does_not_touch_is_named_and_the_soles_are_taken() {
    let mesh = with(|_| {});
    assert_eq!(near(&mesh, None, 0.0).word, None);
    assert_eq!(near(&mesh, Some(mat()), 0.0).word, None);
    assert_eq!(near(&mesh, Some(stated(3.0)), 0.0).word, None);
    let low = near(&mesh, Some(stated(-419.0)), 0.0).word.unwrap();
    assert!(low.contains("42") && low.contains("below"), "{low}");
    let high = near(&mesh, Some(stated(80.0)), 0.0).word.unwrap();
    assert!(high.contains("above"), "{high}");
    // So a stature and all that is a share of it do not change.
    let own = measured(mesh.clone()).0;
    let off = landmarks(&mesh, -419.0);
    let tall = off.stature_mm.unwrap();
    assert!((tall / TALL - 1.0).abs() < 0.01, "{tall}");
    assert!(off.stature_sigma_mm.unwrap() < 15.0);
    for l in &own.found {
        let other = off.found.iter().find(|o| o.name == l.name).unwrap();
        let moved = other.plane.point_mm[2] - l.plane.point_mm[2];
        assert!(moved.abs() < 0.01 * TALL, "{} moved by {moved}", l.name);
    }
}

#[test]
fn specks_and_threads_below_the_feet_are_no_ground() {
    let mut mesh = with(|solid| {
        solid.parts.push(SolidPart::Limb {
            from: [110.0, -40.0, 30.0],
            to: [110.0, -40.0, -90.0],
            half_from: [16.0, 16.0],
            half_to: [10.0, 10.0],
            round: 8.0,
        });
    });
    let first = mesh.positions.len() as u32;
    for p in [
        [0.0, 0.0, -300.0],
        [50.0, 0.0, -300.0],
        [0.0, 50.0, -300.0],
        [0.0, 0.0, -250.0],
    ] {
        mesh.positions.push(p);
    }
    for f in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
        mesh.faces.push(f.map(|v| first + v));
    }
    near(&mesh, None, 0.0);
    near(&mesh, Some(stated(-300.0)), 0.0);
}

#[test]
fn a_piece_of_floor_that_is_one_with_the_feet_is_stood_upon() {
    for half in [170.0, 400.0] {
        let mesh = with(|solid| {
            let level = |z: f64| shape::Level {
                z,
                centre: [0.0, -30.0],
                half: [half, half],
            };
            solid.parts.push(SolidPart::Stack {
                levels: vec![level(-60.0), level(0.0)],
                exponent: 4.0,
                furrow: None,
                round: 2.0,
            });
        });
        let found = ground(&mesh, None).unwrap().height_mm;
        assert!((-10.0..20.0).contains(&found), "{found}");
    }
}

/// The body with all below a height gone, on some side.
fn cut(mesh: &Mesh, z: f64, side: impl Fn(f64) -> bool) -> Mesh {
    let mut mesh = mesh.clone();
    for p in &mut mesh.positions {
        if side(f64::from(p[0])) {
            p[2] = p[2].max(z as f32);
        }
    }
    mesh
}

#[test]
fn one_foot_tells_the_ground_and_none_leaves_it_to_the_mat() {
    let whole = with(|_| {});
    near(&cut(&whole, 110.0, |x| x > 0.0), None, 0.0);
    let none = cut(&whole, 110.0, |_| true);
    assert_eq!(ground(&none, None), Err(Refusal::NoGround));
    assert_eq!(ground(&none, Some(&stated(0.0))), Err(Refusal::NoGround));
    let lost = near(&none, Some(mat()), 0.0);
    assert!(lost.word.unwrap().contains("lost"));
    // Far above a mat, or below it, nothing can be trusted.
    let high = GivenGround {
        height_mm: -400.0,
        ..mat()
    };
    assert_eq!(ground(&none, Some(&high)), Err(Refusal::NoGround));
    let found = landmarks(&none, -300.0);
    assert!(found.found.is_empty() && found.stature_mm.is_none() && found.ground_mm.is_none());
    assert!(found.missing.iter().any(|m| m.name == "stature"));
    for m in &found.missing {
        assert_eq!(m.why, Refusal::NoGround.why(), "{}", m.name);
    }
}

#[test]
fn on_its_toes_and_in_shoes_a_body_rests_on_what_is_lowest() {
    let mut toes = with(|_| {});
    for p in &mut toes.positions {
        // Heels 60 mm up; the balls of the feet stay.
        let heel = ((f64::from(p[1]) + 90.0) / 90.0).clamp(0.0, 1.0);
        let above = ((f64::from(p[2]) - 60.0) / 60.0).clamp(0.0, 1.0);
        p[2] += (60.0 * heel.max(above)) as f32;
    }
    let found = ground(&toes, None).unwrap().height_mm;
    assert!((-5.0..15.0).contains(&found), "{found}");
    // Soles of 30 mm under both feet.
    let shod = with(|solid| {
        for side in [-1.0, 1.0] {
            let level = |z: f64| shape::Level {
                z,
                centre: [side * 108.0, -50.0],
                half: [50.0, 135.0],
            };
            solid.parts.push(SolidPart::Stack {
                levels: vec![level(-30.0), level(20.0)],
                exponent: 2.5,
                furrow: None,
                round: 4.0,
            });
        }
    });
    near(&shod, None, -30.0);
}
