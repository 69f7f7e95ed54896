//! The section of a landmark on a mesh, with other limbs taken off before anything is measured.

use crate::features::arms::{Axis, arm_ring, merged, upper_arm_axis};
use crate::features::body::Body;
use crate::features::extent::extent;
use crate::features::marks::hip;
use crate::geometry::slices::{Ring, Slice, nearest_ring, rings};
use crate::sections::across_arm::across_arm;
use crate::sections::across_arm_of_hull::across_arm_of_hull;
use crate::sections::across_leg::across_leg;
use crate::sections::hands::{holds, holds_hand, out_of_reach};
use crate::sections::lobe::lobe;
use crate::sections::one::{FUSED, HAND, NO_ARMS, NOTHING, SectionMeasurement, Why, plain};
use crate::sections::split::parted;
use nalgebra::Point3;
use shape::{Landmark, Mesh, Part, Region};
use std::f64::consts::PI;
use std::ops::Range;

/// Takes the section of a landmark.
///
/// # Errors
///
/// Why there is no section there that is the part's.
pub fn taken(
    mesh: &Mesh,
    body: Option<&Body>,
    landmark: &Landmark,
) -> Result<SectionMeasurement, Why> {
    match (landmark.part, body) {
        // A forearm is clear of the trunk, or its limb was not followed.
        (Part::ArmLeft | Part::ArmRight, Some(_)) if landmark.region == Region::Forearm => plain(
            &landmark.plane,
            nearest_ring(mesh, &landmark.plane).ok_or(NOTHING)?,
        ),
        (Part::Trunk, Some(body)) => trunk(mesh, body, landmark),
        (Part::ArmLeft, Some(body)) => arm(mesh, body, landmark, 1.0),
        (Part::ArmRight, Some(body)) => arm(mesh, body, landmark, -1.0),
        (Part::LegLeft, Some(body)) => across_leg(mesh, body, landmark, 1.0),
        (Part::LegRight, Some(body)) => across_leg(mesh, body, landmark, -1.0),
        _ => plain(
            &landmark.plane,
            nearest_ring(mesh, &landmark.plane).ok_or(NOTHING)?,
        ),
    }
}

/// The section of an upper arm. Where a surface has webs between arm and trunk its folds are not the skin's, and the arm
/// follows from its outer half; by the folds two such bodies came out 3 to 4 % too large.
fn arm(
    mesh: &Mesh,
    body: &Body,
    landmark: &Landmark,
    side: f64,
) -> Result<SectionMeasurement, Why> {
    if body.carved {
        across_arm_of_hull(mesh, body, landmark, side)
    } else {
        across_arm(mesh, body, landmark, side)
    }
}

/// Whether the arm of a side has a section of its own at a height.
fn is_clear(body: &Body, z: f64, side: f64) -> bool {
    let slice = body.slice(z);
    slice.is_some_and(|s| arm_ring(body, &s.rings, side).is_some())
}

/// The sides of arms that are clear somewhere beside the trunk, and their axes.
fn beside(body: &Body) -> Vec<(f64, Axis)> {
    let Some(low) = hip(body) else {
        return vec![];
    };
    let one = |side: f64| Some((side, upper_arm_axis(body, side, low)?));
    [1.0, -1.0].into_iter().filter_map(one).collect()
}

fn trunk(mesh: &Mesh, body: &Body, landmark: &Landmark) -> Result<SectionMeasurement, Why> {
    let plane = &landmark.plane;
    let z = plane.point_mm[2];
    let ring = rings(mesh, plane).into_iter().next().ok_or(NOTHING)?;
    let arms = beside(body);
    let fused: Vec<f64> = arms
        .iter()
        .filter(|(_, axis)| z > axis.point.z)
        .filter(|(side, axis)| holds(&ring, axis.at(z)) || !is_clear(body, z, *side))
        .map(|arm| arm.0)
        .collect();
    // Arms that are clear nowhere, or touch below where they do. About the chest the trunk's own sides swell, too: there
    // what hangs is narrower where it hangs.
    let least = match landmark.region {
        Region::Chest => PI,
        _ => 0.0,
    };
    let hangs = |side: &f64| {
        let hidden =
            !fused.contains(side) && !is_clear(body, z, *side) && !out_of_reach(body, &ring, *side);
        hidden && lobe(body, &ring, *side).is_some_and(|turned| turned > least)
    };
    let hanging: Vec<f64> = [1.0, -1.0].into_iter().filter(hangs).collect();
    let seen = |side: f64| {
        let own = hanging.contains(&side) || arms.iter().any(|arm| arm.0 == side);
        own || raised(body, z, side)
    };
    if landmark.region == Region::Chest && !(seen(1.0) && seen(-1.0)) {
        return Err(NO_ARMS);
    }
    // Hands end beside the hip, where it widens: there they hide it, and a jump is no sign of an arm.
    let beside_hands = landmark.region == Region::Hip;
    let mut hands = vec![];
    if fused.is_empty() {
        let rest = || [1.0, -1.0].into_iter().filter(|s| !hanging.contains(s));
        hands.extend(rest().filter(|side| holds_hand(body, &ring, *side)));
        if beside_hands && !hands.is_empty() {
            return Err(HAND);
        }
        if !beside_hands && hands.is_empty() && rest().any(|side| merged(body, z, side)) {
            return Err(FUSED);
        }
    }
    let why = if hands.is_empty() { FUSED } else { HAND };
    let sides = [fused, hanging, hands].concat();
    if sides.is_empty() {
        return plain(plane, ring);
    }
    cut_off(body, &sides, &ring).ok_or(why)
}

/// Whether the arm of a side is lifted above a height: up to the neck something reaches out twice as far as there (structural:
/// shoulders do not).
fn raised(body: &Body, z: f64, side: f64) -> bool {
    let reach = |s: &Slice| {
        let ends = s.rings.first().and_then(|r| extent(r, &body.left));
        let trunk = body.trunk(z).map(|r| r.centre.coords.dot(&body.left));
        let (low, high) = ends?;
        Some(if side > 0.0 {
            high - trunk?
        } else {
            trunk? - low
        })
    };
    let Some(here) = body.slice(z).and_then(reach) else {
        return false;
    };
    let top = body.neck.unwrap_or(z);
    body.between(z, top)
        .filter_map(reach)
        .any(|out| out > 2.0 * here)
}

/// The middle of a trunk at a height: of the nearest section of which both arms are part, or neither.
fn middle(body: &Body, z: f64) -> Option<Point3<f64>> {
    let clear = |s: &Slice, side| arm_ring(body, &s.rings, side).is_some();
    let even = |s: &&Slice| !s.rings.is_empty() && clear(s, 1.0) == clear(s, -1.0);
    let over = body.slices.partition_point(|s| s.z <= z);
    let (below, above) = body.slices.split_at(over);
    let off = |s: &&Slice| (s.z - z).abs();
    let nearest = [below.iter().rev().find(even), above.iter().find(even)];
    let nearest = nearest.into_iter().flatten();
    let nearest = nearest.min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map(|s| s.rings[0].centre)
}

/// Sections to either side of one that vouch for its seams (structural: samples).
const BESIDE: usize = 4;

/// The trunk with its arms cut off at the seams that its own outline shows, and those of the sections beside it.
fn cut_off(body: &Body, sides: &[f64], ring: &Ring) -> Option<SectionMeasurement> {
    let (u, v) = (&body.left, &body.front);
    let z = ring.centre.z;
    let middle = middle(body, z).unwrap_or(ring.centre);
    let flat = |ring: &Ring| -> Vec<[f64; 2]> {
        let way = ring.curve.iter().map(|p| p - middle);
        way.map(|p| [p.dot(u), p.dot(v)]).collect()
    };
    let over = body.slices.partition_point(|s| s.z <= z);
    let below = &body.slices[over.saturating_sub(BESIDE)..over];
    let above = &body.slices[over..(over + BESIDE).min(body.slices.len())];
    let beside = |all: &[Slice]| -> Vec<Vec<[f64; 2]>> {
        all.iter()
            .map(|s| s.rings.first().map_or(vec![], flat))
            .collect()
    };
    let own = below.len();
    let outlines = [beside(below), vec![flat(ring)], beside(above)].concat();
    let arm = |side: &f64| {
        let one = |s: &&Slice| arm_ring(body, &s.rings, *side).is_none() && !s.rings.is_empty();
        let down = below.iter().rev().take_while(one).count();
        let up = above.iter().take_while(one).count();
        (*side, own - down..own + 1 + up)
    };
    let all: Vec<(f64, Range<usize>)> = sides.iter().map(arm).collect();
    let free = parted(&outlines, own, &all)?;
    Some(free.section(Point3::new(middle.x, middle.y, z), (u, v)))
}
