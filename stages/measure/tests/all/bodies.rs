//! Landmarks and girths of whole bodies given by formula: what is measured is the part alone, or
//! nothing.

use crate::made;

use made::{built, measured, meshed};
use measure::GirthParams;
use nalgebra::{Rotation3, Vector3};
use shape::{Girths, Landmarks, Solid, SolidPart};
use synth::{bounds, contour, length, taut};

/// On which side of a body so high a part is an arm's; 0 if it is none.
fn arm(part: &SolidPart, top: f64) -> f64 {
    match part {
        SolidPart::Limb { from, .. } if from[0].abs() > 0.02 * top => from[0].signum(),
        SolidPart::Ellipsoid { centre, .. }
            if centre[0].abs() > 0.1 * top && centre[2] > 0.2 * top =>
        {
            centre[0].signum()
        }
        _ => 0.0,
    }
}

/// A body of the parts of which something holds.
fn only(solid: &Solid, keep: impl Fn(f64) -> bool) -> Solid {
    let top = bounds(solid).1.z;
    let mut solid = solid.clone();
    solid.parts.retain(|p| keep(arm(p, top)));
    solid
}

/// The same without limbs that start at the shoulders.
fn armless(solid: &Solid) -> Solid {
    only(solid, |side| side == 0.0)
}

/// The formula's tape at the plane of a girth.
fn formula(solid: &Solid, girths: &Girths, name: &str) -> f64 {
    let plane = girths.get(name).unwrap().plane;
    let curve = contour(solid, &plane).unwrap();
    length(&taut(&curve, &plane))
}

#[test]
fn every_girth_of_a_standing_body_is_found_and_is_its_formulas_at_that_plane() {
    let solid = built(1750.0, 1.0, 32.0);
    let cut = meshed(&solid, 8.0);
    let (landmarks, girths) = measured(cut.clone());
    assert_eq!(landmarks.missing, vec![]);
    for name in ["WC", "HC", "NC", "AC_L", "AC_R", "TC_L", "CFC_R"] {
        let girth = girths.get(name).unwrap();
        // The trunk may hide the inner side of an arm; whose girth is meant is clear.
        let (solid, within) = match name {
            "AC_L" => (only(&solid, |side| side > 0.0), 0.025),
            "AC_R" => (only(&solid, |side| side < 0.0), 0.025),
            _ => (solid.clone(), 0.01),
        };
        let truth = formula(&solid, &girths, name);
        assert!(
            (girth.tape_mm / truth - 1.0).abs() < within,
            "{name}: {} for {truth}",
            girth.tape_mm
        );
        let Some([low, high]) = girth.interval_mm else {
            panic!("{name} has no interval: {:?}", girth.sigmas)
        };
        assert!(
            low <= truth && truth <= high,
            "{name}: {low}..{high} for {truth}"
        );
    }
    let of = |name: &str| girths.get(name).unwrap().plane.point_mm[2];
    assert!(of("HC") < of("WC") && of("WC") < of("CC") && of("CC") < of("NC"));
    let hips = ["HC", "HC_max"].map(|name| girths.get(name).unwrap().tape_mm);
    assert!(
        hips[1] >= 0.999 * hips[0] && hips[1] < 1.1 * hips[0],
        "{hips:?}"
    );

    // The waist again, through eight points picked on it.
    let waist = girths.get("WC").unwrap();
    let some = waist.contour.iter().step_by(waist.contour.len() / 8);
    let params = GirthParams {
        points: some.map(|p| p.map(f64::from).to_vec()).collect(),
        ..Default::default()
    };
    let girths = made::Given::of(&cut).girths(&Landmarks::default(), &params);
    let picked = girths.get("PICKED").unwrap();
    assert!((picked.tape_mm / waist.tape_mm - 1.0).abs() < 0.003);
    let [low, high] = picked.interval_mm.unwrap();
    assert!(high - low > 5.0 && low < waist.tape_mm && waist.tape_mm < high);
}

#[test]
fn a_chest_is_the_trunks_alone_or_refused_however_the_arms_hang() {
    let mut taken = 0;
    for (stout, arms_deg) in [(1.0, 32.0), (1.0, 20.0), (1.25, 26.0), (1.0, 12.0)] {
        let solid = built(1700.0, stout, arms_deg);
        let (_, girths) = measured(meshed(&solid, 10.0));
        let Some(chest) = girths.get("CC") else {
            assert!(girths.missing.iter().any(|m| m.name == "CC"));
            continue;
        };
        let trunk = formula(&armless(&solid), &girths, "CC");
        assert!(
            (chest.tape_mm / trunk - 1.0).abs() < 0.05,
            "arms at {arms_deg}: {} for a trunk of {trunk}",
            chest.tape_mm
        );
        taken += 1;
    }
    assert!(taken >= 2, "only {taken} chests were measured");
}

#[test]
fn a_body_measures_the_same_whichever_way_it_faces() {
    let straight = meshed(&built(1200.0, 1.1, 30.0), 8.0);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 1.1);
    let mut turned = straight.clone();
    for v in 0..straight.positions.len() as u32 {
        let p = turn * straight.point(v);
        turned.positions[v as usize] = [p.x as f32, p.y as f32, p.z as f32];
    }
    let ((_, a), (_, b)) = (measured(straight), measured(turned));
    for girth in &a.girths {
        let other = b.get(&girth.name).unwrap().tape_mm;
        assert!(
            (girth.tape_mm / other - 1.0).abs() < 0.01,
            "{}: {} and {other}",
            girth.name,
            girth.tape_mm
        );
    }
}

#[test]
fn what_is_no_body_gives_reasons_and_no_girths() {
    let mut legless = built(1750.0, 1.0, 30.0);
    legless.parts = vec![SolidPart::Ellipsoid {
        centre: [0.0, 0.0, 500.0],
        half: [200.0, 150.0, 500.0],
    }];
    let (landmarks, girths) = measured(meshed(&legless, 20.0));
    assert_eq!(girths.girths.len(), 0);
    for name in ["WC", "HC", "CC", "NC", "AC_L", "AC_R"] {
        let missing = landmarks.missing.iter().find(|m| m.name == name);
        assert!(missing.is_some_and(|m| m.why.len() > 20), "{name}");
    }
}

#[test]
fn a_body_cut_off_at_the_thighs_or_the_waist_gives_reasons_and_no_numbers() {
    let whole = meshed(&built(1750.0, 1.0, 30.0), 10.0);
    for cut in [600.0, 1000.0] {
        let mut rest = whole.clone();
        rest.faces
            .retain(|f| f.iter().all(|v| whole.point(*v).z > cut));
        rest.positions.iter_mut().for_each(|p| p[2] -= cut as f32);
        // What no face uses goes to the ground's middle.
        for p in rest.positions.iter_mut().filter(|p| p[2] <= 0.0) {
            *p = [0.0; 3];
        }
        let (landmarks, girths) = measured(rest);
        for name in ["WC", "HC", "CC", "NC", "AC_L", "AC_R", "TC_L"] {
            assert!(girths.get(name).is_none(), "{name} of a body cut at {cut}");
        }
        for name in ["WC", "HC", "CC", "NC", "AC_L", "AC_R"] {
            let missing = landmarks.missing.iter().find(|m| m.name == name);
            let why = &missing.unwrap().why;
            assert!(
                why.contains("cut off"),
                "{name} of a body cut at {cut}: {why}"
            );
        }
    }
}

#[test]
fn a_trunk_that_is_nowhere_narrowest_has_its_waist_and_names_what_it_lacks() {
    let mut barrel = built(1750.0, 1.0, 35.0);
    for part in &mut barrel.parts {
        if let SolidPart::Stack { levels, .. } = part {
            for level in levels.iter_mut().filter(|l| (900.0..1250.0).contains(&l.z)) {
                level.half = [168.0, 124.0];
            }
        }
    }
    let (landmarks, girths) = measured(meshed(&barrel, 10.0));
    assert!(girths.get("WC").is_some() && girths.get("WC_narrowest").is_none());
    let missing = landmarks.missing.iter().find(|m| m.name == "WC_narrowest");
    let why = missing.map(|m| m.why.to_string()).unwrap_or_default();
    assert!(why.contains("nowhere narrowest"), "{why}");
}
