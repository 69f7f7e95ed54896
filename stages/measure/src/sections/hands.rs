//! Hands and forearms that touch hip or thigh: whether a section holds one.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use crate::geometry::slices::{Ring, Slice};
use nalgebra::Point3;

/// A hand and a wrist are at most so long, as a share of stature: of 6 068 people two have longer hands (ANSUR II).
const HAND_SHARE: f64 = 0.13;
/// Over so much of an arm its way is taken, as a share of stature; what is shorter than half of it is no arm. By hand:
/// not on record.
const WAY_SHARE: f64 = 0.03;
/// A ring that takes an arm in is at least so many times as large as the arm's own. By hand: looked at three scans, at
/// 0.7 and 1.4 of it: no tape changes.
const LARGER_FACTOR: f64 = 2.0;

/// Whether a level section holds the hand or forearm of a side (1 left, -1 right): in the nearest
/// slices in which that arm is clear it runs into a larger ring, not to its fingertips, and its
/// way leads on into this section.
pub(crate) fn holds_hand(body: &Body, ring: &Ring, side: f64) -> bool {
    let z = ring.centre.z;
    let far = HAND_SHARE * body.stature;
    let slices: Vec<&Slice> = body.between(z - far, z + far).collect();
    let split = slices.partition_point(|s| s.z < z);
    let (below, above) = slices.split_at(split);
    // Each from the section outward.
    let above: Vec<&Slice> = above.to_vec();
    let below: Vec<&Slice> = below.iter().rev().copied().collect();
    runs_into(body, &above, ring, side) || runs_into(body, &below, ring, side)
}

/// Whether the arm that is clear in one of these slices, the nearest to a section first, runs
/// into a larger ring toward the section, and is in it.
fn runs_into(body: &Body, slices: &[&Slice], section: &Ring, side: f64) -> bool {
    let ring = |s: &Slice| arm_ring(body, &s.rings, side).cloned();
    let Some(first) = slices.iter().position(|s| ring(s).is_some()) else {
        return false;
    };
    let Some(end) = ring(slices[first]) else {
        return false;
    };
    let joined = |r: &Ring| r.area > LARGER_FACTOR * end.area && holds(r, end.centre);
    let runs = match first {
        0 => joined(section),
        _ => slices[first - 1].rings.iter().any(joined),
    };
    if !runs {
        return false;
    }
    // Its way on: the line through its middles.
    let away = |s: &&&Slice| (s.z - end.centre.z).abs() <= WAY_SHARE * body.stature;
    let middles = slices[first..].iter().take_while(away);
    let Some(last) = middles.filter_map(|s| ring(s)).last() else {
        return false;
    };
    let rise = end.centre.z - last.centre.z;
    if rise.abs() < 0.5 * WAY_SHARE * body.stature {
        return false;
    }
    let way = (end.centre - last.centre) / rise;
    holds(
        section,
        end.centre + way * (section.centre.z - end.centre.z),
    )
}

/// Whether a level ring goes around a point.
pub(crate) fn holds(ring: &Ring, p: Point3<f64>) -> bool {
    let mut inside = false;
    for (i, a) in ring.curve.iter().enumerate() {
        let b = ring.curve[(i + 1) % ring.curve.len()];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}
