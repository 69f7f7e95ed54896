//! Arms that come nearer and nearer to the trunk: no girth jumps where they touch, and its interval covers it on either side.

use crate::made;

use made::{Given, built, meshed};
use proof::Dice;
use shape::{Girth, Mesh, NINE_IN_TEN, Solid, SolidPart};
use std::sync::Arc;
use synth::{contour, length, taut};

const CELL: f64 = 6.0;

/// The arms alone.
fn arms(solid: &Solid) -> Solid {
    let mut arms = solid.clone();
    arms.parts.retain(|part| matches!(part, SolidPart::Limb { from, .. } if from[0].abs() > 130.0 && from[2] > 900.0));
    arms
}

/// The surface with an error of its own: smooth, as one of photos, so large. \[mm\]
pub(crate) fn noisy(mesh: &Mesh, mm: f64, seed: u64) -> Mesh {
    let mut dice = Dice(seed);
    let waves: Vec<([f64; 3], f64)> = (0..24)
        .map(|_| {
            (
                [(); 3].map(|()| dice.within(-0.1, 0.1)),
                dice.within(0.0, 6.3),
            )
        })
        .collect();
    let normals = mesh.normals();
    let mut out = mesh.clone();
    for (p, n) in out.positions.iter_mut().zip(&normals) {
        let at = p.map(f64::from);
        let wave = |(k, phase): &([f64; 3], f64)| {
            libm::sin(k.iter().zip(at).map(|(k, x)| k * x).sum::<f64>() + phase)
        };
        let by = mm * waves.iter().map(wave).sum::<f64>() / 12f64.sqrt();
        for (p, n) in p.iter_mut().zip(n.iter()) {
            *p += (by * n) as f32;
        }
    }
    out
}

/// Arms so far from the sides, and the surface. \[tenths of a degree\]
fn body(tenths: u32) -> (u32, Solid, Given) {
    let solid = built(1700.0, 1.0, f64::from(tenths) / 10.0);
    let mesh = noisy(&meshed(&solid, CELL), 0.6, u64::from(tenths));
    (tenths, solid, Given::of(&mesh))
}

/// What is measured, each with the true tape of its plane.
fn measured((tenths, solid, body): &(u32, Solid, Given), carved: bool) -> Vec<(Girth, f64)> {
    let given = Given {
        masks: carved.then(Arc::default),
        mesh: body.mesh.clone(),
        found: body.features().into(),
        ..Given::default()
    };
    let girths = given.measured().1;
    let own = |name: &&str| {
        let girth = girths
            .get(name)
            .unwrap_or_else(|| panic!("{name} at {tenths}: {:?}", girths.missing));
        let alone = if name.starts_with("AC") {
            arms(solid)
        } else {
            built(1700.0, 1.0, 60.0)
        };
        let tape = length(&taut(&contour(&alone, &girth.plane).unwrap(), &girth.plane));
        (girth.clone(), tape)
    };
    ["AC_L", "AC_R", "CC"].iter().map(own).collect()
}

#[test]
fn no_girth_jumps_where_an_arm_comes_to_touch_the_trunk() {
    // The middle of an upper arm is from two edges within the trunk's skin to two before it.
    let bodies: Vec<_> = (240..=330).step_by(10).map(body).collect();
    for carved in [false, true] {
        let all: Vec<_> = bodies.iter().map(|b| measured(b, carved)).collect();
        for (n, row) in all.iter().enumerate() {
            for (g, own) in row {
                println!(
                    "{carved} {n} {} {:+.2} half {:.2} again {:.2} level {:?} split {:?}",
                    g.name,
                    g.tape_mm - own,
                    g.interval_mm.map_or(0.0, |[l, h]| (h - l) / 2.0),
                    g.repeat_mm.unwrap(),
                    g.sigmas.level_mm,
                    g.sigmas.split_mm
                );
            }
        }
        let mut inside = Vec::new();
        for (girth, own) in all.iter().flatten() {
            let [low, high] = girth.interval_mm.unwrap();
            inside.push((low..=high).contains(own));
        }
        for pair in all.windows(2) {
            for ((a, own_a), (b, own_b)) in pair[0].iter().zip(&pair[1]) {
                let again = libm::hypot(a.repeat_mm.unwrap(), b.repeat_mm.unwrap());
                let jump = (b.tape_mm - own_b) - (a.tape_mm - own_a);
                assert!(jump.abs() < again, "{} by {jump}, again {again}", a.name);
                let [from, to] = [a, b].map(|g| NINE_IN_TEN * g.sigmas.split_mm.unwrap());
                assert!(
                    (to - from).abs() < again,
                    "{}: {from} to {to}, again {again}",
                    a.name
                );
            }
        }
        let share = inside.iter().filter(|i| **i).count() as f64 / inside.len() as f64;
        assert!(share >= 0.9, "{share}");
        let split = |i: usize| all[i][0].0.split.is_some();
        assert!(split(0) && (carved || !split(all.len() - 1)));
    }
}
