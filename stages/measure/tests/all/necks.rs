//! The neck's plane on necks by formula: square to their axis however they lean, on the tube, never on
//! the head; or refused.

use crate::made;

use made::{built, measured, meshed};
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{Landmark, Mesh, Plane, Refusal, Solid, SolidPart};

/// Half-axes of the neck, across and fore and aft. \[mm\]
const NECK: [f64; 2] = [54.0, 60.0];

/// A standing body with a neck of even width that leans forward, times a scale.
fn leaning(degrees: f64, scale: f64) -> Solid {
    let mut solid = built(1750.0 * scale, 1.0, 32.0);
    let axis = Vector3::new(
        0.0,
        -libm::sin(degrees.to_radians()),
        libm::cos(degrees.to_radians()),
    );
    let base = Vector3::new(0.0, 6.0, 1400.0);
    let at = |along: f64| ((base + axis * along) * scale).into();
    if let SolidPart::Stack { levels, .. } = &mut solid.parts[0] {
        levels.pop();
    }
    solid.parts[1] = SolidPart::Limb {
        from: at(0.0),
        to: at(250.0),
        half_from: NECK.map(|h| h * scale),
        half_to: NECK.map(|h| h * scale),
        round: 10.0 * scale,
    };
    solid.parts[2] = SolidPart::Ellipsoid {
        centre: (base * scale + axis * (265.0 * scale) - Vector3::y() * (25.0 * scale)).into(),
        half: [78.0, 96.0, 118.0].map(|h| h * scale),
    };
    solid
}

/// An ellipse's length (Ramanujan 1914). \[mm\]
fn around() -> f64 {
    let [a, b] = NECK;
    let h = ((a - b) / (a + b)).powi(2);
    std::f64::consts::PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()))
}

fn neck(mesh: Mesh) -> Result<(Landmark, f64), String> {
    let (landmarks, girths) = measured(mesh);
    let found = landmarks.found.iter().find(|l| l.name == "NC");
    let why = landmarks.missing.iter().find(|m| m.name == "NC");
    match (found, girths.get("NC")) {
        (Some(landmark), Some(girth)) => Ok((landmark.clone(), girth.tape_mm)),
        _ => Err(why.map_or("no reason".into(), |m| m.why.to_string())),
    }
}

#[test]
fn a_plane_is_square_to_the_necks_axis_however_it_leans() {
    let around = around();
    for degrees in [0.0, 12.0, 24.0, 35.0] {
        let (landmark, tape) = neck(meshed(&leaning(degrees, 1.0), 7.0)).unwrap();
        let [_, y, z] = landmark.plane.normal;
        let reported = libm::atan2(-y, z).to_degrees();
        assert!((reported - degrees).abs() < 2.0, "{reported} for {degrees}");
        assert!(
            (tape / around - 1.0).abs() < 0.02,
            "{tape} for {around} at {degrees}"
        );
        let sigma = landmark.sigma;
        assert!(sigma.level_mm.unwrap() > 1.0 && sigma.tilt_rad.unwrap() > 0.01);
    }
}

#[test]
fn a_neck_is_the_same_share_of_a_body_of_any_size_in_any_place() {
    let (one, tape) = neck(meshed(&leaning(20.0, 1.0), 8.0)).unwrap();
    let mut small = meshed(&leaning(20.0, 0.5), 4.0);
    small.positions.iter_mut().for_each(|p| {
        p[0] += 300.0;
        p[1] -= 200.0;
    });
    let (other, half) = neck(small).unwrap();
    proof::near(half, 0.5 * tape, 0.005 * tape);
    let [_, y, z] = one.plane.point_mm;
    proof::near(other.plane.point_mm[2], 0.5 * z, 2.0);
    proof::near(other.plane.point_mm[1] + 200.0, 0.5 * y, 2.0);
}

#[test]
fn a_neck_that_widens_downward_is_as_unsure_as_its_plane_turns_about_the_throat() {
    let mut solid = leaning(20.0, 1.0);
    // Half as wide again at the shoulders as 250 mm up.
    let wider = 0.5;
    if let SolidPart::Limb { half_from, .. } = &mut solid.parts[1] {
        *half_from = NECK.map(|h| h * (1.0 + wider));
    }
    let given = made::Given::of(&meshed(&solid, 7.0));
    let mut landmarks = given.landmarks();
    let neck = landmarks.found.iter_mut().find(|l| l.name == "NC").unwrap();
    // Of a level that is sure, only the tilt is left.
    neck.sigma.level_mm = Some(0.0);
    let (plane, tilt) = (neck.plane, neck.sigma.tilt_rad.unwrap());
    let taken = |plane: Plane| {
        let mut turned = landmarks.clone();
        turned.found.retain(|l| l.name == "NC");
        turned.found[0].plane = plane;
        let girths = given.girths(&turned, &Default::default());
        girths.get("NC").unwrap().clone()
    };
    let here = taken(plane);
    // The throat, before the middle of the section.
    let throat = here.contour.iter().min_by(|a, b| a[1].total_cmp(&b[1]));
    let throat = Point3::from(throat.unwrap().map(f64::from));
    let change = |rad: f64| {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), rad);
        let middle = throat + turn * (Point3::from(plane.point_mm) - throat);
        let normal = turn * Vector3::from(plane.normal);
        let turned = Plane {
            point_mm: middle.into(),
            normal: normal.into(),
        };
        taken(turned).tape_mm - here.tape_mm
    };
    let (back, forth) = (change(-tilt), change(tilt));
    let (line, bend) = ((forth - back) / 2.0, (forth + back) / 2.0);
    let want = libm::hypot(line, 3f64.sqrt() * bend);
    proof::near(here.sigmas.level_mm.unwrap(), want, 0.05 * want);
    assert!(line.abs() > 2.0, "{line} {bend}");
}

#[test]
fn a_lean_that_is_set_adds_to_the_necks_own() {
    let given = made::Given::of(&meshed(&leaning(15.0, 1.0), 8.0));
    let lean = |more: f64| {
        let params = measure::LandmarkParams {
            neck_lean_deg: more,
            ..Default::default()
        };
        let found = given.marked(&params).unwrap().found;
        let [_, y, z] = found.iter().find(|l| l.name == "NC").unwrap().plane.normal;
        libm::atan2(-y, z).to_degrees()
    };
    proof::near(lean(10.0), lean(0.0) + 10.0, 1e-6);
}

#[test]
fn without_a_head_or_under_a_hood_there_is_no_neck() {
    let mut headless = leaning(15.0, 1.0);
    headless.parts.remove(2);
    assert_eq!(
        neck(meshed(&headless, 8.0)).unwrap_err(),
        Refusal::NoNeck.why()
    );
    let mut hood = leaning(15.0, 1.0);
    hood.parts[1] = SolidPart::Limb {
        from: [0.0, 0.0, 1380.0],
        to: [0.0, -60.0, 1640.0],
        half_from: [100.0, 110.0],
        half_to: [90.0, 110.0],
        round: 10.0,
    };
    assert_eq!(neck(meshed(&hood, 8.0)).unwrap_err(), Refusal::NoNeck.why());
}
