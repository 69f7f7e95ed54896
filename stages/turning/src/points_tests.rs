//! Points of a trunk that turns and leans, seen with noise, a few of them wrong.

use super::*;
use crate::scene::Step;
use std::f64::consts::TAU;

const PHOTOS: usize = 24;

/// The motion that was, and one that is off by some degrees.
fn motions() -> [Motion; 2] {
    let motion = |wrong: f64| {
        let step = |i: usize| {
            let by = |k: f64| libm::sin(k * (i as f64 + 1.0));
            Step {
                azimuth: i as f64 / PHOTOS as f64 * TAU + wrong * 0.06 * by(11.0),
                off: [0.008 * by(3.0), 0.008 * by(5.0) + wrong * 0.01 * by(13.0)],
                lean: [(1.0 - wrong) * 0.008 * by(7.0), 0.0],
            }
        };
        Motion {
            pitch: 0.0,
            steps: (0..PHOTOS).map(step).collect(),
        }
    };
    [motion(0.0), motion(1.0)]
}

/// Points on a trunk's skin as photos see them that they face; one in ten is another's on its second photo.
fn points(motion: &Motion) -> Vec<Point> {
    let point = |k: usize| {
        let (s, c) = libm::sincos(k as f64 * 2.4);
        let at = Vector3::new(0.07 * c, 0.045 * s, -0.12 + 0.0012 * k as f64);
        let sight = |i: usize| {
            let step = &motion.steps[i];
            let there = step.to_fixed(&at);
            let facing = step.pose().rotation * Vector3::new(c, s, 0.0);
            let noise = |by: f64| 3e-4 * libm::sin(by * (i * 977 + k) as f64);
            let sight = seen(motion.pitch, &there)?.0 + Vector2::new(noise(12.9), noise(78.2));
            (facing.y < -0.5).then_some((i, sight))
        };
        let mut all: Vec<(usize, Vector2<f64>)> = (0..PHOTOS).filter_map(sight).collect();
        if k.is_multiple_of(10) && all.len() > 1 {
            all[1].1.x += 0.01;
        }
        Point {
            seen: all,
            counts: 1.0,
        }
    };
    (0..200).map(point).filter(|p| p.seen.len() > 1).collect()
}

#[test]
fn features_bring_a_motion_that_is_known_roughly_to_a_third_of_a_degree() {
    let [truth, mut found] = motions();
    let points = points(&truth);
    let off = |found: &Motion| {
        let all = found.steps.iter().zip(&truth.steps);
        let all: Vec<f64> = all.map(|(f, t)| f.azimuth - t.azimuth).collect();
        let mean = all.iter().sum::<f64>() / PHOTOS as f64;
        let square: f64 = all.iter().map(|a| (a - mean).powi(2)).sum();
        (square / PHOTOS as f64).sqrt().to_degrees()
    };
    let before = off(&found);
    for round in 0..15 {
        let mut all = Equations::none(PER_STEP * PHOTOS + 1);
        let lax = crate::together::lax(round);
        equations(&points, &found, (100.0, lax), &mut all).unwrap();
        all.add(&[(PER_STEP * PHOTOS, 1.0)], found.pitch, 1e6);
        for (i, step) in found.steps.iter().enumerate() {
            for k in 0..2 {
                all.add(&[(PER_STEP * i + 1 + k, 1.0)], step.off[k], 2500.0);
                all.add(&[(PER_STEP * i + 3 + k, 1.0)], step.lean[k], 1e4);
            }
        }
        let by = all.solved(1e-4).unwrap();
        for (i, step) in found.steps.iter_mut().enumerate() {
            step.stepped(&by.as_slice()[PER_STEP * i..]);
        }
        found.pitch += by[PER_STEP * PHOTOS];
    }
    let after = off(&found);
    assert!(
        before > 2.0 && after < 0.33,
        "{before}° before, {after}° after"
    );
}
