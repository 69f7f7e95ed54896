//! Laws of the surface, whatever the field; known solids; equal bytes with any number of threads.

use hull::{BRICK, Bricks, Lattice, SIDE, evaluate, largest, surface};
use nalgebra::Point3;
use proof::Dice;
use std::convert::Infallible;

/// A lattice of one brick filled with a function of the corner's place, empty at the border.
fn brick(mut value: impl FnMut(usize, usize, usize) -> f32) -> (Lattice, Bricks) {
    let lattice = Lattice {
        origin: Point3::origin(),
        cell_mm: 1.0,
        bricks: [1, 1, 1],
    };
    let mut values = Vec::new();
    for i in 0..SIDE * SIDE * SIDE {
        let (x, y, z) = (i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE);
        let border = [x, y, z].iter().any(|c| *c == 0 || *c == BRICK);
        values.push(if border { -1.0 } else { value(x, y, z) });
    }
    (lattice, vec![Some(values)])
}

#[test]
fn any_field_gives_a_closed_oriented_manifold() {
    for seed in 0..40 {
        let mut dice = Dice(seed);
        let whole = seed % 2 == 0;
        let (lattice, bricks) = brick(|_, _, _| {
            let v = dice.within(-1.0, 1.0) as f32;
            if whole { v.signum() } else { v }
        });
        let mesh = surface(&lattice, &bricks);
        assert!(mesh.faces.len() > 1000);
        assert_eq!(mesh.validate_closed(), Ok(()), "seed {seed}");
        assert!(mesh.volume() > 0.0);
    }
}

#[test]
fn each_of_the_256_cells_alone_is_closed() {
    for solid in 1..256usize {
        let (lattice, bricks) = brick(|x, y, z| {
            let inside = (4..6).contains(&x) && (4..6).contains(&y) && (4..6).contains(&z);
            let corner = (x & 1) | (y & 1) << 1 | (z & 1) << 2;
            if inside && solid >> corner & 1 == 1 {
                1.0
            } else {
                -1.0
            }
        });
        assert_eq!(
            surface(&lattice, &bricks).validate_closed(),
            Ok(()),
            "case {solid}"
        );
    }
}

fn ball(radius: f64, cell: f64) -> (shape::Mesh, usize) {
    let value = |x: &Point3<f64>| (radius - x.coords.norm()) as f32;
    let corner = Point3::new(radius, radius, radius);
    let lattice = Lattice::over(-corner, corner, cell);
    let bricks = evaluate(&lattice, &value, &|| Ok::<_, Infallible>(())).unwrap();
    let looked = bricks.iter().flatten().count();
    (surface(&lattice, &bricks), looked)
}

#[test]
fn a_ball_has_its_volume_and_faces_outward() {
    let (mesh, _) = ball(100.0, 2.0);
    assert_eq!(mesh.validate_closed(), Ok(()));
    let want = 4.0 / 3.0 * std::f64::consts::PI * 1e6;
    proof::near(mesh.volume() / want, 1.0, 1e-3);
}

#[test]
fn cost_follows_the_surface() {
    let (coarse, fine) = (ball(200.0, 2.0).1 as f64, ball(200.0, 1.0).1 as f64);
    assert!(
        fine / coarse < 5.0,
        "{coarse} bricks, then {fine}: area grows fourfold, volume eightfold"
    );
}

#[test]
fn what_is_passed_over_changes_nothing() {
    // A ball with a dent, and another that touches it: distances to them, as far as a bound goes.
    let value = |x: &Point3<f64>| {
        let ball = |c: [f64; 3], r: f64| r - (x - Point3::from(c)).norm();
        let solid = ball([0.0; 3], 60.0).min(-ball([50.0, 0.0, 30.0], 25.0));
        solid.max(ball([-70.0, 10.0, 0.0], 22.0)) as f32
    };
    let (lo, hi) = (
        Point3::new(-95.0, -62.0, -62.0),
        Point3::new(62.0, 62.0, 62.0),
    );
    let lattice = Lattice::over(lo, hi, 1.5);
    let some = evaluate(&lattice, &value, &|| Ok::<_, Infallible>(())).unwrap();
    let whole = |brick: usize| {
        let base = lattice.place(brick).map(|b| b * BRICK);
        let corner = |i: usize| [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE];
        let at = |i: usize| [0, 1, 2].map(|a| base[a] + corner(i)[a]);
        let one = |i: usize| value(&lattice.corner(at(i)[0], at(i)[1], at(i)[2]));
        Some((0..SIDE * SIDE * SIDE).map(one).collect())
    };
    let all: Bricks = (0..lattice.count()).map(whole).collect();
    let (got, want) = (surface(&lattice, &some), surface(&lattice, &all));
    assert!(got.faces.len() > 5000);
    assert!(stage::to_bytes(&got) == stage::to_bytes(&want));
}

#[test]
fn any_number_of_threads_gives_equal_bytes() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| stage::to_bytes(&ball(60.0, 1.5).0))
    };
    assert!(with(1) == with(2) && with(2) == with(3));
}

#[test]
fn the_largest_part_stays_and_the_other_parts_are_reported() {
    let value = |x: &Point3<f64>| {
        let small = Point3::new(120.0, 0.0, 0.0);
        (50.0 - x.coords.norm()).max(20.0 - (x - small).norm()) as f32
    };
    let lattice = Lattice::over(
        Point3::new(-60.0, -60.0, -60.0),
        Point3::new(150.0, 60.0, 60.0),
        2.0,
    );
    let bricks = evaluate(&lattice, &value, &|| Ok::<_, Infallible>(())).unwrap();
    let (mesh, rest) = largest(&surface(&lattice, &bricks));
    assert_eq!(rest.len(), 1);
    assert_eq!(mesh.validate_closed(), Ok(()));
    proof::near(
        rest[0] / (4.0 / 3.0 * std::f64::consts::PI * 8000.0),
        1.0,
        0.02,
    );
}
