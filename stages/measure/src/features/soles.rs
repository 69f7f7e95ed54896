//! The soles of a body: legs followed down to where their feet end.

use crate::geometry::slices::{Ring, Slice, slices};
use nalgebra::Point3;
use shape::Mesh;
use std::collections::BTreeMap;

/// Where feet end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Soles {
    /// Their height: what is on the ground. \[mm\]
    pub(crate) height: f64,
    /// Its standard deviation. \[mm\]
    pub(crate) sigma: f64,
    /// Whether there is a foot: long, below an ankle.
    pub(crate) sure: bool,
}

// All lengths are shares of the height of the surface, all areas of its square.

/// Legs are followed from here down, as a share of the body's height: from about the knees, at 0.24 to 0.32 (ANSUR II).
const KNEES_SHARE: f64 = 0.3;
/// From slice to slice (structural: samples).
const STEP: f64 = 0.002;
/// Below this, two rings of a leg are heel and ball; above, two legs. The malleolus is at 0.053 at most (ANSUR II).
const ANKLE_SHARE: f64 = 0.06;
/// A section of a leg is no larger, as a share of the height's square; below the knees. By hand: looked at people,
/// where it is 0.006, and two legs that touch, 0.015.
const LARGEST_AREA: f64 = 0.035;
/// A floor below the feet: so large at least, as a share of the height's square, and so many times as large as what is
/// on it. By hand: looked at three scans, at 0.7 and 1.4 of each: no tape changes.
const FLOOR: (f64, f64) = (0.011, 1.6);
/// How far above the ground half of a bare foot's plan shows, as a share of the body's height. By hand: looked at on
/// two made bodies, 0.0029 and 0.0030.
const ROUND_SHARE: f64 = 0.003;
/// Part of a foot's plan that a body on its toes rests on at least, and how far it may be below the half of it: nearer,
/// it is the edge of a sole that nobody saw. By hand: looked at three scans, at 0.7 and 1.4 of each: no tape changes.
const TOES: (f64, f64) = (0.1, 0.012);
/// A foot is at least so long, as a share of the body's height, and so many times as long as its ankle is deep: of 6
/// 068 people 0.135 and 2.8 times at least (ANSUR II); toes may be lost.
const FOOT: (f64, f64) = (0.075, 1.25);
/// Where the ankle is looked for above the sole, as shares of the body's height: above the malleolus, at 0.053 at most,
/// and below the knee, at 0.24 at least (ANSUR II).
const ANKLE_ABOVE: (f64, f64) = (0.06, 0.15);
/// Standard deviation of a sole that shows, as a share of the body's height. By hand: looked at three scans, at 0.7 and
/// 1.4 of it: no tape changes.
const SOLE_SIGMA: f64 = 0.0015;
/// Standard deviation of what ends without a foot, as a share of the body's height. By hand: looked at thirteen bodies with
/// feet, at half and double of it: no tape changes.
const NO_FOOT_SIGMA: f64 = 0.02;

/// What a leg shows at a height, from the knee down.
#[derive(Debug, Clone, Copy)]
struct Cut {
    z: f64,
    area: f64,
    long: f64,
}

/// A leg, followed down.
#[derive(Debug, Clone, Default)]
struct Leg {
    cuts: Vec<Cut>,
    /// Where its last rings are: low x, low y, high x, high y.
    boxes: Vec<[f64; 4]>,
    /// Whether it ended on a floor that is one with it on the surface.
    floor: bool,
    ended: bool,
}

/// Finds the soles. `None` without anything like a leg.
pub(crate) fn soles(mesh: &Mesh) -> Option<Soles> {
    let body = main_piece(mesh);
    let (low, high) = body.bounds()?;
    let (low, tall) = (low.z, high.z - low.z);
    let top = low + KNEES_SHARE * tall;
    let below = |f: &&[u32; 3]| f.iter().any(|v| body.point(*v).z < top);
    let faces: Vec<[u32; 3]> = body.faces.iter().filter(below).copied().collect();
    let lower = Mesh::packed(&body.positions, &faces);
    let step = STEP * tall;
    let all = followed(&slices(&lower, low, top, step), low, tall);
    let edge = body.mean_edge();
    let ends = all.iter().filter_map(|leg| end(leg, low, tall, step));
    let sole = |(height, foot): (f64, bool)| Soles {
        height,
        sigma: match foot {
            true => libm::hypot(SOLE_SIGMA * tall, 0.3 * edge),
            false => NO_FOOT_SIGMA * tall,
        },
        sure: foot,
    };
    // The lowest foot; without one the lowest end of a leg.
    ends.map(sole)
        .min_by(|a, b| b.sure.cmp(&a.sure).then(a.height.total_cmp(&b.height)))
}

/// The piece of a mesh that has the most surface: specks are none of the body.
fn main_piece(mesh: &Mesh) -> Mesh {
    let pieces = mesh.pieces(|_| true);
    let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
    for (f, piece) in pieces.iter().enumerate() {
        if let Some(piece) = piece {
            *areas.entry(*piece).or_default() += mesh.area_vector(f).norm();
        }
    }
    let main = areas.iter().max_by(|a, b| a.1.total_cmp(b.1)).map(|a| *a.0);
    let faces: Vec<[u32; 3]> = (0..mesh.faces.len())
        .filter(|f| pieces[*f] == main)
        .map(|f| mesh.faces[f])
        .collect();
    Mesh::packed(&mesh.positions, &faces)
}

/// The legs from the knees down: each ring belongs to the leg above it.
fn followed(slices: &[Slice], low: f64, tall: f64) -> Vec<Leg> {
    let square = tall * tall;
    let mut legs: Vec<Leg> = Vec::new();
    for (i, slice) in slices.iter().rev().enumerate() {
        let rings: Vec<&Ring> = slice.rings.iter().collect();
        if i == 0 {
            legs = rings.iter().map(|_| Leg::default()).collect();
        }
        let mut own: Vec<Vec<&Ring>> = vec![Vec::new(); legs.len()];
        for (k, ring) in rings.into_iter().enumerate() {
            let about = bounds(&ring.curve);
            let over = |leg: &Leg| leg.boxes.iter().map(|b| overlap(b, &about)).sum::<f64>();
            let at = match i {
                0 => Some(k),
                _ => (0..legs.len())
                    .filter(|l| !legs[*l].ended && over(&legs[*l]) > 0.0)
                    .max_by(|a, b| over(&legs[*a]).total_cmp(&over(&legs[*b]))),
            };
            if let Some(at) = at {
                own[at].push(ring);
            }
        }
        for (l, rings) in own.into_iter().enumerate() {
            let two = rings.len() > 1 && rings[1].area > 0.4 * rings[0].area;
            if two && slice.z > low + ANKLE_SHARE * tall && !legs[l].ended {
                // Below a hem, or where legs part: the second is a leg of its own.
                let mut other = Leg::default();
                lower(&mut other, &rings[1..], slice.z, square);
                legs.push(other);
                lower(&mut legs[l], &rings[..1], slice.z, square);
            } else if !legs[l].ended {
                lower(&mut legs[l], &rings, slice.z, square);
            }
        }
    }
    legs
}

/// Takes a leg one slice lower.
fn lower(leg: &mut Leg, rings: &[&Ring], z: f64, square: f64) {
    let area: f64 = rings.iter().map(|r| r.area).sum();
    let before = leg.cuts.len().checked_sub(2).map(|i| leg.cuts[i].area);
    let jumps = before.is_some_and(|b| area > FLOOR.0 * square && area > FLOOR.1 * b);
    leg.floor = jumps && !leg.cuts.is_empty();
    leg.ended = rings.is_empty() || jumps || area > LARGEST_AREA * square;
    if leg.ended {
        return;
    }
    let points: Vec<Point3<f64>> = rings.iter().flat_map(|r| r.curve.clone()).collect();
    let long = longest(&points);
    leg.cuts.push(Cut { z, area, long });
    leg.boxes = rings.iter().map(|r| bounds(&r.curve)).collect();
}

/// Where a leg ends, and whether with a foot.
fn end(leg: &Leg, low: f64, tall: f64, step: f64) -> Option<(f64, bool)> {
    let last = leg.cuts.last()?;
    let least = (last.z - step).max(low);
    let plan = leg
        .cuts
        .iter()
        .filter(|c| c.z < last.z + ANKLE_SHARE * tall);
    let most = plan.map(|c| c.area).fold(0.0, f64::max);
    let up: Vec<&Cut> = leg.cuts.iter().rev().collect();
    // Where a share of the plan shows: straight between the cuts about it.
    let shows = |share: f64| {
        let at = up.iter().position(|c| c.area >= share * most)?;
        let Some(before) = at.checked_sub(1) else {
            return Some(least);
        };
        let (a, b) = (up[before], up[at]);
        Some(a.z + (b.z - a.z) * (share * most - a.area) / (b.area - a.area))
    };
    let (half, toes) = (shows(0.5)?, shows(TOES.0)?);
    let half = match half - toes > TOES.1 * tall {
        true => toes,
        false => half,
    };
    let height = match leg.floor {
        true => last.z - step / 2.0,
        false => (half - ROUND_SHARE * tall).max(least),
    };
    let within = |(from, to): (f64, f64)| {
        let range = height + from * tall..height + to * tall;
        let there = leg.cuts.iter().filter(move |c| range.contains(&c.z));
        there.map(|c| c.long)
    };
    let foot = within((0.0, ANKLE_ABOVE.0)).fold(0.0, f64::max);
    let ankle = within(ANKLE_ABOVE).reduce(f64::min);
    let is_foot = foot > FOOT.0 * tall && ankle.is_some_and(|a| foot > FOOT.1 * a);
    Some((height, is_foot))
}

/// The greatest breadth of points, seen from above. \[mm\]
fn longest(points: &[Point3<f64>]) -> f64 {
    let along = |k: u32| {
        let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::PI / 18.0);
        let reach = points.iter().map(|p| c * p.x + s * p.y);
        let (low, high) = reach.fold((f64::MAX, f64::MIN), |e, x| (e.0.min(x), e.1.max(x)));
        (high - low).max(0.0)
    };
    (0..18).map(along).fold(0.0, f64::max)
}

fn bounds(curve: &[Point3<f64>]) -> [f64; 4] {
    curve.iter().fold(
        [f64::MAX, f64::MAX, f64::MIN, f64::MIN],
        |[x, y, u, v], p| [x.min(p.x), y.min(p.y), u.max(p.x), v.max(p.y)],
    )
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    let side = |k: usize| (a[k + 2].min(b[k + 2]) - a[k].max(b[k])).max(0.0);
    side(0) * side(1)
}
