//! Which way somebody faces on each photo, by joints alone: the likeliest way round, though the network takes a back for a
//! front on some photos.

use crate::joints::Sights;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Steps around in which azimuths are looked for (structural: 3°, refined afterwards).
const AROUND: usize = 120;

/// Pairs of joints by their places in [`shape::Found::JOINTS`], and how the second is from the first in a body that
/// faces −y, as a share of the body's height: to its left, and backward. Breadths of adults: biacromial 0.23, ears 0.09,
/// hips of the network 0.11 of stature, the nose 0.06 before the ears (ANSUR II: 0.226, 0.088; the network's hips and
/// nose as seen on made bodies).
const PAIRS: [([usize; 2], [f64; 2]); 4] = [
    ([12, 11], [0.21, 0.0]),
    ([24, 23], [0.11, 0.0]),
    ([8, 7], [0.088, 0.0]),
    ([8, 0], [0.044, -0.06]),
];
/// How far a joint is from there, one standard deviation as a share of the height. By hand: looked at three made
/// bodies.
const OFF_SIGMA: f64 = 0.03;
/// How far a body turns from photo to photo, one standard deviation: 20°. By hand: looked at photos at 10° to 45°.
/// \[rad\]
const STEP_SIGMA: f64 = TAU / 18.0;

/// One photo's azimuth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Faces {
    /// As the body turned from photo to photo, not as an angle repeats. \[rad\]
    pub azimuth: f64,
    /// Whether the network took the body's left for its right.
    pub swapped: bool,
}

/// What it costs that the network took a photo's left for its right, fitted to six made captures of scans, all looked at:
/// 5 of 311 photos (ln 311 / 5, ± 0.5 by the count alone). None was left out to test it on.
const SWAPPED: f64 = 4.1;

/// The azimuth of each photo: the path around of least cost, by joints of each photo and steps from one to the next
/// (Viterbi 1967), and from the last to the first as far as the turn closes. `height` is the body's apparent height on the
/// plane z = 1.
pub fn azimuths(sights: &Sights, photos: usize, height: f64) -> Vec<Faces> {
    let costs = |side: f64| -> Vec<Vec<f64>> {
        let of = |i| costs(sights, i, height, side);
        (0..photos).map(of).collect()
    };
    let (right, swapped) = (costs(1.0), costs(-1.0));
    let either = |(a, b): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        let both = a.iter().zip(b);
        both.map(|(a, b)| a.min(b + SWAPPED)).collect()
    };
    let all: Vec<Vec<f64>> = right.iter().zip(&swapped).map(either).collect();
    let paths = (0..AROUND).into_par_iter().map(|first| path(&all, first));
    let paths: Vec<(f64, Vec<usize>)> = paths.collect();
    let best = paths.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let path = best.unwrap_or_default().1;
    let mut azimuth = 0.0;
    (0..photos)
        .map(|i| {
            let before = if i == 0 { 0 } else { path[i - 1] };
            azimuth += way(before, path[i]);
            Faces {
                azimuth,
                swapped: swapped[i][path[i]] + SWAPPED < right[i][path[i]],
            }
        })
        .collect()
}

/// The path of least cost from one place around on, and what it costs. That the last photo is a step before the first costs
/// little more where it is not (Cauchy): of more or less than a turn.
fn path(costs: &[Vec<f64>], first: usize) -> (f64, Vec<usize>) {
    let squares = |k: usize| (way(0, k) / STEP_SIGMA).powi(2) / 2.0;
    let steps: Vec<f64> = (0..AROUND).map(squares).collect();
    let step = |a: usize, b: usize| steps[(AROUND + b - a) % AROUND];
    let mut best = vec![f64::INFINITY; AROUND];
    best[first] = costs.first().map_or(0.0, |all| all[first]);
    let mut came: Vec<Vec<usize>> = vec![];
    for next in costs.iter().skip(1) {
        let from = |k: usize| {
            let all = (0..AROUND).map(|j| (best[j] + step(j, k), j));
            all.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
        };
        let all: Vec<(f64, usize)> = (0..AROUND).map(from).collect();
        best = all.iter().zip(next).map(|(f, c)| f.0 + c).collect();
        came.push(all.into_iter().map(|f| f.1).collect());
    }
    let ends = (0..AROUND).map(|k| (best[k] + 2.0 * libm::log1p(step(k, first)), k));
    let (cost, last) = ends.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    let mut path = vec![last];
    for from in came.iter().rev() {
        path.push(from[path[path.len() - 1]]);
    }
    path.reverse();
    (cost, path)
}

/// What each azimuth costs by one photo's joints; of a photo whose joints are far off none costs much more (Cauchy).
/// `side` is -1 where left is to be taken for right.
fn costs(sights: &Sights, photo: usize, height: f64, side: f64) -> Vec<f64> {
    let at = |j: usize| sights[j][photo];
    let across = |[a, b]: [usize; 2]| match (side < 0.0, b) {
        (true, 0) => Some((at(0)?.x - at(7)?.x) / height),
        _ => Some(side * (at(b)?.x - at(a)?.x) / height),
    };
    let pairs = PAIRS.iter();
    let seen: Vec<_> = pairs
        .filter_map(|(pair, is)| Some((across(*pair)?, *is)))
        .collect();
    let cost = |k: usize| {
        let (s, c) = libm::sincos(k as f64 / AROUND as f64 * TAU);
        let miss = |(seen, [left, back]): &(f64, [f64; 2])| (seen - c * left + s * back).powi(2);
        let all: f64 = seen.iter().map(miss).sum();
        2.0 * libm::log1p(all / (2.0 * OFF_SIGMA * OFF_SIGMA))
    };
    (0..AROUND).map(cost).collect()
}

/// The shorter way from one place around to another. \[rad\]
fn way(from: usize, to: usize) -> f64 {
    wrapped((to as f64 - from as f64) / AROUND as f64 * TAU)
}

/// An angle between -π and π.
pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
