//! What hangs at the side of a section and is none of it: an arm that touches trunk or thigh shows as a lobe between two
//! folds, whether or not it is clear anywhere.

use crate::features::arms::small;
use crate::features::body::Body;
use crate::geometry::section::area;
use crate::geometry::slices::Ring;
use crate::sections::fold::fold;
use crate::sections::split::{SAMPLES, even};

/// How far the outline of a level section turns around a lobe on a side (1 left, -1 right): from its outermost point on it
/// turns back to both sides, and what is between is as small as an arm beside the rest. `None` without one. \[rad\]
pub(crate) fn lobe(body: &Body, ring: &Ring, side: f64) -> Option<f64> {
    let flat = ring.curve.iter().map(|p| {
        let way = p - ring.centre;
        [side * way.dot(&body.left), way.dot(&body.front)]
    });
    hangs(flat.collect())
}

/// The same of an outline whose side is along the first axis.
fn hangs(mut outline: Vec<[f64; 2]>) -> Option<f64> {
    if area(&outline) < 0.0 {
        outline.reverse();
    }
    let points = even(&outline, SAMPLES);
    let n = points.len();
    let from = (0..n).max_by(|a, b| points[*a][0].total_cmp(&points[*b][0]))?;
    let ahead = fold(&|k| points[(from + k) % n], n, 1.0)?;
    let behind = fold(&|k| points[(from + n - k % n) % n], n, -1.0)?;
    let long = ahead.steps + behind.steps;
    if long >= n {
        return None;
    }
    let first = from + n - behind.steps;
    let own: Vec<[f64; 2]> = (0..=long).map(|k| points[(first + k) % n]).collect();
    let own = area(&own).abs();
    small(own, area(&points).abs() - own).then_some(ahead.turned + behind.turned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// The outline of a trunk, of a disk at its side, or of both: the farthest that a ray from the middle meets.
    fn outline(disk: Option<(f64, f64)>, front: f64) -> Vec<[f64; 2]> {
        let reach = |k: usize| {
            let (s, c) = libm::sincos(TAU * k as f64 / 1440.0);
            let own = 1.0 / libm::hypot(c / 170.0, s / if s < 0.0 { front } else { 110.0 });
            let arm = disk.and_then(|(at, radius)| {
                let root = radius * radius - (at * s).powi(2);
                (root > 0.0 && c > 0.0).then(|| at * c + root.sqrt())
            });
            let far = own.max(arm.unwrap_or(0.0));
            [far * c, far * s]
        };
        (0..1440).map(reach).collect()
    }

    #[test]
    fn an_arm_at_the_side_is_a_lobe_and_a_hip_or_a_belly_is_none() {
        for (at, radius) in [(195.0, 40.0), (200.0, 35.0), (190.0, 50.0)] {
            let turned = hangs(outline(Some((at, radius)), 110.0));
            assert!(turned.is_some_and(|turned| turned > PI), "{turned:?}");
        }
        for front in [60.0, 110.0, 180.0] {
            assert_eq!(hangs(outline(None, front)), None);
        }
        let buried = hangs(outline(Some((150.0, 45.0)), 110.0));
        assert!(buried.is_none_or(|turned| turned < PI), "{buried:?}");
    }
}
