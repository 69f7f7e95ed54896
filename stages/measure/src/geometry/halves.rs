//! Two legs that are one ring, parted by the line between the folds before and behind them.

use crate::geometry::section::{axes, flat, hull, length, tape};
use crate::geometry::slices::{Ring, level};
use nalgebra::{Point3, Vector3};
use shape::Plane;

/// One of two legs that touch.
#[derive(Debug, Clone)]
pub(crate) struct Half {
    /// Its outline in the plane's axes. \[mm\]
    pub(crate) points: Vec<[f64; 2]>,
    /// Length of a tape around it. \[mm\]
    pub(crate) tape: f64,
    /// Share of it that is cut.
    pub(crate) share: f64,
    /// Standard deviation of its tape by what the folds hide. \[mm\]
    pub(crate) sigma_mm: f64,
}

/// Legs that press each other share at most so much of a leg's tape: a wider cut goes through the trunk. By hand:
/// looked at thirteen bodies of which thighs touch on none, at half and double of it: no tape changes.
const WIDEST_CUT: f64 = 0.25;
/// A fold is within this share of both legs' breadth from their middle (structural: the middle third).
const MIDDLE: f64 = 1.0 / 6.0;
/// Doubt of a half ring's tape, as a share of what is cut: legs press each other out of shape. By hand: looked
/// at thirteen bodies of which thighs touch on none, at half and double of it: no interval changes.
const PRESSED_SIGMA: f64 = 0.06;

/// The skin of a thigh's inner half is longer than a tape around that half by at most so much of the whole tape: more
/// is a web between the thighs, which no photo looks into, and hangs on one of them. By hand: looked at three scans, at
/// 0.7 and 1.4 of it: no tape changes.
const WEB_SHARE: f64 = 0.02;
/// How much longer the skin of a thigh's inner half is than a tape around it, as a share of what is a web; 1 and more is one.
pub(crate) fn webbed(ring: &Ring, side: &Vector3<f64>) -> f64 {
    let inner = |p: &&Point3<f64>| (*p - ring.centre).dot(side) < 0.0;
    let inner: Vec<Point3<f64>> = ring.curve.iter().filter(inner).copied().collect();
    let half = flat(&inner, &level(ring.centre.z));
    (length(&half) - tape(&half)) / (WEB_SHARE * ring.tape)
}

/// The half of a ring on a side. Folds of photos are filled, so where the skin leaves the outline for the line between both
/// legs is open: at the earliest it goes straight to the line's middle, at the latest it follows the outline into the fold. The tape is
/// midway, its corners cut at half of both ways, and equally likely anywhere between.
pub(crate) fn half(curve: &[Point3<f64>], plane: &Plane, side: &Vector3<f64>) -> Option<Half> {
    let (u, v) = axes(plane);
    let way = [side.dot(&u), side.dot(&v)];
    let long = libm::hypot(way[0], way[1]);
    let outline = flat(curve, plane);
    let out = |p: &[f64; 2]| (way[0] * p[0] + way[1] * p[1]) / long;
    let fore = |p: &[f64; 2]| (way[0] * p[1] - way[1] * p[0]) / long;
    let middle = |of: &dyn Fn(&[f64; 2]) -> f64| {
        let (low, high) = ends(&outline, of)?;
        Some(((low + high) / 2.0, high - low))
    };
    let ((across, wide), (along, _)) = (middle(&out)?, middle(&fore)?);
    let near = |p: &&[f64; 2]| (out(p) - across).abs() < MIDDLE * wide;
    let fold = |turn: f64| {
        let deep = |p: &&[f64; 2]| turn * (fore(p) - along);
        let beside = outline.iter().filter(near).filter(|p| deep(p) > 0.0);
        beside.min_by(|a, b| deep(a).total_cmp(&deep(b))).copied()
    };
    let (a, b) = (fold(1.0)?, fold(-1.0)?);
    // Which side of the line from fold to fold the leg is on.
    let beyond = |p: &[f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let farthest = outline.iter().max_by(|p, q| out(p).total_cmp(&out(q)))?;
    let own = |p: &&[f64; 2]| beyond(p) * beyond(farthest) > 0.0;
    let own: Vec<[f64; 2]> = outline.iter().filter(own).copied().chain([a, b]).collect();
    rounded(&hull(&own), (a, b))
}

/// Least and greatest of something along an outline.
fn ends(outline: &[[f64; 2]], of: &dyn Fn(&[f64; 2]) -> f64) -> Option<(f64, f64)> {
    let all = || outline.iter().map(of);
    Some((all().reduce(f64::min)?, all().reduce(f64::max)?))
}

/// A convex outline with a straight side, its corners there cut at half of both ways.
fn rounded(outline: &[[f64; 2]], (a, b): ([f64; 2], [f64; 2])) -> Option<Half> {
    let n = outline.len();
    let at = |i: usize| outline[i % n];
    let first = (0..n).find(|i| {
        let (p, q) = (at(*i), at(i + 1));
        (p, q) == (a, b) || (p, q) == (b, a)
    })?;
    if n < 8 {
        return None;
    }
    let mid = |p: [f64; 2], q: [f64; 2]| [(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0];
    let far = |p: [f64; 2], q: [f64; 2]| libm::hypot(q[0] - p[0], q[1] - p[1]);
    let middle = mid(a, b);
    let corner = |from: [f64; 2], p: [f64; 2]| far(from, p) + far(p, middle) - far(from, middle);
    let (before, p, q, after) = (at(first + n - 1), at(first), at(first + 1), at(first + 2));
    let open = corner(before, p) + corner(after, q);
    let cut = far(a, b);
    let mut points = vec![
        mid(before, p),
        mid(p, middle),
        mid(middle, q),
        mid(q, after),
    ];
    points.extend((first + 2..first + n).map(at));
    let tape = tape(&points);
    (cut <= WIDEST_CUT * tape).then(|| Half {
        tape,
        share: cut / tape,
        // Equally likely anywhere: a twelfth of the square.
        sigma_mm: libm::hypot(open / 12f64.sqrt(), PRESSED_SIGMA * cut),
        points,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const LEVEL: Plane = Plane {
        point_mm: [0.0; 3],
        normal: [0.0, 0.0, -1.0],
    };

    #[test]
    fn the_half_of_a_trunk_is_no_leg() {
        let at = |k: i32| {
            let (s, c) = libm::sincos(TAU * f64::from(k) / 720.0);
            Point3::new(190.0 * c, 125.0 * s, 0.0)
        };
        let curve: Vec<Point3<f64>> = (0..720).map(at).collect();
        assert!(half(&curve, &LEVEL, &Vector3::x()).is_none());
    }

    /// Disks of radius 80 about x = ±76, pressed together at x = 0; the folds are filled as far out as `filled`.
    fn pressed(filled: f64) -> Vec<Point3<f64>> {
        let right: Vec<Point3<f64>> = (0..720)
            .map(|k| TAU * (f64::from(k) / 720.0 - 0.5))
            .map(libm::sincos)
            .map(|(s, c)| (76.0 + 80.0 * c, 80.0 * s))
            .filter(|(x, y)| *x >= 0.0 && (*x > 40.0 || y.abs() >= filled))
            .map(|(x, y)| Point3::new(x, y, 0.0))
            .collect();
        let fold = [-1.0, 1.0].map(|turn| Point3::new(0.0, turn * filled, 0.0));
        let fold = |k: usize| (filled > 0.0).then_some(fold[k]);
        let left = right.iter().rev().map(|p| Point3::new(-p.x, p.y, 0.0));
        let both = right.iter().copied().chain(fold(1)).chain(left);
        both.chain(fold(0)).collect()
    }

    #[test]
    fn the_half_of_two_pressed_legs_is_one_leg_with_a_flat_side_and_as_unsure_as_its_folds_are_filled()
     {
        let [open, filled] = [0.0, 50.0].map(|f| half(&pressed(f), &LEVEL, &Vector3::x()).unwrap());
        for one in [&open, &filled] {
            proof::near(one.tape / (TAU * 80.0), 1.0, 0.01);
            assert!(
                one.points
                    .iter()
                    .all(|p| p[0].abs() < 157.0 && p[0].abs() > -1e-9)
            );
        }
        assert!(open.share > 0.02 && open.share < 0.2, "{}", open.share);
        assert!(filled.sigma_mm > 2.0 * open.sigma_mm);
    }
}
