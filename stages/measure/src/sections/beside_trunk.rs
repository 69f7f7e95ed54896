//! An arm and the trunk as one outline, parted at the two folds: the arm's skin turns the same way all around, up to
//! where it turns back into the trunk's.

use crate::features::limb::cuts::holds_origin;
use crate::geometry::rays::{ray, reaches};
use crate::geometry::section::{length, tape};
use crate::sections::bridge::{BRIDGED_SIGMA, bridge, walked};
use crate::sections::fold::fold;
use crate::sections::split::even;
use std::f64::consts::TAU;

/// An arm freed of the trunk.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FreedArm {
    /// Its own outline, bridged between the folds. \[mm\]
    pub(crate) outline: Vec<[f64; 2]>,
    /// Share of the way around that is bridged, or estimated by another section.
    pub(crate) share: f64,
    /// Standard deviation of its tape by what is hidden. \[mm\]
    pub(crate) sigma_mm: f64,
}

/// Samples on the way around an arm of the given radius (structural: samples).
const SAMPLES: f64 = 180.0;
/// Frees an arm of the trunk. The outline is about the arm's middle, `outward` points away from the trunk; `clear` is a section
/// of the arm alone, about its own middle. `None` where the outline does not go around the middle, or has no two folds.
pub(crate) fn freed_of_trunk(
    outline: &[[f64; 2]],
    outward: [f64; 2],
    clear: &[[f64; 2]],
) -> Option<FreedArm> {
    let radius = length(clear) / TAU;
    if !holds_origin(outline) {
        return None;
    }
    // The trunk is far behind the folds.
    let far = 3.0 * radius;
    let reach = reaches(outline, f64::min).into_iter().enumerate();
    let star: Vec<[f64; 2]> = reach
        .filter_map(|(k, r)| Some((ray(k), r?.min(far))))
        .map(|(way, r)| way.map(|x| x * r))
        .collect();
    let count = (SAMPLES * length(&star) / (TAU * radius)).round() as usize;
    let points = even(&star, count);
    let n = points.len();
    let out = |p: &[f64; 2]| p[0] * outward[0] + p[1] * outward[1];
    let from = (0..n).max_by(|a, b| out(&points[*a]).total_cmp(&out(&points[*b])))?;
    let ahead = fold(&|k| points[(from + k) % n], n, 1.0)?;
    let behind = fold(&|k| points[(from + n - k % n) % n], n, -1.0)?;
    if ahead.steps + behind.steps >= n {
        return None;
    }
    let first = from + n - behind.steps;
    let mut own: Vec<[f64; 2]> = (0..=ahead.steps + behind.steps)
        .map(|k| points[(first + k) % n])
        .collect();
    let (a, b) = (*own.last()?, own[0]);
    let (arc, _) = bridge(a, ahead.way, b, behind.way);
    // Where the arm's sides do not draw near each other, more of it is hidden than shows.
    if arc.is_empty() {
        return None;
    }
    let chord_mm = tape(&own);
    let mut path = vec![a];
    path.extend(&arc);
    path.push(b);
    own.extend(arc);
    Some(FreedArm {
        share: walked(&path) / length(&own),
        sigma_mm: BRIDGED_SIGMA * (tape(&own) - chord_mm),
        outline: own,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An oval of half-axes a and b, turned, by a superellipse's exponent.
    fn oval([a, b, power, turned]: [f64; 4]) -> Vec<[f64; 2]> {
        let at = |k: i32| {
            let t = TAU * f64::from(k) / 720.0;
            let (s, c) = libm::sincos(t - turned);
            let sum = libm::pow((c / a).abs(), power) + libm::pow((s / b).abs(), power);
            let (s, c) = libm::sincos(t);
            [c, s].map(|x| x * libm::pow(sum, -1.0 / power))
        };
        (0..720).map(at).collect()
    }

    /// One outline with a trunk that is beyond x = `skin`: what is the trunk's is far away.
    fn beside(arm: &[[f64; 2]], skin: f64) -> Vec<[f64; 2]> {
        let far = |p: &[f64; 2]| if p[0] > skin { p.map(|x| 9.0 * x) } else { *p };
        arm.iter().map(far).collect()
    }

    /// What is bridged of ovals that a trunk hides up to two fifths of a half-axis of: errors, each with its deviation, as shares of the tape.
    fn bridged() -> Vec<(f64, f64)> {
        let mut all = Vec::new();
        for aspect in [0.75, 0.87, 1.0, 1.15, 1.33] {
            for power in [2.0, 2.3, 2.6] {
                for turned in [0.0, 0.5, 1.0, 1.5] {
                    for hidden in [0.05, 0.1, 0.2, 0.3, 0.4] {
                        let arm = oval([50.0, 50.0 * aspect, power, turned]);
                        let most = arm.iter().map(|p| p[0]).fold(0.0, f64::max);
                        let outline = beside(&arm, (1.0 - hidden) * most);
                        let free = freed_of_trunk(&outline, [-1.0, 0.0], &arm);
                        let own = tape(&arm);
                        all.extend(free.map(|f| (tape(&f.outline) / own - 1.0, f.sigma_mm / own)));
                    }
                }
            }
        }
        all
    }

    #[test]
    fn ovals_beside_a_trunk_are_bridged_as_surely_as_is_given() {
        let all = bridged();
        assert!(all.len() > 250, "{} of 300", all.len());
        let worst = all.iter().map(|(off, _)| off.abs()).fold(0.0, f64::max);
        assert!(worst < 0.035, "{worst}");
        let square = all.iter().map(|(off, sigma)| (off / sigma).powi(2));
        let scatter = (square.sum::<f64>() / all.len() as f64).sqrt();
        assert!((0.5..1.0).contains(&scatter), "{scatter}");
    }

    #[test]
    fn an_arm_alone_has_no_folds_and_one_that_is_mostly_hidden_is_not_bridged() {
        let arm = oval([50.0, 45.0, 2.0, 0.3]);
        assert_eq!(freed_of_trunk(&arm, [-1.0, 0.0], &arm), None);
        assert_eq!(
            freed_of_trunk(&beside(&arm, -15.0), [-1.0, 0.0], &arm),
            None
        );
    }
}
