//! Bodies that nobody could tape so: refused with reasons, nothing invented.

use crate::made;

use made::{built, measured, meshed};
use shape::{Girths, Landmarks, Level, Mesh, Refusal, Solid, SolidPart};

fn standing() -> Mesh {
    meshed(&built(1700.0, 1.0, 30.0), 10.0)
}

fn turned(mesh: &Mesh, to: impl Fn([f32; 3]) -> [f32; 3]) -> Mesh {
    Mesh {
        positions: mesh.positions.iter().map(|p| to(*p)).collect(),
        ..mesh.clone()
    }
}

fn limb(from: [f64; 3], to: [f64; 3], half: f64) -> SolidPart {
    SolidPart::Limb {
        from,
        to,
        half_from: [half; 2],
        half_to: [half; 2],
        round: half / 2.0,
    }
}

fn stack(levels: &[(f64, [f64; 2], [f64; 2])], round: f64) -> SolidPart {
    let level = |(z, centre, half): &(f64, [f64; 2], [f64; 2])| Level {
        z: *z,
        centre: *centre,
        half: *half,
    };
    SolidPart::Stack {
        levels: levels.iter().map(level).collect(),
        exponent: 2.3,
        furrow: None,
        round,
    }
}

/// Nothing is given, for a reason.
fn all_refused((landmarks, girths): &(Landmarks, Girths), why: Refusal) {
    let names: Vec<&str> = girths.girths.iter().map(|g| g.name.as_str()).collect();
    assert_eq!(names, [""; 0]);
    assert_eq!((girths.stature_mm, landmarks.ground_mm), (None, None));
    for name in [
        "WC", "HC", "CC", "NC", "AC_L", "AC_R", "TC_L", "CFC_R", "stature",
    ] {
        let missing = landmarks.missing.iter().find(|m| m.name == name);
        assert_eq!(missing.map(|m| m.why.as_str()), Some(why.why()), "{name}");
    }
}

#[test]
fn a_body_that_is_lying_or_upside_down_is_refused() {
    let body = standing();
    let lying = turned(&body, |[x, y, z]| [x, -z, y]);
    all_refused(&measured(lying), Refusal::NotUpright);
    let aside = turned(&body, |[x, y, z]| [z, y, -x]);
    all_refused(&measured(aside), Refusal::NotUpright);
    let headlong = turned(&body, |[x, y, z]| [x, -y, -z]);
    all_refused(&measured(headlong), Refusal::NotUpright);
}

/// A body on a seat, its feet before it; the seat is no part of it.
fn seated() -> Solid {
    let mut parts = vec![
        stack(
            &[
                (450.0, [0.0, 20.0], [160.0, 110.0]),
                (560.0, [0.0, 20.0], [172.0, 118.0]),
                (760.0, [0.0, 5.0], [140.0, 100.0]),
                (960.0, [0.0, 0.0], [154.0, 112.0]),
                (1100.0, [0.0, 8.0], [124.0, 76.0]),
                (1160.0, [0.0, 8.0], [72.0, 60.0]),
            ],
            30.0,
        ),
        limb([0.0, 6.0, 1110.0], [0.0, -10.0, 1280.0], 56.0),
        SolidPart::Ellipsoid {
            centre: [0.0, -14.0, 1300.0],
            half: [76.0, 96.0, 118.0],
        },
    ];
    for side in [1.0, -1.0] {
        parts.push(limb(
            [side * 95.0, -20.0, 530.0],
            [side * 100.0, -440.0, 530.0],
            75.0,
        ));
        parts.push(limb(
            [side * 100.0, -430.0, 540.0],
            [side * 104.0, -400.0, 40.0],
            46.0,
        ));
        parts.push(SolidPart::Ellipsoid {
            centre: [side * 108.0, -460.0, 34.0],
            half: [43.0, 122.0, 33.0],
        });
        parts.push(limb(
            [side * 170.0, 6.0, 1060.0],
            [side * 250.0, 6.0, 760.0],
            46.0,
        ));
        parts.push(limb(
            [side * 250.0, 6.0, 770.0],
            [side * 270.0, -240.0, 720.0],
            36.0,
        ));
    }
    Solid {
        parts,
        blend_mm: 24.0,
        planes: vec![],
    }
}

#[test]
fn a_body_that_sits_is_refused_on_a_stool_and_in_a_wheelchair() {
    let mut solid = seated();
    let (landmarks, girths) = measured(meshed(&solid, 12.0));
    assert!(girths.girths.is_empty(), "{:?}", landmarks.missing);
    assert!(girths.missing.iter().any(|m| m.name == "WC"));
    assert_eq!(girths.stature_mm, None);
    for side in [1.0, -1.0] {
        solid.parts.push(SolidPart::Ellipsoid {
            centre: [side * 300.0, 0.0, 300.0],
            half: [24.0, 300.0, 300.0],
        });
    }
    solid
        .parts
        .push(limb([-300.0, 0.0, 430.0], [300.0, 0.0, 430.0], 40.0));
    let (_, girths) = measured(meshed(&solid, 12.0));
    assert!(girths.girths.is_empty());
    assert_eq!(girths.stature_mm, None);
}

#[test]
fn under_a_coat_there_are_no_legs_to_tell_levels_from() {
    let mut coat = built(1700.0, 1.0, 30.0);
    coat.parts.push(stack(
        &[
            (480.0, [0.0, 0.0], [240.0, 190.0]),
            (800.0, [0.0, 0.0], [215.0, 165.0]),
            (1340.0, [0.0, 0.0], [175.0, 130.0]),
        ],
        20.0,
    ));
    all_refused_but_ground(&measured(meshed(&coat, 10.0)));
    let mut skirt = built(1700.0, 1.0, 30.0);
    skirt.parts.push(stack(
        &[
            (40.0, [0.0, 0.0], [260.0, 240.0]),
            (1000.0, [0.0, 0.0], [170.0, 120.0]),
        ],
        10.0,
    ));
    all_refused_but_ground(&measured(meshed(&skirt, 10.0)));
}

/// Nothing is given because there are no legs.
fn all_refused_but_ground((_, girths): &(Landmarks, Girths)) {
    let names: Vec<&str> = girths.girths.iter().map(|g| g.name.as_str()).collect();
    assert_eq!(names, [""; 0]);
    assert_eq!(girths.stature_mm, None);
    for name in ["WC", "HC", "CC", "NC"] {
        let missing = girths.missing.iter().find(|m| m.name == name);
        assert!(
            missing.is_some_and(|m| m.why.contains("no two legs") && m.reason == Refusal::NoLegs),
            "{name}: {missing:?}"
        );
    }
}

#[test]
fn a_dress_form_on_its_pole_has_no_stature_and_no_levels() {
    let form = Solid {
        parts: vec![
            stack(
                &[
                    (775.0, [0.0, 6.0], [150.0, 95.0]),
                    (880.0, [0.0, 14.0], [172.0, 118.0]),
                    (1060.0, [0.0, 0.0], [136.0, 98.0]),
                    (1280.0, [0.0, -2.0], [154.0, 112.0]),
                    (1440.0, [0.0, 8.0], [124.0, 76.0]),
                    (1530.0, [0.0, 8.0], [60.0, 58.0]),
                ],
                20.0,
            ),
            limb([0.0, 6.0, 800.0], [0.0, 6.0, 20.0], 25.0),
            stack(
                &[
                    (0.0, [0.0; 2], [200.0, 200.0]),
                    (40.0, [0.0; 2], [200.0, 200.0]),
                ],
                8.0,
            ),
        ],
        blend_mm: 20.0,
        planes: vec![],
    };
    all_refused_but_ground(&measured(meshed(&form, 10.0)));
}

#[test]
fn crossed_arms_are_in_no_girth_of_the_trunk() {
    let free = measured(meshed(&built(1700.0, 1.0, 30.0), 10.0)).1;
    let s = 1700.0 / 1750.0;
    for height in [1240.0, 1150.0] {
        let mut crossed = built(1700.0, 1.0, 30.0);
        // Shoulders stay; upper arms hang at the sides, forearms are across the trunk's front.
        crossed.parts.retain(|part| match part {
            SolidPart::Limb { from, .. } => from[0].abs() < 100.0,
            _ => true,
        });
        for side in [1.0, -1.0] {
            let elbow = [side * 175.0 * s, -30.0, height * s];
            crossed
                .parts
                .push(limb([side * 165.0 * s, 6.0, 1390.0 * s], elbow, 44.0));
            let hand = [-side * 110.0 * s, -150.0, (height + 40.0) * s];
            crossed.parts.push(limb(elbow, hand, 34.0));
        }
        let girths = measured(meshed(&crossed, 10.0)).1;
        for name in ["WC", "CC", "HC", "WC_navel"] {
            let Some(girth) = girths.get(name) else {
                assert!(girths.missing.iter().any(|m| m.name == name), "{name}");
                continue;
            };
            let own = free.get(name).unwrap().tape_mm;
            let [low, high] = girth.interval_mm.unwrap_or([f64::NAN; 2]);
            assert!(
                (girth.tape_mm / own - 1.0).abs() < 0.03 && low <= high,
                "{name} with arms at {height}: {} for {own}",
                girth.tape_mm
            );
        }
        for name in ["AC_L", "AC_R"] {
            assert!(
                girths.get(name).is_none(),
                "{name} of arms that touch the trunk"
            );
        }
    }
}
