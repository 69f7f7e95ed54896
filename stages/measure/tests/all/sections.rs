//! Sections, tapes and splines against solids whose girths are formulas.

use measure::{
    BadPoints, area, fitted_plane, flat, length, paper_girth, picked, rings, section, tape,
};
use nalgebra::{Point3, Rotation3, Vector3};
use shape::{Mesh, Plane};
use std::f64::consts::{PI, TAU};

/// A closed ellipsoid about the origin, of rings and sectors. \[mm\]
fn ellipsoid(half_mm: [f64; 3], rings: u32, sectors: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut put = |x: f64, y: f64, z: f64| {
        let at = [half_mm[0] * x, half_mm[1] * y, half_mm[2] * z];
        mesh.positions.push(at.map(|c| c as f32));
    };
    put(0.0, 0.0, -1.0);
    for r in 1..rings {
        let (s, c) = libm::sincos(PI * f64::from(r) / f64::from(rings));
        for k in 0..sectors {
            let (y, x) = libm::sincos(TAU * f64::from(k) / f64::from(sectors));
            put(s * x, s * y, -c);
        }
    }
    put(0.0, 0.0, 1.0);
    let at = |r: u32, k: u32| 1 + (r - 1) * sectors + k % sectors;
    let top = 1 + (rings - 1) * sectors;
    for k in 0..sectors {
        mesh.faces.push([0, at(1, k + 1), at(1, k)]);
        for r in 1..rings - 1 {
            let (a, b, c, d) = (at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k));
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
        mesh.faces
            .push([top, at(rings - 1, k), at(rings - 1, k + 1)]);
    }
    mesh
}

/// Perimeter of an ellipse by the trapezoidal rule, which is exact here to rounding.
fn ellipse(a: f64, b: f64) -> f64 {
    const N: u32 = 4096;
    let speed = |k: u32| {
        let (s, c) = libm::sincos(TAU * f64::from(k) / f64::from(N));
        libm::hypot(a * s, b * c)
    };
    (0..N).map(speed).sum::<f64>() * TAU / f64::from(N)
}

fn plane(point_mm: [f64; 3], normal: [f64; 3]) -> Plane {
    Plane { point_mm, normal }
}

#[test]
fn the_solid_of_these_tests_is_closed_and_outward() {
    let mesh = ellipsoid([150.0, 100.0, 200.0], 60, 120);
    mesh.validate_closed().unwrap();
    proof::near(mesh.volume() / (4.0 / 3.0 * PI * 3e6), 1.0, 3e-3);
}

#[test]
fn the_waist_of_an_ellipsoid_is_an_ellipse_to_a_hundredth_of_a_percent() {
    let mesh = ellipsoid([150.0, 100.0, 200.0], 360, 720);
    // At z = 120 of 200 the half-axes shrink to 0.8.
    let cut = plane([0.0, 0.0, 120.0], [0.0, 0.0, 1.0]);
    let loops = section(&mesh, &cut);
    assert_eq!(loops.len(), 1);
    let points = flat(&loops[0], &cut);
    proof::near(length(&points) / ellipse(120.0, 80.0), 1.0, 1e-4);
    proof::near(tape(&points) / ellipse(120.0, 80.0), 1.0, 1e-4);
    proof::near(area(&points).abs() / (PI * 120.0 * 80.0), 1.0, 2e-4);
}

#[test]
fn a_plane_through_vertices_and_edges_still_gives_one_closed_curve() {
    let mesh = ellipsoid([100.0, 100.0, 100.0], 40, 80);
    for normal in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        let cut = plane([0.0; 3], normal);
        let loops = section(&mesh, &cut);
        assert_eq!(loops.len(), 1, "normal {normal:?}");
        proof::near(length(&flat(&loops[0], &cut)) / (TAU * 100.0), 1.0, 2e-3);
    }
    // The pole is one vertex, and the plane in it cuts nothing of a length.
    let pole = plane([0.0, 0.0, 100.0], [0.0, 0.0, 1.0]);
    let around: f64 = section(&mesh, &pole)
        .iter()
        .map(|c| length(&flat(c, &pole)))
        .sum();
    assert!(around < 1e-6, "{around}");
}

#[test]
fn a_plane_beside_the_body_or_a_mesh_of_nothing_gives_no_curve() {
    let mesh = ellipsoid([100.0, 100.0, 100.0], 20, 40);
    assert!(rings(&mesh, &plane([0.0, 0.0, 300.0], [0.0, 0.0, 1.0])).is_empty());
    assert!(rings(&Mesh::default(), &plane([0.0; 3], [0.0, 0.0, 1.0])).is_empty());
    assert!(fitted_plane(&[Point3::origin(); 2]).is_none());
}

#[test]
fn a_girth_does_not_depend_on_how_the_body_is_turned_and_shifted() {
    let mesh = ellipsoid([150.0, 100.0, 200.0], 90, 180);
    let first = rings(&mesh, &plane([0.0, 0.0, 40.0], [0.0, 0.0, 1.0]));
    let mut dice = proof::Dice(7);
    for _ in 0..20 {
        let angles = [0, 1, 2].map(|_| dice.within(-PI, PI));
        let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
        let shift = Vector3::from([0, 1, 2].map(|_| dice.within(-500.0, 500.0)));
        let mut turned = mesh.clone();
        for (v, to) in (0..).zip(&mut turned.positions) {
            *to = (turn * mesh.point(v) + shift)
                .coords
                .map(|c| c as f32)
                .into();
        }
        let middle = turn * Point3::new(0.0, 0.0, 40.0) + shift;
        let cut = plane(middle.into(), (turn * Vector3::z()).into());
        let again = rings(&turned, &cut);
        assert_eq!(again.len(), 1);
        proof::near(again[0].tape / first[0].tape, 1.0, 1e-5);
        proof::near(again[0].area / first[0].area, 1.0, 1e-5);
    }
}

#[test]
fn a_tape_bridges_a_hollow_and_is_never_longer_than_the_contour() {
    // A circle with a hollow of half its radius: the tape is the chord, not the way in.
    let hollow: Vec<[f64; 2]> = (0..720)
        .map(|k| TAU * f64::from(k) / 720.0)
        .map(|t| {
            (
                t,
                if t < 1.0 {
                    100.0 - 50.0 * libm::sin(PI * t)
                } else {
                    100.0
                },
            )
        })
        .map(|(t, r)| [r * libm::cos(t), r * libm::sin(t)])
        .collect();
    assert!(tape(&hollow) < length(&hollow));
    proof::near(
        tape(&hollow),
        100.0 * (TAU - 1.0) + 200.0 * libm::sin(0.5_f64),
        0.1,
    );
    let mut dice = proof::Dice(3);
    for _ in 0..50 {
        let star: Vec<[f64; 2]> = (0..60)
            .map(|k| (TAU * f64::from(k) / 60.0, dice.within(20.0, 100.0)))
            .map(|(t, r)| [r * libm::cos(t), r * libm::sin(t)])
            .collect();
        assert!(tape(&star) <= length(&star) + 1e-9);
    }
}

#[test]
fn the_papers_procedure_agrees_with_the_exact_curve_on_a_smooth_body() {
    let mesh = ellipsoid([150.0, 100.0, 400.0], 400, 400);
    let cut = plane([0.0, 0.0, 10.0], [0.0, 0.0, 1.0]);
    let exact = &rings(&mesh, &cut)[0];
    let paper = paper_girth(&mesh, &exact.curve).unwrap();
    proof::near(paper / exact.tape, 1.0, 2e-3);
}

#[test]
fn points_picked_by_hand_give_the_papers_girth_through_them() {
    let mesh = ellipsoid([150.0, 100.0, 200.0], 120, 240);
    // Six points about the level z = 50, each a little off it, as a hand picks them.
    let k = (1.0 - (50.0f64 / 200.0).powi(2)).sqrt();
    let points: Vec<Vec<f64>> = (0..6)
        .map(|i| {
            let (s, c) = libm::sincos(TAU * f64::from(i) / 6.0);
            let off = if i % 2 == 0 { 0.4 } else { -0.4 };
            vec![150.0 * k * c, 100.0 * k * s, 50.0 + off]
        })
        .collect();
    let girth = picked(&mesh, &points).unwrap();
    let truth = ellipse(150.0 * k, 100.0 * k);
    proof::near(girth.contour_mm / truth, 1.0, 2e-3);
    proof::near(girth.spline_mm / truth, 1.0, 3e-3);
    proof::near(girth.plane.normal[2], 1.0, 1e-3);
}

#[test]
fn picked_points_that_tell_no_girth_are_refused_in_words() {
    let mesh = ellipsoid([150.0, 100.0, 200.0], 40, 80);
    let line: Vec<Vec<f64>> = (0..4)
        .map(|i| vec![f64::from(i) * 20.0, 0.0, 0.0])
        .collect();
    assert_eq!(picked(&mesh, &line), Err(BadPoints::NoPlane));
    assert_eq!(picked(&mesh, &[vec![1.0, 2.0]]), Err(BadPoints::NotThree));
    let far: Vec<Vec<f64>> = (0..5)
        .map(|i| libm::sincos(TAU * f64::from(i) / 5.0))
        .map(|(s, c)| vec![9e3 + 50.0 * c, 50.0 * s, 9e3])
        .collect();
    assert_eq!(picked(&mesh, &far), Err(BadPoints::NoSection));
}
