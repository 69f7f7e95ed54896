//! Arms that touch the trunk, or are one with it, from the armpit to the hand: what is given is given as if they hung free.

use crate::made;

use made::{built, measured, meshed};
use shape::SolidPart;
use synth::{contour, length, taut};

#[test]
fn arms_that_are_one_with_the_trunk_are_no_part_of_its_girths() {
    let of = |arms_deg: f64, cell: f64| measured(meshed(&built(1700.0, 1.0, arms_deg), cell)).1;
    let free = of(30.0, 8.0);
    for (arms_deg, cell) in [(7.0, 8.0), (8.0, 6.0), (10.0, 8.0)] {
        let girths = of(arms_deg, cell);
        let mut given = 0;
        for name in [
            "HC", "HC_max", "WC", "WC_navel", "CC", "TC_L", "TC_R", "CFC_L", "CFC_R",
        ] {
            let own = free.get(name).unwrap().tape_mm;
            let Some(girth) = girths.get(name) else {
                continue;
            };
            let off = girth.tape_mm / own - 1.0;
            assert!(off.abs() < 0.015, "{name} at {arms_deg} degrees: {off}");
            given += 1;
        }
        assert!(
            given >= 4 && girths.get("WC").is_some(),
            "{:?}",
            girths.missing
        );
    }
}

#[test]
fn no_girth_of_the_trunk_is_narrower_than_the_narrowest_with_arms_at_it_or_away() {
    let mut seen = 0;
    for (arms_deg, cell) in [(30.0, 8.0), (10.0, 8.0), (8.0, 6.0), (7.0, 8.0)] {
        let girths = measured(meshed(&built(1700.0, 1.0, arms_deg), cell)).1;
        let Some(narrow) = girths.get("WC_narrowest") else {
            continue;
        };
        for name in ["WC", "WC_navel", "WC_hip_bone"] {
            let other = girths.get(name).map_or(f64::MAX, |g| g.tape_mm);
            assert!(
                narrow.tape_mm <= other,
                "{name} at {arms_deg} degrees: {other} of {}",
                narrow.tape_mm
            );
        }
        seen += 1;
    }
    assert!(seen >= 3, "{seen}");
}

/// Upper arms that are flat at the shoulder and deep above the elbow, as muscles make them.
#[test]
fn an_arm_that_is_clear_is_taken_whole_whether_round_or_not() {
    let mut solid = built(1750.0, 1.0, 35.0);
    for part in &mut solid.parts {
        if let SolidPart::Limb {
            from,
            half_from,
            half_to,
            ..
        } = part
            && from[0].abs() > 130.0
            && from[2] > 1300.0
        {
            (*half_from, *half_to) = ([58.0, 36.0], [34.0, 48.0]);
        }
    }
    let girths = measured(meshed(&solid, 5.0)).1;
    for name in ["AC_L", "AC_R"] {
        let girth = girths.get(name).unwrap();
        let own = contour(&solid, &girth.plane).unwrap();
        let own = length(&taut(&own, &girth.plane));
        assert!(girth.split.is_none(), "{name}");
        proof::near(girth.tape_mm / own, 1.0, 0.01);
    }
}
