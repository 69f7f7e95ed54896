//! Trunk and arms that are one on the surface, parted in a section: where the trunk's outline stops
//! turning round toward its side, an arm or the filled fold before it begins.

use super::bridge::{bridge, walked};
use super::fold::{STRAIGHT, fold};
use std::f64::consts::TAU;

/// A trunk freed of the arms in its section.
#[derive(Debug, Clone, PartialEq)]
pub struct Parted {
    /// The trunk's own outline, bridged where arms were. \[mm\]
    pub points: Vec<[f64; 2]>,
    /// Share of that outline that is bridge.
    pub share: f64,
    /// Standard deviation of its tape by what is hidden. \[mm\]
    pub sigma_mm: f64,
}

/// Points that an outline is resampled to (structural: samples).
pub(super) const SAMPLES: usize = 720;
/// Samples to either side of one that tell the way of the outline there (structural: samples).
const REACH: usize = 5;
/// The trunk has turned at least so far before an arm begins. \[rad\]
const TURNED: f64 = 25.0 * TAU / 360.0;

/// Points evenly spread along a closed outline.
pub(crate) fn even(outline: &[[f64; 2]], count: usize) -> Vec<[f64; 2]> {
    let n = outline.len();
    let step = crate::geometry::section::length(outline) / count as f64;
    let (mut out, mut left) = (Vec::with_capacity(count), 0.0);
    for i in 0..n {
        let (a, b) = (outline[i], outline[(i + 1) % n]);
        let long = libm::hypot(b[0] - a[0], b[1] - a[1]);
        while left < long && out.len() < count {
            let t = left / long;
            out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
            left += step;
        }
        left -= long;
    }
    out
}

/// Where on an outline an arm begins: an index, and the outline's way there.
struct Seam {
    at: usize,
    way: [f64; 2],
}

/// Follows the outline from its middle at the front (`fore` 1) or the back (-1) to the outermost of
/// a side, and finds where it first stops turning for long, or turns back.
fn seam(points: &[[f64; 2]], middle: [f64; 2], side: f64, fore: f64) -> Option<Seam> {
    let n = points.len();
    // Seen so that the path runs from the top to the right.
    let seen = |i: usize| {
        let p = points[i % n];
        [side * (p[0] - middle[0]), fore * (p[1] - middle[1])]
    };
    let start = (0..n)
        .filter(|i| {
            seen(*i)[0].abs() < 0.03 * crate::geometry::section::length(points) && seen(*i)[1] > 0.0
        })
        .min_by(|a, b| seen(*a)[0].abs().total_cmp(&seen(*b)[0].abs()))?;
    let end = (0..n).max_by(|a, b| seen(*a)[0].total_cmp(&seen(*b)[0]))?;
    // A counter-clockwise outline runs to the left at the front.
    let forward = side * fore > 0.0;
    let along = |k: usize| match forward {
        false => (start + k) % n,
        true => (start + n - k % n) % n,
    };
    let long = match forward {
        false => (end + n - start) % n,
        true => (start + n - end) % n,
    };
    if long < 4 * REACH || long > n / 2 {
        return None;
    }
    let way = |k: usize| {
        let (a, b) = (seen(along(k + n - REACH)), seen(along(k + REACH)));
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = libm::hypot(x, y).max(1e-9);
        [x / length, y / length]
    };
    let mut turned: Vec<f64> = Vec::with_capacity(long);
    for k in 0..long {
        let [x, y] = way(k);
        let raw = libm::atan2(-y, x);
        let last = turned.last().copied().unwrap_or(raw);
        turned.push(raw + ((last - raw) / TAU).round() * TAU);
    }
    let step = crate::geometry::section::length(points) / n as f64;
    let deep = (0..n).map(|i| seen(i)[1]).fold(0.0, f64::max);
    let mut best: Option<(f64, usize)> = None;
    for a in 0..long {
        if turned[a] < TURNED {
            continue;
        }
        for b in a + 1..long {
            if turned[b] <= turned[a] + STRAIGHT {
                let score = (b - a) as f64 * step + deep * (turned[a] - turned[b]);
                if best.is_none_or(|o| score > o.0) {
                    best = Some((score, a));
                }
            }
        }
    }
    let (score, k) = best?;
    let [x, y] = way(k);
    (score > 0.25 * deep).then_some(Seam {
        at: along(k),
        way: [side * x, fore * y],
    })
}

/// The same of a flat chest or back, which turns too little before the arm: where the outline turns back beyond the arm.
fn beyond_fold(points: &[[f64; 2]], side: f64, fore: f64) -> Option<Seam> {
    let n = points.len();
    let out = |i: &usize| side * points[*i][0];
    let from = (0..n).max_by(|a, b| out(a).total_cmp(&out(b)))?;
    // A counter-clockwise outline runs forward on the left.
    let forward = side * fore > 0.0;
    let along = |k: usize| match forward {
        true => (from + k) % n,
        false => (from + n - k % n) % n,
    };
    let turn = if forward { 1.0 } else { -1.0 };
    let start = fold(&|k| points[along(k)], n, turn)?.beyond;
    let (a, b) = (points[along(start + 2 * REACH)], points[along(start)]);
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypot(x, y).max(1e-9);
    let own = Seam {
        at: along(start),
        way: [x / length, y / length],
    };
    // Beyond the middle it is the other arm's.
    (side * b[0] > 0.0).then_some(own)
}

/// Parts the arms of the given sides (1 along the first axis, -1 against it) from a trunk. `outline`
/// is in axes left and forward; `middle` is within the trunk. `None` where no seam is to be found.
pub fn parted(outline: &[[f64; 2]], middle: [f64; 2], sides: &[f64]) -> Option<Parted> {
    if outline.len() < 8 {
        return None;
    }
    let mut points = even(outline, SAMPLES);
    if crate::geometry::section::area(&points) < 0.0 {
        points.reverse();
    }
    let (mut share, mut sigma_mm) = (0.0, 0.0);
    let mut cuts = Vec::new();
    for side in sides {
        let at = |fore: f64| {
            seam(&points, middle, *side, fore).or_else(|| beyond_fold(&points, *side, fore))
        };
        let (front, back) = (at(1.0)?, at(-1.0)?);
        // Counter-clockwise: on the left from the front's... with x to the left hand of a reader,
        // the positive side runs from back to front, the negative from front to back.
        let (from, to) = if *side > 0.0 {
            (back, front)
        } else {
            (front, back)
        };
        let (arc, doubt) = bridge(points[from.at], from.way, points[to.at], to.way);
        cuts.push((from.at, to.at, arc));
        sigma_mm = libm::hypot(sigma_mm, doubt);
    }
    let n = points.len();
    let inside = |i: usize| {
        cuts.iter()
            .any(|(from, to, _)| i != *from && (i + n - from) % n < (to + n - from) % n)
    };
    let mut out: Vec<[f64; 2]> = Vec::with_capacity(n);
    for i in 0..n {
        if inside(i) {
            continue;
        }
        out.push(points[i]);
        for (_, _, arc) in cuts.iter().filter(|c| c.0 == i) {
            out.extend(arc);
        }
    }
    let whole = crate::geometry::section::length(&out);
    for (from, to, arc) in &cuts {
        let mut path = vec![points[*from]];
        path.extend(arc);
        path.push(points[*to]);
        share += walked(&path) / whole;
    }
    (share < 0.5 && out.len() > n / 4).then_some(Parted {
        points: out,
        share,
        sigma_mm,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A superellipse, a trunk of 360 by 240 mm, with disks of radius 55 beside it; the folds
    /// between are filled up to a line from disk to trunk, or open.
    fn with_arms(filled: bool) -> (Vec<[f64; 2]>, f64) {
        let trunk: Vec<[f64; 2]> = (0..720)
            .map(|k| libm::sincos(TAU * f64::from(k) / 720.0))
            .map(|(s, c)| {
                let r = libm::pow(
                    libm::pow((c / 180.0).abs(), 2.5) + libm::pow((s / 120.0).abs(), 2.5),
                    -0.4,
                );
                [r * c, r * s]
            })
            .collect();
        let own = crate::geometry::section::tape(&trunk);
        // A ray's farthest crossing of trunk, disks and, if filled, quadrangles between them.
        let mut solids = vec![trunk];
        for side in [1.0, -1.0] {
            let disk: Vec<[f64; 2]> = (0..360)
                .map(|k| libm::sincos(TAU * f64::from(k) / 360.0))
                .map(|(s, c)| [side * 215.0 + 55.0 * c, -20.0 + 55.0 * s])
                .collect();
            if filled {
                let fold = [[150.0, 78.0], [205.0, 34.0], [205.0, -74.0], [150.0, -78.0]];
                solids.push(fold.map(|p| [side * p[0], p[1]]).to_vec());
            }
            solids.push(disk);
        }
        let reach: Vec<Vec<Option<f64>>> = solids.iter().map(|s| crate::reaches(s)).collect();
        let union = (0..crate::RAYS)
            .filter_map(|k| {
                let far = reach.iter().filter_map(|r| r[k]).reduce(f64::max)?;
                let [c, s] = crate::ray(k);
                Some([far * c, far * s])
            })
            .collect();
        (union, own)
    }

    #[test]
    fn arms_beside_a_trunk_are_taken_off_whether_the_folds_are_filled_or_open() {
        for filled in [false, true] {
            let (union, own) = with_arms(filled);
            assert!(crate::geometry::section::tape(&union) > 1.1 * own);
            let free = parted(&union, [0.0, 0.0], &[1.0, -1.0]).unwrap();
            proof::near(
                crate::geometry::section::tape(&free.points) / own,
                1.0,
                0.012,
            );
            assert!(free.share > 0.1 && free.share < 0.45);
        }
    }

    #[test]
    fn one_arm_may_be_taken_off_alone_and_nothing_is_taken_off_a_trunk_without_arms() {
        let (union, own) = with_arms(true);
        let one = parted(&union, [0.0, 0.0], &[1.0]).unwrap();
        let tape = crate::geometry::section::tape(&one.points);
        assert!(tape > 1.03 * own && tape < crate::geometry::section::tape(&union));
        let bare: Vec<[f64; 2]> = (0..360)
            .map(|k| libm::sincos(TAU * f64::from(k) / 360.0))
            .map(|(s, c)| [180.0 * c, 120.0 * s])
            .collect();
        assert_eq!(parted(&bare, [0.0, 0.0], &[1.0, -1.0]), None);
    }
}
