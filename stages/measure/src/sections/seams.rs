//! Where in a section an arm begins that is one with the trunk: where the trunk's outline stops turning round toward its side, or
//! turns back beyond the arm, or opposite of where it does so.

use super::fold::{STRAIGHT_RAD, TURNED_RAD, fold};
use crate::geometry::section::length;
use std::f64::consts::TAU;

/// Samples to either side of one that tell the way of the outline there (structural: samples).
const REACH: usize = 5;

/// Where on an outline an arm begins: an index, the place, the outline's way there, and how long and by how much what begins there does
/// not turn round as a trunk does. \[mm\]
#[derive(Clone, Copy)]
pub(super) struct Seam {
    pub(super) at: usize,
    pub(super) place: [f64; 2],
    pub(super) way: [f64; 2],
    score: f64,
}

/// The way from a point to another, unit.
fn toward(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypot(x, y).max(1e-9);
    [x / length, y / length]
}

/// Follows the outline about a trunk's middle from the front (`fore` 1) or the back (-1) to the outermost of a side, and finds where it
/// stops turning for long, or turns back.
pub(super) fn seams(points: &[[f64; 2]], side: f64, fore: f64) -> Vec<Seam> {
    let (n, around) = (points.len(), length(points));
    // Seen so that the path runs from the top to the right.
    let seen = |i: usize| {
        let p = points[i % n];
        [side * p[0], fore * p[1]]
    };
    let start = (0..n)
        .filter(|i| seen(*i)[0].abs() < 0.03 * around && seen(*i)[1] > 0.0)
        .min_by(|a, b| seen(*a)[0].abs().total_cmp(&seen(*b)[0].abs()));
    let end = (0..n).max_by(|a, b| seen(*a)[0].total_cmp(&seen(*b)[0]));
    let Some((start, end)) = start.zip(end) else {
        return vec![];
    };
    // A counter-clockwise outline runs to the left at the front.
    let forward = side * fore > 0.0;
    let along = |k: usize| match forward {
        false => (start + k) % n,
        true => (start + n - k % n) % n,
    };
    let long = match forward {
        false => (end + n - start) % n,
        true => (start + n - end) % n,
    };
    if long < 4 * REACH || long > n / 2 {
        return vec![];
    }
    let way = |k: usize| {
        let (a, b) = (seen(along(k + n - REACH)), seen(along(k + REACH)));
        toward(a, b)
    };
    let mut turned: Vec<f64> = Vec::with_capacity(long);
    for k in 0..long {
        let [x, y] = way(k);
        let raw = libm::atan2(-y, x);
        let last = turned.last().copied().unwrap_or(raw);
        turned.push(raw + ((last - raw) / TAU).round() * TAU);
    }
    let step = around / n as f64;
    let deep = (0..n).map(|i| seen(i)[1]).fold(0.0, f64::max);
    let score = |a: usize| {
        let stops = (a + 1..long).take_while(|b| turned[*b] <= turned[a] + STRAIGHT_RAD);
        let scores = stops.map(|b| (b - a) as f64 * step + deep * (turned[a] - turned[b]));
        scores.fold(0.0, f64::max)
    };
    let scores: Vec<f64> = (0..long)
        .map(|a| {
            if turned[a] < TURNED_RAD {
                0.0
            } else {
                score(a)
            }
        })
        .collect();
    let peak = |k: &usize| {
        let near = &scores[k.saturating_sub(REACH)..(k + REACH + 1).min(long)];
        let most = near.iter().copied().fold(0.0, f64::max);
        scores[*k] > 0.25 * deep && scores[*k] >= most
    };
    let one = |k: usize| {
        let [x, y] = way(k);
        Seam {
            at: along(k),
            place: points[along(k)],
            way: [side * x, fore * y],
            score: scores[k],
        }
    };
    (0..long).filter(peak).map(one).collect()
}

/// Of the places in one section at which an arm may begin, the one that those of the sections below and above it, the nearest first,
/// vouch for: the seam goes on along the trunk, and where it jumps from section to section, so much of an outline is arm in one and trunk in
/// the next.
pub(super) fn vouched(own: &[Seam], beside: [&[Vec<Seam>]; 2]) -> Option<Seam> {
    let reached = |sections: &[Vec<Seam>]| {
        let mut best: Vec<Seam> = vec![];
        for section in sections.iter().rev().filter(|s| !s.is_empty()) {
            best = (section.iter())
                .map(|seam| Seam {
                    score: seam.score + from(&best, seam),
                    ..*seam
                })
                .collect();
        }
        best
    };
    let [below, above] = beside.map(reached);
    let all = |seam: &Seam| seam.score + from(&below, seam) + from(&above, seam);
    own.iter().copied().max_by(|a, b| all(a).total_cmp(&all(b)))
}

/// The most that seams of the section beside one have, less the way from them to it.
fn from(beside: &[Seam], seam: &Seam) -> f64 {
    let apart = |other: &Seam| {
        libm::hypot(
            other.place[0] - seam.place[0],
            other.place[1] - seam.place[1],
        )
    };
    let most = beside.iter().map(|other| other.score - apart(other));
    most.reduce(f64::max).unwrap_or(0.0)
}

/// The same of a flat chest or back, which turns too little before the arm: where the outline turns back beyond the arm.
pub(super) fn beyond_fold(points: &[[f64; 2]], side: f64, fore: f64) -> Option<Seam> {
    let n = points.len();
    let out = |i: &usize| side * points[*i][0];
    let from = (0..n).max_by(|a, b| out(a).total_cmp(&out(b)))?;
    // A counter-clockwise outline runs forward on the left.
    let forward = side * fore > 0.0;
    let along = |k: usize| match forward {
        true => (from + k) % n,
        false => (from + n - k % n) % n,
    };
    let turn = if forward { 1.0 } else { -1.0 };
    let start = fold(&|k| points[along(k)], n, turn)?.beyond;
    let (a, b) = (points[along(start + 2 * REACH)], points[along(start)]);
    let own = Seam {
        at: along(start),
        place: b,
        way: toward(a, b),
        score: 0.0,
    };
    // Beyond the middle it is the other arm's.
    (side * b[0] > 0.0).then_some(own)
}

/// The same of a fold that is filled up to the arm: as far aside as the other seam of that arm.
pub(super) fn opposite(
    points: &[[f64; 2]],
    (side, fore): (f64, f64),
    other: &Seam,
) -> Option<Seam> {
    let n = points.len();
    let off = |i: &usize| (points[*i][0] - points[other.at][0]).abs();
    let at = (0..n)
        .filter(|i| fore * points[*i][1] > 0.0)
        .min_by(|a, b| off(a).total_cmp(&off(b)))?;
    // A counter-clockwise outline runs to the left at the front.
    let (a, b) = match side * fore > 0.0 {
        true => (at + REACH, at + n - REACH),
        false => (at + n - REACH, at + REACH),
    };
    Some(Seam {
        at,
        place: points[at],
        way: toward(points[a % n], points[b % n]),
        score: 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_that_no_section_beside_has_is_none_however_long_it_is() {
        let seam = |x: f64, score: f64| Seam {
            at: 0,
            place: [x, 90.0],
            way: [1.0, 0.0],
            score,
        };
        let own = [seam(112.0, 330.0), seam(20.0, 390.0)];
        let alone = vouched(&own, [&[], &[]]).unwrap();
        assert_eq!(alone.place[0], 20.0);
        let beside = [vec![], vec![seam(113.0, 340.0)], vec![seam(115.0, 350.0)]];
        for both in [[&beside[..], &[]], [&[], &beside[..]]] {
            assert_eq!(vouched(&own, both).unwrap().place[0], 112.0);
        }
        assert!(vouched(&[], [&beside, &beside]).is_none());
    }
}
