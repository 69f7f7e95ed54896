//! Bodies that are not whole, or whose limbs touch: no number without a reason to trust it.

use crate::made;

use measure::{has_left, paper_girth};
use shape::{Girths, Mesh, Solid, SolidPart};

fn built(arms_deg: f64) -> Solid {
    made::built(1700.0, 1.0, arms_deg)
}

fn meshed(solid: &Solid) -> Mesh {
    made::meshed(solid, 10.0)
}

fn measured(mesh: Mesh) -> Girths {
    made::measured(mesh).1
}

fn why<'a>(girths: &'a Girths, name: &str) -> &'a str {
    let missing = girths.missing.iter().find(|m| m.name == name);
    missing.map_or("", |m| m.why.as_str())
}

#[test]
fn a_body_without_a_head_has_no_stature_and_why_is_named() {
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
fn thighs_that_are_one_are_parted_between_their_folds_and_leave_the_calves() {
    let mut solid = built(30.0);
    let free = measured(meshed(&solid));
    // What no photo shows between the legs.
    solid.parts.push(SolidPart::Ellipsoid {
        centre: [0.0, 5.0, 760.0],
        half: [70.0, 60.0, 110.0],
    });
    let girths = measured(meshed(&solid));
    let tape = |of: &Girths, name: &str| of.get(name).unwrap().tape_mm;
    for side in ["L", "R"] {
        let [thigh, calf] = ["TC", "CFC"].map(|name| format!("{name}_{side}"));
        // What fills the gap is half of each.
        let grown = tape(&girths, &thigh) / tape(&free, &thigh);
        assert!((0.98..1.2).contains(&grown), "{thigh}: {grown}");
        assert!((tape(&girths, &calf) / tape(&free, &calf) - 1.0).abs() < 0.01);
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
    let body = measure::body(&mesh, 0.0).unwrap();
    let neck = measure::neck_features(&mesh, &body).unwrap();
    let middle = measure::plane_at(&neck, 0.0).unwrap().plane;
    let ring = measure::nearest_ring(&mesh, &middle).unwrap();
    let contour = measure::length(&measure::flat(&ring.curve, &middle));
    let spline = paper_girth(&mesh, &ring.curve).unwrap();
    assert!(!has_left(spline, ring.tape, contour), "{spline}");
    assert!(has_left(1.26 * contour, ring.tape, contour));
    assert!(has_left(0.9 * ring.tape, ring.tape, contour));
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

#[test]
fn where_a_foot_is_lost_the_head_tells_which_side_is_the_front() {
    let mut mesh = meshed(&built(32.0));
    let top = mesh.bounds().unwrap().1.z;
    // A head is carried a fiftieth of the stature before the shoulders; one foot is gone, and of the
    // other all that is before its heel.
    for p in &mut mesh.positions {
        if f64::from(p[2]) > 0.87 * top {
            p[1] -= (0.02 * top) as f32;
        }
        if p[2] < 60.0 && p[0] > 0.0 {
            p[2] = 60.0;
        }
        if p[2] < 60.0 && p[0] <= 0.0 {
            p[1] = p[1].max(0.0) + 60.0;
        }
    }
    let body = measure::body(&mesh, 0.0).unwrap();
    assert!(
        body.front_is_sure && body.front.y < -0.999,
        "{}",
        body.front
    );
    // Without the head, the heel is taken for toes.
    mesh.faces.retain(|f| {
        f.iter()
            .all(|v| f64::from(mesh.positions[*v as usize][2]) < 0.8 * top)
    });
    let body = measure::body(&mesh, 0.0).unwrap();
    assert!(body.front.y > 0.999, "{}", body.front);
}

#[test]
fn a_hand_that_touches_hip_or_thigh_is_in_no_girth() {
    let free = measured(meshed(&built(14.0)));
    for (centre, half, touched, left) in [
        ([215.0, -25.0, 840.0], [62.0, 40.0, 70.0], "HC", "TC_L"),
        ([215.0, -30.0, 700.0], [70.0, 36.0, 50.0], "TC_L", "HC"),
    ] {
        let mut solid = built(14.0);
        solid.parts.push(SolidPart::Ellipsoid { centre, half });
        let girths = measured(meshed(&solid));
        match girths.get(touched) {
            Some(parted) => {
                assert!(parted.split.is_some() && touched == "HC");
                proof::near(
                    parted.tape_mm / free.get(touched).unwrap().tape_mm,
                    1.0,
                    0.01,
                );
            }
            None => assert!(
                why(&girths, touched).contains("hand"),
                "{}",
                why(&girths, touched)
            ),
        }
        for name in [left, "TC_R", "WC"] {
            let [got, own] = [&girths, &free].map(|g| g.get(name).unwrap().tape_mm);
            assert!((got / own - 1.0).abs() < 0.01, "{name}: {got} for {own}");
        }
    }
}
