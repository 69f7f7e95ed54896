//! Trunk and arms that are one on the surface, parted in a section at the seams that its outline shows.

use super::bridge::{bridge, walked};
use super::seams::{Seam, beyond_fold, opposite, seams, vouched};
use crate::geometry::section::{area, length, tape};
use crate::sections::one::{SectionMeasurement, Spline};
use nalgebra::{Point3, Vector3};
use std::ops::Range;

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

impl Parted {
    /// What it gives as a section about a place, along these axes.
    pub(super) fn section(
        self,
        middle: Point3<f64>,
        (u, v): (&Vector3<f64>, &Vector3<f64>),
    ) -> SectionMeasurement {
        let place = |p: &[f64; 2]| middle + u * p[0] + v * p[1];
        SectionMeasurement {
            contour: self.points.iter().map(place).collect(),
            contour_mm: length(&self.points),
            tape_mm: tape(&self.points),
            spline: Spline::Knots(self.points.iter().step_by(8).copied().collect()),
            bridged: self.share,
            sigma_mm: self.sigma_mm,
        }
    }
}

/// Points that an outline is resampled to (structural: samples).
pub(super) const SAMPLES: usize = 720;
/// Standard deviation of a trunk's tape where one of an arm's two seams is opposite of the other, as a share of the way between
/// them: fitted on chests of six scans and six of their captures, where both seams show (docs/lab/girths.md).
const FILLED: f64 = 0.06;

/// Points evenly spread along a closed outline.
pub(crate) fn even(outline: &[[f64; 2]], count: usize) -> Vec<[f64; 2]> {
    let n = outline.len();
    let step = length(outline) / count as f64;
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

/// Parts arms from a trunk: `own` of outlines of neighbouring sections, from low to high, about the trunk's middle in axes left and forward.
/// Each arm has its side (1 along the first axis, -1 against it) and in which sections it is one with the trunk. `None` where no seam
/// is to be found.
pub fn parted(
    outlines: &[Vec<[f64; 2]>],
    own: usize,
    arms: &[(f64, Range<usize>)],
) -> Option<Parted> {
    if outlines[own].len() < 8 {
        return None;
    }
    let spread = |outline: &Vec<[f64; 2]>| {
        let mut points = even(outline, SAMPLES);
        if area(&points) < 0.0 {
            points.reverse();
        }
        points
    };
    let sections: Vec<Vec<[f64; 2]>> = outlines.iter().map(spread).collect();
    let points = &sections[own];
    let (mut bridged, mut sigma_mm) = (0.0, 0.0);
    let mut cuts = Vec::new();
    for (side, one) in arms {
        let at = |fore: f64| {
            let all = |of: &[Vec<[f64; 2]>]| -> Vec<Vec<Seam>> {
                of.iter().map(|s| seams(s, *side, fore)).collect()
            };
            let mut below = all(&sections[one.start..own]);
            below.reverse();
            let above = all(&sections[own + 1..one.end]);
            vouched(&seams(points, *side, fore), [&below, &above])
                .or_else(|| beyond_fold(points, *side, fore))
        };
        let filled = |other: Option<Seam>, fore: f64| opposite(points, (*side, fore), &other?);
        let (front, back) = (at(1.0), at(-1.0));
        let guessed = front.and(back).map_or(FILLED, |_| 0.0);
        let (front, back) = (
            front.or_else(|| filled(back, 1.0))?,
            back.or_else(|| filled(front, -1.0))?,
        );
        // Counter-clockwise: on the left from the front's... with x to the left hand of a reader,
        // the positive side runs from back to front, the negative from front to back.
        let (from, to) = if *side > 0.0 {
            (back, front)
        } else {
            (front, back)
        };
        let (a, b) = (points[from.at], points[to.at]);
        let (arc, doubt) = bridge(a, from.way, b, to.way);
        let doubt = libm::hypot(doubt, guessed * walked(&[a, b]));
        sigma_mm = libm::hypot(sigma_mm, doubt);
        bridged += walked(&[&[a], &arc[..], &[b]].concat());
        cuts.push((from.at, to.at, arc));
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
    let share = bridged / length(&out);
    (share < 0.5 && out.len() > n / 4).then_some(Parted {
        points: out,
        share,
        sigma_mm,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::rays::{RAYS, ray, reaches};
    use std::f64::consts::TAU;

    /// A superellipse, a trunk of 360 by 240 mm, with disks of radius 55 beside it; the folds
    /// between are filled up to a line from disk to trunk, or open; those behind are `flat`, filled up to the disk's rim.
    fn with_arms(filled: bool, flat: bool) -> (Vec<[f64; 2]>, f64) {
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
        let own = tape(&trunk);
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
            if flat {
                let fold = [
                    [90.0, -60.0],
                    [215.0, -60.0],
                    [215.0, -75.0],
                    [90.0, -110.0],
                ];
                solids.push(fold.map(|p| [side * p[0], p[1]]).to_vec());
            }
            solids.push(disk);
        }
        let reach: Vec<Vec<Option<f64>>> = solids.iter().map(|s| reaches(s, f64::max)).collect();
        let union = (0..RAYS)
            .filter_map(|k| {
                let far = reach.iter().filter_map(|r| r[k]).reduce(f64::max)?;
                let [c, s] = ray(k);
                Some([far * c, far * s])
            })
            .collect();
        (union, own)
    }

    /// One section, none beside it.
    fn alone(outline: &[[f64; 2]], sides: &[f64]) -> Option<Parted> {
        let arms: Vec<(f64, Range<usize>)> = sides.iter().map(|side| (*side, 0..1)).collect();
        parted(&[outline.to_vec()], 0, &arms)
    }

    #[test]
    fn arms_beside_a_trunk_are_taken_off_whether_the_folds_are_filled_or_open() {
        for filled in [false, true] {
            let (union, own) = with_arms(filled, false);
            assert!(tape(&union) > 1.1 * own);
            let free = alone(&union, &[1.0, -1.0]).unwrap();
            proof::near(tape(&free.points) / own, 1.0, 0.012);
            assert!(free.share > 0.1 && free.share < 0.45);
        }
    }

    #[test]
    fn an_arm_behind_which_no_fold_shows_is_taken_off_by_the_one_before_it_too_wide_and_less_sure()
    {
        let (union, own) = with_arms(false, true);
        assert!(beyond_fold(&even(&union, SAMPLES), 1.0, -1.0).is_none());
        let free = alone(&union, &[1.0, -1.0]).unwrap();
        let off = tape(&free.points) / own - 1.0;
        assert!(off > 0.0 && off < 0.06, "{off}");
        assert!(tape(&union) > 1.1 * own);
        let (open, _) = with_arms(false, false);
        let open = alone(&open, &[1.0, -1.0]).unwrap();
        assert!(free.sigma_mm > 1.3 * open.sigma_mm);
    }

    #[test]
    fn a_breast_is_no_arm_wherever_the_trunks_middle_is_between_both() {
        let (union, own) = with_arms(false, false);
        // A furrow between two breasts, 20 mm deep.
        let furrow = |p: &[f64; 2]| match p[1] > 60.0 {
            true => [p[0], p[1] - 20.0 * libm::exp(-(p[0] / 30.0).powi(2))],
            false => *p,
        };
        for off in [-25.0, -15.0, 0.0, 15.0, 25.0] {
            let shifted = union.iter().map(furrow).map(|p| [p[0] + off, p[1]]);
            let free = alone(&shifted.collect::<Vec<_>>(), &[1.0, -1.0]).unwrap();
            proof::near(tape(&free.points) / own, 1.0, 0.015);
        }
    }

    #[test]
    fn one_arm_may_be_taken_off_alone_and_nothing_is_taken_off_a_trunk_without_arms() {
        let (union, own) = with_arms(true, false);
        let one = alone(&union, &[1.0]).unwrap();
        let free = tape(&one.points);
        assert!(free > 1.03 * own && free < tape(&union));
        let bare: Vec<[f64; 2]> = (0..360)
            .map(|k| libm::sincos(TAU * f64::from(k) / 360.0))
            .map(|(s, c)| [180.0 * c, 120.0 * s])
            .collect();
        assert_eq!(alone(&bare, &[1.0, -1.0]), None);
    }
}
