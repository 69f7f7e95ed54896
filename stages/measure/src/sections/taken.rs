//! The section of a landmark on a mesh, with other limbs taken off before anything is measured.

use crate::features::arms::{Axis, arm_ring, merged, upper_arm_axis};
use crate::features::body::Body;
use crate::features::extent::extent;
use crate::features::marks::hip;
use crate::geometry::carry::{Carried, RAYS, carried, ray, reaches};
use crate::geometry::section::{axes, flat, length, tape};
use crate::geometry::slices::{Ring, rings};
use crate::sections::across_arm::across_arm;
use crate::sections::across_arm_of_hull::across_arm_of_hull;
use crate::sections::across_leg::across_leg;
use crate::sections::hands::{holds, holds_hand, out_of_reach};
use crate::sections::lobe::lobe;
use crate::sections::one::{
    FUSED, HAND, NO_ARMS, NOTHING, SectionMeasurement, Spline, Why, nearest, plain,
};
use crate::sections::split::parted;
use nalgebra::{Point3, Vector3};
use shape::{Landmark, Mesh, Part, Plane, Region};
use std::f64::consts::PI;

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
            nearest(mesh, &landmark.plane).ok_or(NOTHING)?,
        ),
        (Part::Trunk, Some(body)) => trunk(mesh, body, landmark),
        (Part::ArmLeft, Some(body)) => arm(mesh, body, landmark, 1.0),
        (Part::ArmRight, Some(body)) => arm(mesh, body, landmark, -1.0),
        (Part::LegLeft, Some(body)) => across_leg(mesh, body, landmark, 1.0),
        (Part::LegRight, Some(body)) => across_leg(mesh, body, landmark, -1.0),
        _ => plain(
            &landmark.plane,
            nearest(mesh, &landmark.plane).ok_or(NOTHING)?,
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

/// From points about an origin in a plane.
fn completed(origin: Point3<f64>, plane: &Plane, whole: Carried) -> SectionMeasurement {
    let (u, v) = axes(plane);
    let knots: Vec<[f64; 2]> = whole.points.iter().step_by(5).copied().collect();
    let contour_mm = length(&whole.points);
    SectionMeasurement {
        contour: whole
            .points
            .iter()
            .map(|p| origin + u * p[0] + v * p[1])
            .collect(),
        contour_mm,
        tape_mm: tape(&whole.points),
        spline: Spline::Knots(knots),
        carried: whole.share,
        sigma_mm: 0.06 * whole.share * tape(&whole.points),
    }
}

/// Reaches of a ring about a point of its plane.
fn about(ring: &Ring, origin: Point3<f64>, plane: &Plane) -> Vec<Option<f64>> {
    let plane = Plane {
        point_mm: origin.into(),
        ..*plane
    };
    reaches(&flat(&ring.curve, &plane))
}

/// Whether the arm of a side has a section of its own at a height.
fn is_clear(body: &Body, z: f64, side: f64) -> bool {
    let slice = body.slice(z);
    slice.is_some_and(|s| arm_ring(body, &s.rings, side).is_some())
}

/// An arm beside the trunk: its side, its axis, and half its breadth in a level section. \[mm\]
struct Beside {
    side: f64,
    axis: Axis,
    half: f64,
}

fn beside(body: &Body) -> Vec<Beside> {
    let Some(low) = hip(body) else {
        return vec![];
    };
    let one = |side: f64| {
        let axis = upper_arm_axis(body, side, low)?;
        let clear = body
            .between(low, f64::MAX)
            .filter_map(|s| arm_ring(body, &s.rings, side));
        let top = clear
            .filter(|r| r.centre.z > axis.point.z)
            .filter_map(|r| extent(r, &body.left))
            .map(|(lo, hi)| (hi - lo) / 2.0);
        let half = top.reduce(f64::max)?;
        Some(Beside { side, axis, half })
    };
    [1.0, -1.0].into_iter().filter_map(one).collect()
}

fn trunk(mesh: &Mesh, body: &Body, landmark: &Landmark) -> Result<SectionMeasurement, Why> {
    let plane = &landmark.plane;
    let z = plane.point_mm[2];
    let ring = rings(mesh, plane).into_iter().next().ok_or(NOTHING)?;
    let arms = beside(body);
    let fused: Vec<&Beside> = arms
        .iter()
        .filter(|arm| z > arm.axis.point.z)
        .filter(|arm| holds(&ring, arm.axis.at(z)) || !is_clear(body, z, arm.side))
        .collect();
    // Arms that are clear nowhere, or touch below where they do. About the chest the trunk's own sides swell, too: there
    // what hangs is narrower where it hangs.
    let least = match landmark.region {
        Region::Chest => PI,
        _ => 0.0,
    };
    let known = |side: f64| fused.iter().any(|arm| arm.side == side);
    let hangs = |side: &f64| {
        let hidden =
            !known(*side) && !is_clear(body, z, *side) && !out_of_reach(body, &ring, *side);
        hidden && lobe(body, &ring, *side).is_some_and(|turned| turned > least)
    };
    let hanging: Vec<f64> = [1.0, -1.0].into_iter().filter(hangs).collect();
    let seen = |side: f64| {
        let own = hanging.contains(&side) || arms.iter().any(|arm| arm.side == side);
        own || raised(body, z, side)
    };
    if landmark.region == Region::Chest && !(seen(1.0) && seen(-1.0)) {
        return Err(NO_ARMS);
    }
    if fused.is_empty() {
        let mut rest = [1.0, -1.0].into_iter().filter(|s| !hanging.contains(s));
        if rest.clone().any(|side| holds_hand(body, &ring, side)) {
            return Err(HAND);
        }
        // Hands end beside the hip, where it widens: there a jump tells nothing.
        let beside_hands = landmark.region == Region::Hip;
        if !beside_hands && rest.any(|side| merged(body, z, side)) {
            return Err(FUSED);
        }
        if hanging.is_empty() {
            return plain(plane, ring);
        }
    }
    let sides = fused.iter().map(|arm| arm.side);
    let sides: Vec<f64> = sides.chain(hanging.iter().copied()).collect();
    if let Some(free) = cut_off(body, &sides, &ring) {
        return Ok(free);
    }
    if !hanging.is_empty() {
        return Err(FUSED);
    }
    // The highest slice below in which these arms are clear, a little lower: above, the gap is
    // filled already.
    let clear = |s: &&crate::geometry::slices::Slice| {
        fused
            .iter()
            .all(|arm| arm_ring(body, &s.rings, arm.side).is_some())
    };
    let low = z - 0.08 * body.stature;
    let highest = body.between(low, z).filter(clear).last().ok_or(FUSED)?.z;
    let below = highest - 0.008 * body.stature;
    let reference = body.between(low, below).filter(clear).last().ok_or(FUSED)?;
    let mut origin = reference.rings[0].centre;
    let clear = about(&reference.rings[0], origin, plane);
    origin.z = z;
    let here = about(&ring, origin, plane);
    let hidden = behind_arms(body, &fused, &here, &clear, origin, plane);
    let whole = carried(&here, &clear, &hidden, &(0.97..=1.03)).ok_or(FUSED)?;
    Ok(completed(origin, plane, whole))
}

/// Whether the arm of a side is lifted above a height: up to the neck something reaches out twice as far as there (structural:
/// shoulders do not).
fn raised(body: &Body, z: f64, side: f64) -> bool {
    let reach = |s: &crate::geometry::slices::Slice| {
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

/// The trunk with its arms cut off at the seams that its own outline shows.
fn cut_off(body: &Body, sides: &[f64], ring: &Ring) -> Option<SectionMeasurement> {
    let (u, v) = (&body.left, &body.front);
    let arms = body.trunk(ring.centre.z).map_or(ring.centre, |r| r.centre);
    let flat = |p: &Point3<f64>| [(p - arms).dot(u), (p - arms).dot(v)];
    let outline: Vec<[f64; 2]> = ring.curve.iter().map(flat).collect();
    let free = parted(&outline, [0.0, 0.0], sides)?;
    let knots: Vec<[f64; 2]> = free.points.iter().step_by(8).copied().collect();
    let contour_mm = length(&free.points);
    Some(SectionMeasurement {
        contour: free
            .points
            .iter()
            .map(|p| Point3::new(arms.x, arms.y, ring.centre.z) + u * p[0] + v * p[1])
            .collect(),
        contour_mm,
        tape_mm: tape(&free.points),
        spline: Spline::Knots(knots),
        carried: free.share,
        sigma_mm: free.sigma_mm,
    })
}

/// How much farther out a ray may reach than those nearer the middle of chest and back. By hand: not on record.
const SWELL_FACTOR: f64 = 1.02;
/// Rays this near to straight forward or back always show the trunk. By hand: not on record. \[°\]
const SURE_DEG: usize = 20;

/// Which rays of a trunk show an arm, or the filled fold between arm and trunk: from the middle of
/// chest and back outward, all from the first that reaches an arm or swells against the clear section.
fn behind_arms(
    body: &Body,
    fused: &[&Beside],
    here: &[Option<f64>],
    clear: &[Option<f64>],
    origin: Point3<f64>,
    plane: &Plane,
) -> Vec<bool> {
    let (u, v) = axes(plane);
    let nearest = |d: &Vector3<f64>| {
        let turn = libm::atan2(v.dot(d), u.dot(d)) / std::f64::consts::TAU;
        (turn * RAYS as f64).round() as i64
    };
    let mut hidden = vec![false; RAYS];
    for arm in fused {
        let inner = arm.axis.at(origin.z).coords.dot(&body.left) * arm.side - arm.half;
        for from in [nearest(&body.front), nearest(&-body.front)] {
            // Toward the arm's side: the way in which rays come nearer to it.
            let way = if ray_at(from + 10, &u, &v).dot(&body.left) * arm.side > 0.0 {
                1
            } else {
                -1
            };
            let (mut least, mut lost) = (f64::MAX, false);
            for d in 0..=(RAYS / 4) as i64 {
                let k = (from + way * d).rem_euclid(RAYS as i64) as usize;
                let ratio = here[k].zip(clear[k]).map(|(h, c)| h / c);
                let reached = here[k].is_none_or(|r| {
                    let p = origin + ray_at(k as i64, &u, &v) * r;
                    p.coords.dot(&body.left) * arm.side > inner
                });
                let swells = ratio.is_none_or(|r| r > SWELL_FACTOR * least);
                lost |= reached || (d > SURE_DEG as i64 && swells);
                hidden[k] |= lost;
                least = least.min(ratio.unwrap_or(f64::MAX));
            }
        }
    }
    hidden
}

/// A ray's direction in the world.
fn ray_at(k: i64, u: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    let [c, s] = ray(k.rem_euclid(RAYS as i64) as usize);
    u * c + v * s
}
