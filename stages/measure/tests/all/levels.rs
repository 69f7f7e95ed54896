//! Levels that a body's shape defines are found where its formula has them.

use crate::made;

use crate::nearly_touching::noisy;
use made::{built, measured, meshed};
use shape::{Girths, Level, Mesh, Plane, Solid, SolidPart};
use synth::{contour, length, taut};

/// The height between two at which a measure of a solid's level section is greatest. \[mm\]
fn greatest(
    solid: &Solid,
    at: [f64; 2],
    (low, high): (f64, f64),
    size: impl Fn(&[nalgebra::Point3<f64>], &Plane) -> f64,
) -> f64 {
    let measure = |z: f64| {
        let plane = Plane {
            point_mm: [at[0], at[1], z],
            normal: [0.0, 0.0, 1.0],
        };
        contour(solid, &plane).map_or(0.0, |curve| size(&curve, &plane))
    };
    let heights = (0..=16).map(|i| low + (high - low) * f64::from(i) / 16.0);
    let all: Vec<(f64, f64)> = heights.map(|z| (z, measure(z))).collect();
    let best = all.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    best.0
}

#[test]
fn the_hip_is_where_the_buttocks_reach_farthest_and_the_calf_where_it_is_fullest() {
    let (stature, stout) = (1500.0, 1.2);
    let solid = built(stature, stout, 32.0);
    let girths = measured(meshed(&solid, 8.0 * stature / 1700.0)).1;
    let s = stature / 1750.0;
    let reported = |name: &str| girths.get(name).unwrap().plane.point_mm[2];
    let back = |curve: &[nalgebra::Point3<f64>], _: &Plane| {
        curve.iter().map(|p| p.y).fold(f64::MIN, f64::max)
    };
    let hip = greatest(&solid, [0.0, 14.0 * s], (850.0 * s, 910.0 * s), back);
    let off = reported("HC") - hip;
    assert!(off.abs() < 0.004 * stature, "hip {off} mm off");
    let tape = |curve: &[nalgebra::Point3<f64>], plane: &Plane| length(&taut(curve, plane));
    let calf = greatest(&solid, [103.0 * s, 14.0 * s], (280.0 * s, 400.0 * s), tape);
    for name in ["CFC_L", "CFC_R"] {
        let off = reported(name) - calf;
        assert!(off.abs() < 0.012 * stature, "{name} {off} mm off");
    }
}

/// Shanks that grow from the ankle to the knee, with a stretch on the way where they hardly do.
fn growing() -> Mesh {
    let mut solid = built(1700.0, 1.0, 32.0);
    let shank = [
        (100.0, 36.0),
        (200.0, 45.0),
        (280.0, 46.0),
        (360.0, 47.0),
        (480.0, 60.0),
    ];
    for part in &mut solid.parts {
        let SolidPart::Stack { levels, .. } = part else {
            continue;
        };
        if levels[0].z > 100.0 {
            continue;
        }
        let [x, y] = levels[2].centre;
        let above = levels.split_off(4);
        levels.truncate(1);
        levels.extend(shank.map(|(z, half)| Level {
            z,
            centre: [x, y],
            half: [half; 2],
        }));
        levels.extend(above);
    }
    meshed(&solid, 8.0)
}

/// All above the feet higher by so much: steps up the legs begin elsewhere. \[mm\]
fn raised(mesh: &Mesh, mm: f32) -> Mesh {
    let mut out = mesh.clone();
    for p in &mut out.positions {
        p[2] += mm * ((p[2] - 40.0) / 30.0).clamp(0.0, 1.0);
    }
    out
}

#[test]
fn a_calf_above_which_nothing_narrows_is_given_however_the_surface_is_moved() {
    let mesh = growing();
    let noise = (1..4).map(|seed| noisy(&mesh, 0.05, seed));
    let all = noise.chain([0.0, 0.3, 1.0, 2.2].map(|mm| raised(&mesh, mm)));
    let all: Vec<Girths> = all.map(|mesh| measured(mesh).1).collect();
    for name in ["CFC_L", "CFC_R"] {
        let tapes: Vec<f64> = all.iter().map(|g| g.get(name).unwrap().tape_mm).collect();
        let (low, high) = tapes
            .iter()
            .fold((f64::MAX, 0.0f64), |e, t| (e.0.min(*t), e.1.max(*t)));
        assert!(high / low < 1.003, "{name}: {tapes:?}");
        let [low, high] = all[3].get(name).unwrap().interval_mm.unwrap();
        let stretch = std::f64::consts::TAU * 46.0;
        assert!((low..=high).contains(&stretch), "{name}: {low} to {high}");
    }
}
