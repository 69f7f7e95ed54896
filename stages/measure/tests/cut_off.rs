//! Bodies that are not whole, or whose limbs touch: no number without a reason to trust it.

use measure::{FindLandmarks, GirthInput, LandmarkInput, Measure, has_left, paper_girth};
use shape::{Girths, Mesh, Solid, SolidPart};
use stage::{Ctx, Stage};
use std::sync::Arc;
use synth::{Build, body_solid, bounds, surface};

fn built(arms_deg: f64) -> Solid {
    body_solid(&Build {
        stature: 1700.0,
        stout: 1.0,
        furrow: 6.0,
        arms: f64::to_radians(arms_deg),
        exponent: 2.3,
    })
}

fn meshed(solid: &Solid) -> Mesh {
    let (low, high) = bounds(solid);
    surface(solid, low, high, 10.0)
}

fn measured(mesh: Mesh) -> Girths {
    let mesh = Arc::new(mesh);
    let input = LandmarkInput {
        mesh: mesh.clone(),
        cameras: None,
    };
    let landmarks = FindLandmarks::run(&Default::default(), input, &Ctx::alone()).unwrap();
    let input = GirthInput {
        mesh,
        landmarks: Arc::new(landmarks),
        cameras: None,
        photos: None,
        masks: None,
    };
    Measure::run(&Default::default(), input, &Ctx::alone()).unwrap()
}

fn why<'a>(girths: &'a Girths, name: &str) -> &'a str {
    let missing = girths.missing.iter().find(|m| m.name == name);
    missing.map_or("", |m| m.why.as_str())
}

#[test]
fn a_body_without_a_head_has_no_stature_and_says_why() {
    let whole = measured(meshed(&built(30.0)));
    assert!((whole.stature_mm.unwrap() / 1700.0 - 1.0).abs() < 0.03);
    let mut headless = built(30.0);
    headless.parts.retain(|part| match part {
        SolidPart::Ellipsoid { centre, half } => centre[2] + half[2] < 1690.0,
        _ => true,
    });
    let girths = measured(meshed(&headless));
    assert_eq!(girths.stature_mm, None);
    assert!(
        why(&girths, "stature").contains("head"),
        "{:?}",
        girths.missing
    );
    assert_eq!(girths.get("NC").map(|g| g.tape_mm), None);
}

#[test]
fn thighs_that_are_one_give_no_thigh_and_leave_the_calves() {
    let mut solid = built(30.0);
    assert!(measured(meshed(&solid)).get("TC_L").is_some());
    // What no photo shows between the legs.
    solid.parts.push(SolidPart::Ellipsoid {
        centre: [0.0, 5.0, 760.0],
        half: [70.0, 60.0, 110.0],
    });
    let girths = measured(meshed(&solid));
    for side in ["L", "R"] {
        let thigh = format!("TC_{side}");
        assert!(girths.get(&thigh).is_none());
        assert!(why(&girths, &thigh).contains("thighs are one"), "{thigh}");
        assert!(girths.get(&format!("CFC_{side}")).is_some());
    }
}

#[test]
fn arms_that_touch_the_trunk_are_in_no_chest() {
    let own = measured(meshed(&built(32.0))).get("CC").unwrap().tape_mm;
    for arms_deg in [3.0, 7.0] {
        let girths = measured(meshed(&built(arms_deg)));
        match girths.get("CC") {
            Some(chest) => assert!(
                (chest.tape_mm / own - 1.0).abs() < 0.06,
                "arms at {arms_deg}: {} for {own}",
                chest.tape_mm
            ),
            None => assert!(why(&girths, "CC").len() > 20),
        }
    }
}

#[test]
fn the_papers_spline_stays_on_a_short_neck_between_chin_and_shoulders() {
    let mesh = meshed(&built(30.0));
    let girths = measured(mesh.clone());
    let neck = girths.get("NC").unwrap();
    let curve: Vec<_> = neck
        .contour
        .iter()
        .map(|p| nalgebra::Point3::new(p[0].into(), p[1].into(), p[2].into()))
        .collect();
    let spline = paper_girth(&mesh, &curve).unwrap();
    assert!(!has_left(spline, neck.tape_mm, neck.contour_mm), "{spline}");
    assert!(has_left(
        1.26 * neck.contour_mm,
        neck.tape_mm,
        neck.contour_mm
    ));
    assert!(has_left(0.9 * neck.tape_mm, neck.tape_mm, neck.contour_mm));
}

#[test]
fn a_body_with_half_a_foot_lost_faces_as_before() {
    let mut mesh = meshed(&built(32.0));
    let front = |mesh: &Mesh| {
        let body = measure::body(mesh, 0.0).unwrap();
        (body.front, body.front_is_sure)
    };
    let (whole, sure) = front(&mesh);
    assert!(sure && whole.dot(&-nalgebra::Vector3::y()) > 0.999);
    // The toes of one foot are drawn back under its ankle, and so is the foot aside.
    for p in &mut mesh.positions {
        if p[2] < 60.0 && p[0] > 0.0 {
            p[1] = p[1].max(0.0);
            p[0] += 60.0;
        }
    }
    let (lost, sure) = front(&mesh);
    assert!(sure && lost.dot(&whole) > 0.999, "{lost}");
}
