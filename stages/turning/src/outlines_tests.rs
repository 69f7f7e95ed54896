//! Posts for head, trunk, arms and legs, turned before a camera that sees where each begins and ends.

use super::*;
use crate::joints::Equations;
use crate::outline::border;
use crate::scene::{PER_STEP, Step};
use nalgebra::{Point2, Vector2, Vector3};
use shape::{Intrinsics, Mask};
use std::f64::consts::TAU;

const LENS: (u32, u32, f64) = (240, 160, 260.0);
/// Posts: where they are, half their breadth and depth, from which height to which. [distance to the axis]
type Post = ([f64; 2], [f64; 2], [f64; 2]);
const POSTS: [Post; 6] = [
    ([0.0, -0.02], [0.035, 0.045], [0.13, 0.25]),
    ([0.0, 0.0], [0.07, 0.042], [-0.08, 0.12]),
    ([0.13, 0.01], [0.016, 0.02], [-0.08, 0.12]),
    ([-0.125, -0.02], [0.017, 0.018], [-0.08, 0.12]),
    ([0.05, 0.01], [0.028, 0.036], [-0.27, -0.09]),
    ([-0.055, -0.02], [0.028, 0.036], [-0.27, -0.09]),
];

/// Even steps, but for what is wrong with each.
fn motion(photos: usize, wrong: impl Fn(usize) -> [f64; 3]) -> Motion {
    let step = |i: usize| {
        let [turn, right, back] = wrong(i);
        Step {
            azimuth: i as f64 / photos as f64 * TAU + 0.05 * libm::sin(7.0 * i as f64) + turn,
            off: [
                0.008 * libm::sin(3.0 * i as f64) + right,
                0.008 * libm::sin(5.0 * i as f64) + back,
            ],
            ..Step::default()
        }
    };
    Motion {
        pitch: 0.0,
        steps: (0..photos).map(step).collect(),
    }
}

/// How much of each pixel is before a post.
fn mask(step: &Step) -> Mask {
    let lens = Intrinsics::simple(LENS.0, LENS.1, LENS.2);
    let mut mask = Mask::filled(LENS.0 as usize, LENS.1 as usize, 0);
    for ([x, y], [a, b], [low, high]) in POSTS {
        let around = (0..720).map(|k| {
            let (s, c) = libm::sincos(f64::from(k) / 720.0 * TAU);
            let there = step.to_fixed(&Vector3::new(x + a * c, y + b * s, 0.0));
            lens.distort(Vector2::new(there.x / there.y, 0.0)).x
        });
        let sides = around.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        let away = step.to_fixed(&Vector3::new(x, y, 0.0)).y;
        let row = |z: f64| lens.distort(Vector2::new(0.0, -z / away)).y;
        let ends = (row(high), row(low));
        let covered = |i: usize, (lo, hi): (f64, f64)| {
            (hi.min(i as f64 + 0.5) - lo.max(i as f64 - 0.5)).clamp(0.0, 1.0)
        };
        for u in 0..LENS.0 as usize {
            for v in 0..LENS.1 as usize {
                let cover = mask.at_mut(u, v);
                let share = covered(u, sides) * covered(v, ends);
                *cover = (*cover).max((255.0 * share).round() as u8);
            }
        }
    }
    mask
}

#[test]
fn outlines_bring_a_motion_that_joints_tell_roughly_under_one_degree() {
    let truth = motion(24, |_| [0.0; 3]);
    let lens = Intrinsics::simple(LENS.0, LENS.1, LENS.2);
    let outlines: Vec<Outline> = truth
        .steps
        .iter()
        .map(|s| Outline::of(&mask(s), &lens, |_| 1.0))
        .collect();
    let wrong = |i: usize| {
        let by = |k: f64| libm::sin(k * (i as f64 + 1.0));
        [0.1 * by(11.0), 0.01 * by(13.0), 0.01 * by(17.0)]
    };
    let mut found = motion(24, wrong);
    let rough: Vec<f64> = found.steps.iter().map(|s| s.azimuth).collect();
    let off = |found: &Motion| {
        let all = found.steps.iter().zip(&truth.steps);
        let all: Vec<f64> = all.map(|(f, t)| f.azimuth - t.azimuth).collect();
        let mean = all.iter().sum::<f64>() / 24.0;
        (all.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / 24.0)
            .sqrt()
            .to_degrees()
    };
    let before = off(&found);
    for round in 0..20 {
        let mut all = Equations::none(PER_STEP * 24 + 1);
        equations(
            &outlines,
            &found,
            (20.0, crate::together::lax(round)),
            &mut all,
        )
        .unwrap();
        // A level camera, a body that is expected where it is, and azimuths as joints tell them.
        all.add(&[(PER_STEP * 24, 1.0)], found.pitch, 1e6);
        for (i, step) in found.steps.iter().enumerate() {
            let at = PER_STEP * i;
            all.add(&[(at, 1.0)], step.azimuth - rough[i], 400.0);
            (0..2).for_each(|k| all.add(&[(at + 1 + k, 1.0)], step.off[k], 1e3));
            (0..2).for_each(|k| all.add(&[(at + 3 + k, 1.0)], step.lean[k], 1e6));
        }
        let by = all.solved(1e-3).unwrap();
        for (i, step) in found.steps.iter_mut().enumerate() {
            step.stepped(&by.as_slice()[PER_STEP * i..]);
        }
        found.pitch += by[PER_STEP * 24];
    }
    let after = off(&found);
    assert!(
        before > 3.0 && after < 1.0,
        "{before}° before, {after}° after"
    );
}

#[test]
fn the_border_of_a_photo_is_no_outline() {
    let mut mask = Mask::filled(40, 30, 0);
    for y in 10..30 {
        (15..25).for_each(|x| *mask.at_mut(x, y) = 255);
    }
    let all: Vec<Point2<f64>> = border(&mask);
    assert!(!all.is_empty() && all.iter().all(|p| p.y < 29.0));
    let along_the_edge = all
        .iter()
        .filter(|p| p.y > 28.0 && p.x > 15.5 && p.x < 23.5);
    assert_eq!(along_the_edge.count(), 0);
}
