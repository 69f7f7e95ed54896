//! No girth hangs on what it does not need: where thighs touch or a leg is lost, the trunk is measured as if they did not.

use crate::made;

use made::{Given, built, meshed};
use shape::{Girths, Level, Mesh, Refusal, Scale, Solid, SolidPart};

const TALL: f64 = 1700.0;

/// Girths that need no legs.
const TRUNK: [&str; 9] = [
    "HC",
    "HC_max",
    "WC",
    "WC_navel",
    "WC_hip_bone",
    "CC",
    "NC",
    "AC_L",
    "AC_R",
];

fn stack(levels: &[(f64, [f64; 2])]) -> SolidPart {
    let level = |(z, half): &(f64, [f64; 2])| Level {
        z: *z,
        centre: [0.0, 5.0],
        half: *half,
    };
    SolidPart::Stack {
        levels: levels.iter().map(level).collect(),
        exponent: 2.3,
        furrow: None,
        round: 20.0,
    }
}

/// A body between whose legs all is filled down to a height. \[mm\]
fn touching(stout: f64, down_to: f64) -> Solid {
    let mut solid = built(TALL, stout, 30.0);
    solid.parts.push(stack(&[
        (down_to, [70.0, 40.0]),
        (600.0, [70.0, 55.0]),
        (790.0, [70.0, 60.0]),
    ]));
    solid
}

/// What is measured of a surface; `firm` has it on a mat at nought.
fn measured(mesh: Mesh, firm: bool) -> Girths {
    let cameras = made::cameras(Scale::Mat, Some(0.001), 0.0);
    match firm {
        true => Given::on(&mesh, cameras).at_any_width(),
        false => Given::of(&mesh).at_any_width(),
    }
}

#[track_caller]
fn refused(girths: &Girths, name: &str, reason: Refusal) {
    assert!(girths.get(name).is_none(), "{name}");
    let missing = girths.missing.iter().find(|m| m.name == name);
    assert_eq!(missing.map(|m| m.reason), Some(reason), "{name}");
}

#[track_caller]
fn as_of(girths: &Girths, free: &Girths, names: &[&str], within: f64) {
    for name in names {
        let own = free.get(name).map(|g| g.tape_mm);
        let got = girths.get(name).map(|g| g.tape_mm);
        let off = got.zip(own).map(|(got, own)| (got / own - 1.0).abs());
        assert!(
            off.is_some_and(|off| off < within),
            "{name}: {got:?} for {own:?}, {:?}",
            girths.missing
        );
    }
}

#[test]
fn thighs_that_touch_to_the_knee_or_the_calf_are_parted_or_cost_the_thighs_alone() {
    let mut parted = 0;
    for stout in [1.0, 1.3] {
        let free = measured(meshed(&built(TALL, stout, 30.0), 10.0), false);
        for down_to in [600.0, 470.0, 330.0] {
            let girths = measured(meshed(&touching(stout, down_to), 10.0), false);
            let arms = |name: &&&str| !name.starts_with("AC") || free.get(name).is_some();
            let trunk: Vec<&str> = TRUNK.iter().filter(arms).copied().collect();
            as_of(&girths, &free, &trunk, 0.005);
            for name in ["TC_L", "TC_R"] {
                let own = free.get(name).unwrap().tape_mm;
                let Some(girth) = girths.get(name) else {
                    refused(&girths, name, Refusal::ThighsOne);
                    continue;
                };
                // What fills the gap is the thighs' here. Where no half shows below, no level tells an interval.
                let tape = girth.tape_mm;
                assert!(tape > own && tape < 1.2 * own, "{own}: {tape}");
                assert!(girth.split.is_some());
                let wide = girth.interval_mm.map(|[low, high]| high - low);
                assert!(wide.is_none_or(|mm| mm > 0.03 * own), "{own}: {wide:?}");
                parted += 1;
            }
            for name in ["CFC_L", "CFC_R"] {
                match girths.get(name) {
                    Some(_) => as_of(&girths, &free, &[name], 0.02),
                    None => refused(&girths, name, Refusal::NoPeak),
                }
            }
            assert_eq!(girths.stature_mm.is_some(), free.stature_mm.is_some());
        }
    }
    assert!(parted > 0);
}

#[test]
fn thighs_measured_below_a_web_have_intervals_that_hold_the_thigh_without_it() {
    let free = measured(meshed(&built(TALL, 1.0, 30.0), 10.0), false);
    let mut hidden = 0;
    for down_to in [760.0, 670.0] {
        let girths = measured(meshed(&touching(1.0, down_to), 10.0), false);
        for name in ["TC_L", "TC_R"] {
            let own = free.get(name).unwrap().tape_mm;
            let girth = girths.get(name).unwrap();
            let [low, high] = girth.interval_mm.unwrap();
            assert!((low..=high).contains(&own), "{own}: {low} {high}");
            let (up, down) = (high - girth.tape_mm, girth.tape_mm - low);
            hidden += usize::from(up > 1.5 * down);
        }
    }
    assert!(hidden > 0);
}

#[test]
fn a_fault_of_the_surface_between_the_thighs_costs_none() {
    let whole = meshed(&built(TALL, 1.0, 30.0), 6.0);
    let free = measured(whole.clone(), false);
    let thigh = free.get("TC_L").unwrap();
    let level = thigh.plane.point_mm[2] as f32 - 5.0;
    for pulled in [18.0, 20.0, 22.0] {
        let mut mesh = whole.clone();
        let near = |p: &&mut [f32; 3]| p[1].abs() < 40.0 && (p[2] - level).abs() < 6.0;
        let inner = mesh.positions.iter_mut().filter(|p| p[0] > 0.0 && near(p));
        inner.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap()[0] -= pulled;
        let girths = measured(mesh, false);
        as_of(&girths, &free, &["TC_L", "TC_R"], 0.02);
    }
}

#[test]
fn a_lost_leg_costs_the_legs_alone() {
    let whole = meshed(&built(TALL, 1.0, 30.0), 10.0);
    let mut one = whole.clone();
    for p in one.positions.iter_mut().filter(|p| p[0] > 0.0) {
        p[2] = p[2].max(620.0);
    }
    let (girths, free) = (measured(one, false), measured(whole, false));
    as_of(&girths, &free, &TRUNK, 0.02);
    for name in ["TC_L", "TC_R", "CFC_L", "CFC_R"] {
        refused(&girths, name, Refusal::NoLegs);
    }
}

#[test]
fn under_a_skirt_to_the_floor_what_is_above_it_is_measured_with_wider_levels() {
    let free = measured(meshed(&built(TALL, 1.0, 30.0), 10.0), true);
    let mut skirt = built(TALL, 1.0, 30.0);
    skirt
        .parts
        .push(stack(&[(15.0, [215.0, 200.0]), (1000.0, [172.0, 122.0])]));
    let girths = measured(meshed(&skirt, 10.0), true);
    as_of(
        &girths,
        &free,
        &["WC", "WC_narrowest", "CC", "NC", "AC_L", "AC_R"],
        0.02,
    );
    let level = |girths: &Girths, name: &str| girths.get(name).unwrap().sigmas.level_mm.unwrap();
    assert!(level(&girths, "WC") > 1.05 * level(&free, "WC"));
    for name in ["HC", "TC_L", "CFC_R"] {
        refused(&girths, name, Refusal::NoLegs);
    }
}

/// A body whose back is straight from the shins to the shoulder blades.
#[test]
fn a_hip_that_does_not_show_is_where_the_rest_of_the_body_puts_it_and_is_as_unsure() {
    let free = measured(meshed(&built(TALL, 1.0, 30.0), 10.0), true);
    let mut flat = touching(1.0, 330.0);
    flat.parts.push(SolidPart::Limb {
        from: [0.0, 80.0, 400.0],
        to: [0.0, 60.0, 1250.0],
        half_from: [60.0, 90.0],
        half_to: [60.0, 90.0],
        round: 20.0,
    });
    let girths = measured(meshed(&flat, 10.0), true);
    let hip = girths.get("HC").unwrap();
    let own = free.get("HC").unwrap();
    let z = |g: &shape::Girth| g.plane.point_mm[2];
    let unsure = [hip, own].map(|g| g.sigmas.level_mm.unwrap());
    assert!((z(hip) - z(own)).abs() < 0.035 * TALL, "{}", z(hip));
    assert!(unsure[0] > unsure[1], "{unsure:?}");
    assert!(girths.get("HC_max").is_none());
}

#[test]
fn a_body_that_is_cut_off_has_no_girth_at_all() {
    let whole = meshed(&built(1750.0, 1.0, 30.0), 10.0);
    for cut in [420.0, 500.0, 600.0, 750.0, 1000.0] {
        let mut rest = whole.clone();
        for p in &mut rest.positions {
            p[2] = (p[2] - cut as f32).max(0.0);
        }
        for firm in [false, true] {
            let girths = measured(rest.clone(), firm);
            let names: Vec<&str> = girths.girths.iter().map(|g| g.name.as_str()).collect();
            assert_eq!((names, girths.stature_mm), (vec![], None), "cut at {cut}");
        }
    }
}
