//! Joints of a body that turns, seen with noise, and with its back taken for its front on some photos.

use super::*;
use crate::azimuth::{Faces, azimuths, wrapped};
use std::f64::consts::TAU;

/// The photos whose left is taken for their right.
const SWAPPED: [usize; 3] = [0, 1, 12];

/// Joints of a body 0.65 of the camera's distance tall, at a turn that is uneven, with sights that are off by some.
fn turned(photos: usize, ways: impl Fn(f64) -> f64) -> (Sights, Vec<f64>) {
    let places: [(usize, [f64; 3]); 15] = [
        (0, [0.0, -0.04, 0.18]),
        (7, [0.03, 0.0, 0.18]),
        (8, [-0.03, 0.0, 0.18]),
        (11, [0.068, 0.01, 0.1]),
        (12, [-0.068, 0.01, 0.1]),
        (13, [0.1, 0.01, 0.0]),
        (14, [-0.1, 0.01, 0.0]),
        (23, [0.036, 0.0, -0.09]),
        (24, [-0.036, 0.0, -0.09]),
        (25, [0.04, 0.0, -0.24]),
        (26, [-0.04, 0.0, -0.24]),
        (29, [0.04, 0.02, -0.42]),
        (30, [-0.04, 0.02, -0.42]),
        (31, [0.045, -0.05, -0.42]),
        (32, [-0.045, -0.05, -0.42]),
    ];
    let mut sights: Sights = vec![vec![None; photos]; Found::JOINTS.len()];
    let mut truth = Vec::new();
    for i in 0..photos {
        let step = Step {
            azimuth: ways(i as f64 / photos as f64),
            off: [0.01 * libm::sin(2.0 * i as f64), 0.0],
            ..Step::default()
        };
        truth.push(step.azimuth);
        for (j, at) in places {
            let there = step.to_fixed(&Vector3::from(at));
            let noise = |k: f64| 0.002 * libm::sin(k * (i * 33 + j) as f64);
            let sight = seen(0.08, &there).unwrap().0;
            sights[j][i] = Some(sight + Vector2::new(noise(12.9), noise(78.2)));
        }
        // Backs and fronts that the network took for each other.
        if SWAPPED.contains(&i) {
            swap(&mut sights, i);
        }
    }
    (sights, truth)
}

#[test]
fn joints_alone_tell_the_azimuth_to_a_degree_or_two_whichever_way_it_goes() {
    for ways in [
        |t: f64| TAU * t + 0.2 * libm::sin(9.0 * t),
        |t: f64| 1.0 - TAU * t,
        |t: f64| 2.0 * TAU * t,
    ] {
        let (mut sights, truth) = turned(24, ways);
        let first = azimuths(&sights, 24, 0.65);
        let swapped: Vec<usize> = (0..24).filter(|i| first[*i].swapped).collect();
        assert_eq!(swapped, SWAPPED);
        swapped.into_iter().for_each(|i| swap(&mut sights, i));
        let step = |a: &Faces| Step {
            azimuth: a.azimuth,
            ..Step::default()
        };
        let steps = first.iter().map(step).collect();
        let motion = Motion { pitch: 0.0, steps };
        let found = Articulated::placed(&sights, motion).settled(&sights);
        let all = found.motion.steps.iter().zip(&truth);
        let off: Vec<f64> = all.map(|(s, t)| wrapped(s.azimuth - t)).collect();
        let mean = off.iter().sum::<f64>() / 24.0;
        let worst = off.iter().map(|o| (o - mean).abs()).fold(0.0, f64::max);
        assert!(worst.to_degrees() < 2.5, "{}", worst.to_degrees());
        assert!((found.motion.pitch - 0.08).abs() < 0.03);
    }
}
