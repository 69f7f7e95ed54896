//! What of a section no outline confirms: where no photo's border runs beside the body for a while
//! (hands are before it, or photos are few), a visual hull ends in a corner that need not be body.

use crate::geometry::section::{hull, length};
use nalgebra::{Point2, Point3, Vector2};
use std::f64::consts::TAU;

/// Directions without an outline that are noted: from here on, and up to here.
/// By hand: looked at five captures, at 0.7 and 1.4 of it: intervals change by at most 1 and 0 %. \[rad\]
const OPEN_RAD: std::ops::Range<f64> = 20.0 * TAU / 360.0..150.0 * TAU / 360.0;
/// How far beyond a stretch its corner is looked for, to either side.
/// By hand: looked at five captures, at 0.7 and 1.4 of it: intervals change by at most 6 and 14 %. \[rad\]
const BESIDE_RAD: f64 = 0.1;
/// How near a line of sight may come to another limb, as a share of the section's half breadth: limbs sway, and their
/// surface falls short where they are thin. By hand: looked at five captures, at 0.7 and 1.4 of it:
/// intervals change by at most 7 and 9 %.
const CLEARANCE_SHARE: f64 = 0.2;

/// Angles of the outward normals of the two lines of sight from an eye that touch a level curve, of
/// those that keep clear of all other limbs. \[rad\]
pub(crate) fn clear_sights(
    curve: &[Point3<f64>],
    limbs: &[&[Point3<f64>]],
    origin: Point3<f64>,
    eye: Point3<f64>,
) -> Vec<f64> {
    let wide = curve.iter().map(|p| (p - origin).xy().norm());
    let clearance = CLEARANCE_SHARE * wide.fold(0.0, f64::max);
    let normal = |p: &Point3<f64>, turn: f64| {
        let way = (p - eye).xy().normalize();
        Vector2::new(turn * way.y, -turn * way.x)
    };
    let side = |turn: f64| {
        let axis = normal(&origin, turn);
        let lean = |p: &Point3<f64>| axis.dot(&(p - eye).xy().normalize());
        let touch = curve.iter().max_by(|a, b| lean(a).total_cmp(&lean(b)))?;
        let n = normal(touch, turn);
        let met = |limb: &&[Point3<f64>]| {
            let out = limb.iter().map(|p| n.dot(&(p - touch).xy()));
            let (near, far) = out.fold((f64::MAX, f64::MIN), |e, d| (e.0.min(d), e.1.max(d)));
            near < clearance && far > -clearance
        };
        (!limbs.iter().any(met)).then(|| libm::atan2(n.y, n.x).rem_euclid(TAU))
    };
    [1.0, -1.0].into_iter().filter_map(side).collect()
}

/// How much longer a section's tape is than round arcs over the stretches without an outline: what
/// of it is corners that no outline confirms. `sights` are angles of normals. \[mm\]
pub(crate) fn unconfirmed(section: &[[f64; 2]], mut sights: Vec<f64>) -> f64 {
    sights.sort_by(f64::total_cmp);
    let around = hull(section);
    let n = around.len();
    if n < 3 || sights.len() < 3 {
        return 0.0;
    }
    let point = |i: usize| Point2::from(around[i % n]);
    let touch = |angle: f64| {
        let way = Vector2::new(libm::cos(angle), libm::sin(angle));
        let far = |i: &usize| point(*i).coords.dot(&way);
        let all = (0..n).max_by(|a, b| far(a).total_cmp(&far(b)));
        all.expect("bug: no point")
    };
    let mut more = 0.0;
    for (i, from) in sights.iter().enumerate() {
        let to = sights[(i + 1) % sights.len()];
        let open = (to - from).rem_euclid(TAU);
        if !OPEN_RAD.contains(&open) {
            continue;
        }
        let turned = open + 2.0 * BESIDE_RAD;
        let (a, b) = (touch(from - BESIDE_RAD), touch(to + BESIDE_RAD));
        let steps = (b + n - a) % n;
        let path: f64 = (a..a + steps)
            .map(|k| (point(k + 1) - point(k)).norm())
            .sum();
        let chord = (point(b) - point(a)).norm();
        let arc = chord * (turned / 2.0) / libm::sin(turned / 2.0);
        more += (path - arc).max(0.0);
    }
    more.min(length(&around))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An ellipse of 360 by 240 mm; where its normal is within the half angle about the front it may
    /// run out to the corner of its tangents there.
    fn section(corner: Option<f64>) -> (Vec<[f64; 2]>, f64) {
        let at = |t: f64| [180.0 * libm::cos(t), 120.0 * libm::sin(t)];
        let normal = |t: f64| libm::atan2(libm::sin(t) / 120.0, libm::cos(t) / 180.0);
        let all = (0..720).map(|k| TAU * f64::from(k) / 720.0);
        let Some(half) = corner else {
            return (all.map(at).collect(), 0.0);
        };
        let off = |t: f64| (normal(t) - TAU / 4.0).abs();
        let round: Vec<f64> = all.clone().filter(|t| off(*t) > half).collect();
        let cut: Vec<f64> = all.filter(|t| off(*t) <= half).collect();
        let (first, last) = (at(cut[0]), at(cut[cut.len() - 1]));
        // By symmetry the tangents meet before the middle.
        let tip = first[1] + first[0] * libm::tan(half);
        let mut points: Vec<[f64; 2]> = round.iter().map(|t| at(*t)).collect();
        let place = round.iter().filter(|t| **t < TAU / 4.0).count();
        points.splice(place..place, [first, [0.0, tip], last]);
        let arc = length(&cut.iter().map(|t| at(*t)).collect::<Vec<_>>())
            - libm::hypot(first[0] - last[0], first[1] - last[1]);
        let legs = 2.0 * libm::hypot(first[0], tip - first[1]);
        (points, legs - arc)
    }

    #[test]
    fn a_corner_that_no_outline_confirms_is_noted_and_a_round_front_is_not() {
        let half = 33f64.to_radians();
        let every = |step: usize| {
            (0..360)
                .step_by(step)
                .map(|d| f64::from(d as u32).to_radians())
        };
        let front = |a: &f64| (a - TAU / 4.0).abs() < half;
        let open: Vec<f64> = every(10).filter(|a| !front(a)).collect();
        let (round, _) = section(None);
        let (cornered, more) = section(Some(half));
        assert!(more > 10.0, "{more}");
        let reported = unconfirmed(&cornered, open.clone());
        assert!(
            (0.6..1.4).contains(&(reported / more)),
            "{reported} for {more}"
        );
        let least = unconfirmed(&round, open);
        assert!(least < 0.15 * more, "{least}");
        assert_eq!(unconfirmed(&cornered, every(10).collect()), 0.0);
    }
}
