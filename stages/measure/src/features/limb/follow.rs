//! The centre line of a limb: from bands of equal way from its tip, then from sections square to it.

use crate::features::limb::cuts::Cuts;
use crate::features::limb::graph::Graph;
use crate::geometry::slices::Ring;
use nalgebra::{Point3, Vector3};
use shape::Plane;
use std::f64::consts::PI;

/// A section square to a limb's line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Way along the line from the tip. \[mm\]
    pub s: f64,
    /// Its middle. \[mm\]
    pub centre: Point3<f64>,
    /// The line's direction there, unit, toward the trunk.
    pub along: Vector3<f64>,
    /// Length of a tape around it. \[mm\]
    pub tape: f64,
    /// How round it is: its area against a circle's of the same tape.
    pub round: f64,
}

/// Step along a limb's line, as a share of stature (structural: samples).
const STEP_SHARE: f64 = 0.005;
/// What a limb may reach about its line, as a share of stature: a thigh's radius is 0.083 at most (ANSUR II).
const WITHIN_SHARE: f64 = 0.13;
/// How far a ring's middle may be from where it is looked for, as a share of stature. By hand: looked at thirteen
/// bodies, at half and double of it: tapes move by at most 0.03 and 0 %.
const OFF_SHARE: f64 = 0.03;
/// Steps over which the line's direction is taken, to either side (structural: samples).
const REACH: usize = 5;
/// Straight on from where a limb's land ends, a ring's middle moves aside by at most this share of a step. By hand:
/// looked at three scans, at 0.7 and 1.4 of it: no tape changes.
const ASIDE_STEPS: f64 = 0.5;
/// There a ring grows by at most this factor. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by at
/// most 0.49 and 0 %, intervals change by at most 5 and 0 %.
const WIDER_FACTOR: f64 = 1.25;
/// A ring that is so many times as long as the one [`REACH`] steps before holds more than the limb. By hand: looked at
/// three scans, at 0.7 and 1.4 of it: tapes move by at most 11 and 0 %, intervals change by at most 346 and 0 %, 6 and
/// 0 of 66 girths are refused.
const JUMP_FACTOR: f64 = 1.4;

/// The middles of bands of equal way from the tip, from there on to where the limb's skin meets that
/// of the trunk, at a way: up to there each band is one ring around the limb. \[mm\]
pub(crate) fn bands(graph: &Graph, way: &[f64], fold: f64, step: f64) -> Vec<Point3<f64>> {
    let count = (fold / step).floor().max(0.0) as usize;
    let mut sums: Vec<(Vector3<f64>, f64)> = vec![(Vector3::zeros(), 0.0); count];
    for a in (0..way.len()).filter(|a| way[*a] < fold) {
        for b in graph.links(a as u32).iter().map(|b| *b as usize) {
            if way[b] <= way[a] {
                continue;
            }
            // The levels that this link crosses upward.
            let first = (way[a] / step).floor() as usize + 1;
            let last = ((way[b] / step).floor() as usize).min(count.saturating_sub(1));
            for k in first..=last {
                let t = (k as f64 * step - way[a]) / (way[b] - way[a]);
                let p = graph.at[a].coords.lerp(&graph.at[b].coords, t);
                sums[k] = (sums[k].0 + p, sums[k].1 + 1.0);
            }
        }
    }
    let middles = sums.iter().filter(|s| s.1 >= 3.0);
    middles.map(|(p, n)| Point3::from(p / *n)).collect()
}

/// Points of a line at even steps along it, after a moving mean over some to either side. \[mm\]
fn even(line: &[Point3<f64>], wide: usize, step: f64) -> Vec<Point3<f64>> {
    let n = line.len();
    let mean = |i: usize| {
        // The same to either side, so that ends stay where they are.
        let w = wide.min(i).min(n - 1 - i);
        let near = &line[i - w..=i + w];
        near.iter().map(|p| p.coords).sum::<Vector3<f64>>() / near.len() as f64
    };
    let smooth: Vec<Vector3<f64>> = (0..n).map(mean).collect();
    let (mut out, mut left) = (Vec::new(), 0.0);
    for pair in smooth.windows(2) {
        let long = (pair[1] - pair[0]).norm();
        while left < long {
            out.push(Point3::from(pair[0].lerp(&pair[1], left / long)));
            left += step;
        }
        left -= long;
    }
    out
}

/// The line's direction at a point of it.
fn direction(line: &[Point3<f64>], i: usize) -> Option<Vector3<f64>> {
    let (a, b) = (i.saturating_sub(REACH), (i + REACH).min(line.len() - 1));
    (line[b] - line[a]).try_normalize(1e-6)
}

/// The ring square to a direction at a point.
fn across(cuts: &Cuts<'_>, at: Point3<f64>, along: Vector3<f64>, stature: f64) -> Option<Ring> {
    let plane = Plane {
        point_mm: at.into(),
        normal: along.into(),
    };
    cuts.ring(&plane, WITHIN_SHARE * stature, OFF_SHARE * stature)
}

pub(crate) fn roundness(ring: &Ring) -> f64 {
    4.0 * PI * ring.area / (ring.tape * ring.tape).max(1e-9)
}

/// The sections along a limb, from its tip to where another part of the body joins it.
pub(crate) fn followed(cuts: &Cuts<'_>, bands: &[Point3<f64>], stature: f64) -> Vec<Knot> {
    let step = STEP_SHARE * stature;
    if bands.len() < 4 * REACH {
        return Vec::new();
    }
    let mut line = even(bands, REACH, step);
    let mut knots = Vec::new();
    for _ in 0..2 {
        let found: Vec<Option<Ring>> = (0..line.len())
            .map(|i| across(cuts, line[i], direction(&line, i)?, stature))
            .collect();
        knots = joined(&line, &found);
        let more = onward(cuts, &knots, stature);
        knots.extend(more);
        let centres: Vec<Point3<f64>> = knots.iter().map(|k: &Knot| k.centre).collect();
        if centres.len() < 4 * REACH {
            return Vec::new();
        }
        line = even(&centres, REACH / 2, step);
    }
    let mut s = 0.0;
    for i in 0..knots.len() {
        if i > 0 {
            s += (knots[i].centre - knots[i - 1].centre).norm();
        }
        knots[i].s = s;
    }
    knots
}

/// Rings as knots; those that jump hold more than the limb, and are none. Hands and heels jump as they like, so the first third is not
/// looked at.
fn joined(line: &[Point3<f64>], found: &[Option<Ring>]) -> Vec<Knot> {
    let mut knots: Vec<Knot> = Vec::new();
    for (i, ring) in found.iter().enumerate() {
        let (Some(ring), Some(along)) = (ring, direction(line, i)) else {
            continue;
        };
        if i <= found.len() / 3 || !jumps(&knots, ring.tape) {
            knots.push(knot(ring, along));
        }
    }
    knots
}

fn knot(ring: &Ring, along: Vector3<f64>) -> Knot {
    Knot {
        s: 0.0,
        centre: ring.centre,
        along,
        tape: ring.tape,
        round: roundness(ring),
    }
}

fn jumps(knots: &[Knot], tape: f64) -> bool {
    let before = knots.len().checked_sub(REACH).map(|i| knots[i].tape);
    before.is_some_and(|t| tape > JUMP_FACTOR * t)
}

/// Knots straight on from the last, as long as the rings are the limb's alone.
fn onward(cuts: &Cuts<'_>, knots: &[Knot], stature: f64) -> Vec<Knot> {
    let step = STEP_SHARE * stature;
    let count = knots.len();
    if count < 3 * REACH {
        return Vec::new();
    }
    let (from, last) = (knots[count - 2 * REACH].centre, knots[count - 1].centre);
    let Some(along) = (last - from).try_normalize(1e-6) else {
        return Vec::new();
    };
    let mut all = knots.to_vec();
    while all.len() < count + 60 {
        let at = all[all.len() - 1].centre + along * step;
        let Some(ring) = across(cuts, at, along, stature) else {
            break;
        };
        let aside = (ring.centre - at).norm();
        if jumps(&all, ring.tape)
            || aside > ASIDE_STEPS * step
            || ring.tape > WIDER_FACTOR * knots[count - 1].tape
        {
            break;
        }
        all.push(knot(&ring, along));
    }
    all.split_off(count)
}

/// A direction away from the trunk across a limb, unit: outward for what hangs, upward for what is
/// raised.
pub(crate) fn away(along: Vector3<f64>, left: Vector3<f64>, side: f64) -> Option<Vector3<f64>> {
    let out = left * side + Vector3::z();
    (out - along * along.dot(&out)).try_normalize(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trunk_beside_the_line_is_no_section_of_the_limb() {
        // A limb of 300 mm around, then rings of both limbs, then the trunk's.
        let line: Vec<Point3<f64>> = (0..60)
            .map(|i| Point3::new(0.0, 0.0, 9.0 * f64::from(i)))
            .collect();
        let ring = |tape: f64, x: f64, z: f64| Ring {
            curve: Vec::new(),
            area: tape * tape / (4.0 * PI),
            tape,
            centre: Point3::new(x, 0.0, z),
        };
        let found: Vec<Option<Ring>> = line
            .iter()
            .enumerate()
            .map(|(i, p)| match i {
                ..50 => Some(ring(300.0, 0.0, p.z)),
                50..59 => Some(ring(900.0, 85.0, p.z)),
                _ => Some(ring(500.0, 85.0, p.z)),
            })
            .collect();
        assert_eq!(joined(&line, &found).len(), 50);
    }
}
