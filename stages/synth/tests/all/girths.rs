//! Girths by formula are closed forms where there are any, and those of the mesh everywhere.

use nalgebra::{Point3, Vector3};
use proof::Dice;
use shape::{Plane, Solid};
use stage::{Ctx, Params, Stage, Value};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;
use synth::{FormulaGirths, FormulaInput, MakeSolid, SolidInput, contour, length, surface, taut};

fn solid(figure: &str, values: &[(&str, f64)]) -> Solid {
    let mut stated: BTreeMap<String, Value> = values
        .iter()
        .map(|(k, v)| ((*k).to_owned(), Value::Float(*v)))
        .collect();
    stated.insert("figure".into(), Value::Text(figure.into()));
    MakeSolid::run(
        &Params::read(&stated).unwrap(),
        SolidInput {},
        &Ctx::alone(),
    )
    .unwrap()
}

fn planes(solid: &Solid) -> Vec<(String, Plane)> {
    let plane = |(name, point_mm, normal): &(String, [f64; 3], [f64; 3])| {
        let plane = Plane {
            point_mm: *point_mm,
            normal: *normal,
        };
        (name.clone(), plane)
    };
    solid.planes.iter().map(plane).collect()
}

/// Perimeter of |x/a|ⁿ + |y/b|ⁿ = 1 from its own parametrisation.
fn superellipse(a: f64, b: f64, n: f64) -> f64 {
    const STEPS: u32 = 200_000;
    let at = |k: u32| {
        let (s, c) = libm::sincos(FRAC_PI_2 * f64::from(k) / f64::from(STEPS));
        (
            a * libm::pow(c.max(0.0), 2.0 / n),
            b * libm::pow(s, 2.0 / n),
        )
    };
    let piece = |k: u32| {
        let ((x, y), (u, v)) = (at(k), at(k + 1));
        libm::hypot(u - x, v - y)
    };
    4.0 * (0..STEPS).map(piece).sum::<f64>()
}

/// Perimeter of an ellipse by the arithmetic-geometric mean (Gauss 1818).
fn ellipse(a: f64, b: f64) -> f64 {
    // The first term is c₀² = a² - b², with weight 1/2; the rest are c²ₙ 2ⁿ⁻¹ with cₙ = (x - y)/2.
    let (mut x, mut y, mut power, mut sum) = (a, b, 1.0, (a * a - b * b) / 2.0);
    for _ in 0..40 {
        let c = (x - y) / 2.0;
        (x, y) = ((x + y) / 2.0, (x * y).sqrt());
        sum += power * c * c;
        power *= 2.0;
    }
    TAU * (a * a - sum) / x
}

#[test]
fn cylinders_have_the_perimeters_of_their_superellipses() {
    proof::near(ellipse(100.0, 100.0), 200.0 * PI, 1e-9);
    let mut dice = Dice(5);
    for n in [2.0, 2.3, 3.0, 4.0] {
        let (a, b) = (dice.within(60.0, 200.0), dice.within(60.0, 200.0));
        let sizes = [("wide_mm", a), ("deep_mm", b), ("exponent", n)];
        let solid = solid("cylinder", &sizes);
        let (_, plane) = &planes(&solid)[0];
        let got = length(&contour(&solid, plane).unwrap());
        proof::near(got / superellipse(a, b, n), 1.0, 1e-6);
        if n == 2.0 {
            proof::near(got / ellipse(a.max(b), a.min(b)), 1.0, 1e-6);
        }
    }
}

#[test]
fn ellipsoids_and_tori_have_the_girths_of_their_formulas() {
    let sizes = [("wide_mm", 150.0), ("deep_mm", 90.0), ("stature_mm", 400.0)];
    let egg = solid("ellipsoid", &sizes);
    // At 120 of 200 above the middle the half-axes shrink to 0.8.
    let plane = Plane {
        point_mm: [5.0, -3.0, 320.0],
        normal: [0.0, 0.0, 1.0],
    };
    let got = length(&contour(&egg, &plane).unwrap());
    proof::near(got / ellipse(120.0, 72.0), 1.0, 1e-6);
    let torus = solid("torus", &[("wide_mm", 150.0), ("deep_mm", 40.0)]);
    let (_, plane) = &planes(&torus)[0];
    proof::near(
        length(&contour(&torus, plane).unwrap()) / (TAU * 40.0),
        1.0,
        1e-6,
    );
}

/// Length of a mesh's section near the plane's point, from a mesh of the solid's part around it.
fn on_mesh(solid: &Solid, plane: &Plane, cell_mm: f64) -> f64 {
    let curve = contour(solid, plane).unwrap();
    let (mut low, mut high) = (curve[0].coords, curve[0].coords);
    for p in &curve {
        (low, high) = (low.inf(&p.coords), high.sup(&p.coords));
    }
    let margin = Vector3::from_element(4.0 * cell_mm);
    let mesh = surface(
        solid,
        (low - margin).into(),
        (high + margin).into(),
        cell_mm,
    );
    let (at, normal) = (Point3::from(plane.point_mm), Vector3::from(plane.normal));
    let reach = curve.iter().map(|p| (p - at).norm()).fold(0.0, f64::max) + cell_mm;
    let mut total = 0.0;
    for face in 0..mesh.faces.len() {
        let corners = mesh.triangle(face);
        let height = corners.map(|c| normal.dot(&(c - at)));
        let cut = (0..3).filter_map(|i| {
            let j = (i + 1) % 3;
            let crosses = (height[i] < 0.0) != (height[j] < 0.0);
            let t = height[i] / (height[i] - height[j]);
            crosses.then(|| corners[i] + (corners[j] - corners[i]) * t)
        });
        if let [a, b] = cut.collect::<Vec<_>>()[..]
            && (a - at).norm() < reach
        {
            total += (b - a).norm();
        }
    }
    total
}

#[test]
fn girths_by_formula_are_sections_of_the_mesh_to_a_hundredth_of_a_percent() {
    let mut dice = Dice(11);
    {
        let body = solid(
            "body",
            &[
                ("stature_mm", dice.within(1500.0, 1950.0)),
                ("stout", dice.within(0.9, 1.2)),
                ("furrow_mm", dice.within(0.0, 25.0)),
                ("arms_deg", dice.within(38.0, 60.0)),
            ],
        );
        for (name, plane) in planes(&body) {
            let formula = length(&contour(&body, &plane).unwrap());
            let share = on_mesh(&body, &plane, 1.5) / formula;
            assert!((share - 1.0).abs() < 1e-4, "{name}: {share}");
        }
    }
}

#[test]
fn a_tape_bridges_the_furrow() {
    let girth = |furrow: f64| {
        let body = solid("body", &[("furrow_mm", furrow)]);
        let (_, plane) = planes(&body).swap_remove(0);
        let curve = contour(&body, &plane).unwrap();
        (length(&curve), length(&taut(&curve, &plane)))
    };
    let ((smooth, smooth_tape), (deep, deep_tape)) = (girth(0.0), girth(20.0));
    proof::near(smooth, smooth_tape, 1e-6 * smooth);
    assert!(
        deep > smooth + 2.0 && deep > deep_tape + 3.0,
        "{deep} against {smooth}"
    );
    assert!(deep_tape < smooth_tape && deep_tape > 0.98 * smooth_tape);
}

#[test]
fn a_body_tells_all_its_girths_and_both_sides_are_alike() {
    let input = FormulaInput {
        solid: Arc::new(solid("body", &[])),
        landmarks: None,
        cameras: None,
        truth: None,
    };
    let girths = FormulaGirths::run(&(), input, &Ctx::alone()).unwrap();
    assert!(girths.missing.is_empty());
    for (left, right) in [("AC_L", "AC_R"), ("TC_L", "TC_R"), ("CFC_L", "CFC_R")] {
        let get = |name| girths.get(name).unwrap().contour_mm;
        proof::near(get(left), get(right), 1e-6);
    }
    // A grown person's, more or less.
    for (name, low, high) in [
        ("WC", 650.0, 900.0),
        ("HC", 850.0, 1050.0),
        ("NC", 300.0, 400.0),
    ] {
        let got = girths.get(name).unwrap().tape_mm;
        assert!((low..high).contains(&got), "{name} {got}");
    }
}
