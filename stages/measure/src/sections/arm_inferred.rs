//! Several readings of one arm, of which the trunk hides some, as one: from its own outline, and from the clear sections
//! farther down.

use crate::geometry::section::tape;
use crate::sections::beside_trunk::FreedArm;

/// How sure an arm's size is by the sections farther down alone, as a share of it: the root of the mean square of 19 arms of the first
/// hundred bodies of `models/made/strangers.py`, their planes' own errors in it.
const ONWARD: f64 = 0.038;

impl FreedArm {
    /// The same, as large as so long a tape, whose standard deviation is known. \[mm\]
    fn sized(mut self, tape_mm: f64, sigma_mm: f64) -> FreedArm {
        let n = self.outline.len() as f64;
        let sum = |i: usize| self.outline.iter().map(|p| p[i]).sum::<f64>();
        let mean = [sum(0) / n, sum(1) / n];
        let by = tape_mm / tape(&self.outline);
        for p in &mut self.outline {
            *p = [0, 1].map(|i| mean[i] + by * (p[i] - mean[i]));
        }
        FreedArm { sigma_mm, ..self }
    }

    /// Two readings of one arm, weighted by their variances, to each of which is added what makes them agree (DerSimonian and Laird
    /// 1986, of two).
    pub(crate) fn and(self, other: FreedArm) -> FreedArm {
        let tapes = [tape(&self.outline), tape(&other.outline)];
        let own = [self.sigma_mm, other.sigma_mm].map(|mm| mm * mm);
        let apart = (tapes[0] - tapes[1]).powi(2);
        let more = ((apart - own[0] - own[1]) / 2.0).max(0.0);
        let weights = own.map(|square| 1.0 / (square + more).max(1e-9));
        let sum = weights[0] + weights[1];
        let mean = (weights[0] * tapes[0] + weights[1] * tapes[1]) / sum;
        self.sized(mean, sum.sqrt().recip())
    }

    /// One of two readings, of which this one is right by a chance: mean and deviation of the mixture.
    pub(crate) fn or(self, chance: f64, other: FreedArm) -> FreedArm {
        let tapes = [tape(&self.outline), tape(&other.outline)];
        let rest = 1.0 - chance;
        let mean = chance * tapes[0] + rest * tapes[1];
        let square = chance * self.sigma_mm.powi(2)
            + rest * other.sigma_mm.powi(2)
            + chance * rest * (tapes[0] - tapes[1]).powi(2);
        let share = chance * self.share + rest * other.share;
        let likelier = if chance < 0.5 { other } else { self };
        FreedArm {
            share,
            ..likelier.sized(mean, square.sqrt())
        }
    }
}

/// Slope of the least-squares line through (x, y).
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let (up, down) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx).powi(2))
    });
    up / down
}

/// The section inferred from clear ones farther down alone: `clear`, taken so many steps down, grown as their
/// tapes, (steps down, mm), grow up the arm. Above the first of them that may go on, or end.
pub(crate) fn onward(tapes: &[(f64, f64)], steps: f64, clear: &[[f64; 2]]) -> Option<FreedArm> {
    if tapes.len() < 5 {
        return None;
    }
    let slope = slope(tapes);
    let n = tapes.len() as f64;
    let mean = tapes
        .iter()
        .fold((0.0, 0.0), |m, t| (m.0 + t.0 / n, m.1 + t.1 / n));
    let at = |k: f64| mean.1 + slope * (k - mean.0);
    let (goes_on, ends) = (at(0.0), at(tapes[0].0));
    let here = (goes_on + ends) / 2.0;
    let own = FreedArm {
        outline: clear.to_vec(),
        share: 1.0,
        sigma_mm: 0.0,
    };
    // Anything between is as likely.
    let sigma_mm = libm::hypot((goes_on - ends) / 12f64.sqrt(), ONWARD * here);
    Some(own.sized(tape(clear) * here / at(steps), sigma_mm))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn disk(radius: f64) -> Vec<[f64; 2]> {
        (0..180)
            .map(|k| libm::sincos(TAU * f64::from(k) / 180.0))
            .map(|(s, c)| [radius * c, radius * s])
            .collect()
    }

    fn reading(tape_mm: f64, sigma_mm: f64) -> FreedArm {
        let own = FreedArm {
            outline: disk(50.0),
            share: 0.5,
            sigma_mm,
        };
        own.sized(tape_mm, sigma_mm)
    }

    #[test]
    fn a_section_inferred_from_below_grows_half_as_far_as_those_do_and_may_end_or_go_on() {
        // Clear from 3 steps down on; each step up adds 3 mm to 300.
        let tapes: Vec<(f64, f64)> = (3..15)
            .map(|k| (f64::from(k), 330.0 - 3.0 * f64::from(k)))
            .collect();
        let clear = disk(300.0 / TAU);
        let inferred = onward(&tapes, 10.0, &clear).unwrap();
        proof::near(tape(&inferred.outline), 325.5, 0.2);
        let growth = 9.0 / 12f64.sqrt();
        proof::near(inferred.sigma_mm, libm::hypot(growth, ONWARD * 325.5), 0.1);
        assert!(onward(&tapes[..4], 10.0, &clear).is_none());
    }

    #[test]
    fn readings_that_agree_are_surer_together_and_those_that_do_not_are_as_unsure_as_they_differ() {
        let agreeing = reading(300.0, 4.0).and(reading(302.0, 4.0));
        proof::near(tape(&agreeing.outline), 301.0, 1e-6);
        proof::near(agreeing.sigma_mm, 8f64.sqrt(), 1e-6);
        let apart = reading(300.0, 2.0).and(reading(350.0, 2.0));
        proof::near(tape(&apart.outline), 325.0, 1e-6);
        proof::near(apart.sigma_mm, 25.0, 1e-6);
        // Nowhere does it jump.
        let at = |mm: f64| reading(300.0, 3.0).and(reading(mm, 6.0));
        for mm in (250..350).map(f64::from) {
            let (a, b) = (at(mm), at(mm + 1.0));
            assert!((tape(&a.outline) - tape(&b.outline)).abs() < 1.0);
            assert!((a.sigma_mm - b.sigma_mm).abs() < 1.0);
        }
    }

    #[test]
    fn one_of_two_readings_covers_both() {
        let both = reading(300.0, 2.0).or(0.5, reading(320.0, 6.0));
        proof::near(tape(&both.outline), 310.0, 1e-6);
        proof::near(both.sigma_mm, 120f64.sqrt(), 1e-6);
        let sure = reading(300.0, 2.0).or(1.0, reading(320.0, 6.0));
        assert_eq!(sure, reading(300.0, 2.0));
    }
}
