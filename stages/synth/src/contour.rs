//! The section of a solid by a plane, from its formula: no mesh is involved.

use crate::field::{Field, STEEP};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use shape::{Plane, Solid};

/// Directions in which a section is looked for: its length is then short by a ten-millionth.
/// (structural: its error is given.)
const DIRECTIONS: usize = 4096;
/// How far apart the formula is asked before a border is closed in on (structural: samples). \[mm\]
const STRIDE: f64 = 1.5;

/// The closed curve in which a plane cuts a solid around the plane's point: where straight lines
/// from there first leave the solid. `None` if the point is outside, or a line leaves nowhere
/// within three metres. The curve is the whole section if that is star-shaped about the point.
pub fn contour(solid: &Solid, plane: &Plane) -> Option<Vec<Point3<f64>>> {
    let from = Point3::from(plane.point_mm);
    let field = Field::new(solid);
    if field.value(&from) >= 0.0 {
        return None;
    }
    let normal = Vector3::from(plane.normal).normalize();
    let other = if normal.z.abs() > 0.9 {
        Vector3::x()
    } else {
        Vector3::z()
    };
    let u = (other - normal * normal.dot(&other)).normalize();
    let v = normal.cross(&u);
    let leave = |k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / DIRECTIONS as f64);
        let along = u * cos + v * sin;
        let value = |r: f64| field.value(&(from + along * r));
        let mut high = STRIDE;
        while let Some(deep) = Some(-value(high)).filter(|deep| *deep > 0.0) {
            // So far inside no border comes within these strides.
            let sure = (deep / STEEP / STRIDE) as usize;
            (0..sure.max(1)).for_each(|_| high += STRIDE);
            if high > 3000.0 {
                return None;
            }
        }
        Some(from + along * crossing(value, high - STRIDE, high))
    };
    (0..DIRECTIONS).into_par_iter().map(leave).collect()
}

/// Where a function that is negative at the lower end of an interval and not at the upper is 0: by chords, of which
/// the end that stays counts half (Dowell and Jarratt 1971).
fn crossing(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut inside, mut outside, mut at) = (value(low), value(high), low);
    let mut side = 0;
    for _ in 0..60 {
        let before = at;
        at = low + (high - low) * (inside / (inside - outside)).clamp(0.0, 1.0);
        let there = value(at);
        let now = if there < 0.0 { -1 } else { 1 };
        if now < 0 {
            (low, inside) = (at, there);
            outside *= if side == now { 0.5 } else { 1.0 };
        } else {
            (high, outside) = (at, there);
            inside *= if side == now { 0.5 } else { 1.0 };
        }
        side = now;
        if (at - before).abs() < 1e-10 || there == 0.0 {
            break;
        }
    }
    at
}

/// Length of a closed curve. \[mm\]
pub fn length(curve: &[Point3<f64>]) -> f64 {
    let next = |i: usize| curve[(i + 1) % curve.len()];
    (0..curve.len()).map(|i| (next(i) - curve[i]).norm()).sum()
}

/// What of a closed plane curve a tape touches: its convex hull (Andrew 1979).
pub fn taut(curve: &[Point3<f64>], plane: &Plane) -> Vec<Point3<f64>> {
    let normal = Vector3::from(plane.normal).normalize();
    let Some(first) = curve.first() else {
        return vec![];
    };
    let far = |p: &&Point3<f64>| (*p - first).norm_squared();
    let last = curve.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
    let Some(u) = last.and_then(|l| (l - first).try_normalize(0.0)) else {
        return curve.to_vec();
    };
    let along = |p: &Point3<f64>| (u.dot(&(p - first)), normal.cross(&u).dot(&(p - first)));
    let mut sorted = curve.to_vec();
    sorted.sort_by(|a, b| {
        let (a, b) = (along(a), along(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let chain = |points: &mut dyn Iterator<Item = &Point3<f64>>| {
        let mut chain: Vec<Point3<f64>> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).cross(&(p - b)).dot(&normal) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter());
    hull.extend(chain(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{Build, body};

    #[test]
    fn strides_that_are_passed_over_hold_no_border() {
        let solid = body(&Build {
            stature: 1750.0,
            stout: 1.1,
            furrow: 14.0,
            arms: 0.6,
            exponent: 2.3,
        });
        let field = Field::new(&solid);
        for z in [400.0, 870.0, 1000.0, 1300.0] {
            let plane = Plane {
                point_mm: [if z < 800.0 { 103.0 } else { 0.0 }, 14.0, z],
                normal: [0.0, 0.1, 1.0],
            };
            let curve = contour(&solid, &plane).unwrap();
            let from = Point3::from(plane.point_mm);
            for point in curve.iter().step_by(64) {
                let way = point - from;
                let long = way.norm();
                let strides = (1..).map(|k| f64::from(k) * STRIDE);
                let passed = strides.take_while(|r| *r < long - 1e-6);
                for r in passed {
                    assert!(field.value(&(from + way * (r / long))) < 0.0, "{z}: {r}");
                }
            }
        }
    }
}
