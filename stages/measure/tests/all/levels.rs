//! Levels that a body's shape defines are found where its formula has them.

use crate::made;

use made::{built, measured, meshed};
use shape::{Plane, Solid};
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
    let told = |name: &str| girths.get(name).unwrap().plane.point_mm[2];
    let back = |curve: &[nalgebra::Point3<f64>], _: &Plane| {
        curve.iter().map(|p| p.y).fold(f64::MIN, f64::max)
    };
    let hip = greatest(&solid, [0.0, 14.0 * s], (850.0 * s, 910.0 * s), back);
    let off = told("HC") - hip;
    assert!(off.abs() < 0.004 * stature, "hip {off} mm off");
    let tape = |curve: &[nalgebra::Point3<f64>], plane: &Plane| length(&taut(curve, plane));
    let calf = greatest(&solid, [103.0 * s, 14.0 * s], (280.0 * s, 400.0 * s), tape);
    for name in ["CFC_L", "CFC_R"] {
        let off = told(name) - calf;
        assert!(off.abs() < 0.012 * stature, "{name} {off} mm off");
    }
}
