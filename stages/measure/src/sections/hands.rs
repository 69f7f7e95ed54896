//! Hands and forearms that touch hip or thigh: whether a section holds one.

use crate::features::arms::arm_ring;
use crate::features::body::Body;
use crate::geometry::slices::{Ring, Slice};
use nalgebra::Point3;

/// A hand and a wrist are at most so long, as a share of stature: of 6 068 people two have longer hands (ANSUR II).
const HAND_SHARE: f64 = 0.13;
/// Over so much of an arm its way is taken, as a share of stature; what is shorter than half of it is no arm. By hand:
/// looked at thirteen bodies, at half and double of it: no tape changes, intervals change by at most 85 and 0 %.
const WAY_SHARE: f64 = 0.03;

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

/// Whether the arm of a side (1 left, -1 right) is too far from a level section to be in it: it is clear in a slice within a
/// hand's length of that height, and in the nearest such slice it is farther than a hand is long from all of the section.
pub(crate) fn out_of_reach(body: &Body, section: &Ring, side: f64) -> bool {
    let (z, far) = (section.centre.z, HAND_SHARE * body.stature);
    let clear = body
        .between(z - far, z + far)
        .filter_map(|s| arm_ring(body, &s.rings, side));
    let off = |r: &&Ring| (r.centre.z - z).abs();
    let nearest = clear.min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.is_some_and(|arm| section.curve.iter().all(|p| (p - arm.centre).norm() > far))
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
    let joined = |r: &Ring| holds(r, end.centre);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn disk(x: f64, z: f64, radius: f64) -> Ring {
        let point = |k: u32| {
            let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 90.0);
            Point3::new(x + radius * c, radius * s, z)
        };
        let area = std::f64::consts::PI * radius * radius;
        Ring {
            curve: (0..90).map(point).collect(),
            area,
            tape: 2.0 * area / radius,
            centre: Point3::new(x, 0.0, z),
        }
    }

    /// A trunk of 150 mm, and a wrist at 400 mm that ends at a height of 1000.
    fn body(wrist: f64) -> Body {
        let slices = (800..1300).step_by(5).map(|z| {
            let z = f64::from(z);
            let arm = (z >= 1000.0).then(|| disk(wrist, z, 30.0));
            let rings = [disk(0.0, z, 150.0)].into_iter().chain(arm).collect();
            Slice { z, rings }
        });
        Body::of_slices(slices.collect())
    }

    #[test]
    fn an_arm_that_ends_far_from_the_hip_is_not_in_it_and_one_that_ends_beside_it_may_be() {
        let hip = disk(0.0, 950.0, 150.0);
        assert!(out_of_reach(&body(400.0), &hip, 1.0));
        assert!(
            !out_of_reach(&body(300.0), &hip, 1.0),
            "a hand reaches so far"
        );
        assert!(!out_of_reach(&body(400.0), &hip, -1.0), "no arm is known");
        let below = disk(0.0, 770.0, 150.0);
        assert!(
            !out_of_reach(&body(400.0), &below, 1.0),
            "too far down to tell"
        );
    }
}
