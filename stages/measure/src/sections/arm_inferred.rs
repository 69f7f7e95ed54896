//! An arm's section where the trunk hides some of it: compared with, or inferred from, the
//! clear sections farther down.

use crate::features::marks::slope;
use crate::geometry::section::tape;
use crate::sections::beside_trunk::FreedArm;

/// An arm's section as inferred from farther ones.
pub(crate) struct InferredSection {
    pub(crate) outline: Vec<[f64; 2]>,
    /// Share of the way around that was.
    pub(crate) share: f64,
    /// Standard deviation of the tape, as a share of it.
    pub(crate) doubt: f64,
}

impl InferredSection {
    /// The same with its doubt as a length.
    pub(crate) fn freed(self) -> FreedArm {
        FreedArm {
            share: self.share,
            sigma_mm: self.doubt * tape(&self.outline),
            outline: self.outline,
        }
    }
}

/// How sure a section is that was inferred from those farther down alone: what of their growth may end, and
/// what there is beside that; shares of the growth and of the tape.
const ONWARD: (f64, f64) = (0.35, 0.015);

/// From where on, and to where, a section that is wider or narrower than those farther down let expect is
/// drawn half the way to them: folds of the armpit may be part of it, or flesh that went with the trunk
/// be missing. Shares of its tape.
const EXPECTED: (f64, f64) = (0.06, 0.12);

/// A section compared with the one that those farther down alone give.
pub(crate) fn bounded(
    mut inferred: InferredSection,
    other: Option<InferredSection>,
) -> InferredSection {
    let Some(other) = other else { return inferred };
    let tape_mm = tape(&inferred.outline);
    let wider = 1.0 - tape(&other.outline) / tape_mm;
    let share = ((wider.abs() - EXPECTED.0) / (EXPECTED.1 - EXPECTED.0)).clamp(0.0, 1.0);
    if share > 0.0 {
        let n = inferred.outline.len() as f64;
        let mean = inferred
            .outline
            .iter()
            .fold([0.0, 0.0], |m, p| [m[0] + p[0] / n, m[1] + p[1] / n]);
        let by = 1.0 - share * wider / 2.0;
        for p in &mut inferred.outline {
            *p = [0, 1].map(|i| mean[i] + by * (p[i] - mean[i]));
        }
        inferred.doubt = libm::hypot(inferred.doubt, share * wider / 2.0);
    }
    inferred
}

/// The section inferred from clear ones farther down alone: `clear`, taken so many steps down, grown as their
/// tapes, (steps down, mm), grow up the arm.
pub(crate) fn onward(
    tapes: &[(f64, f64)],
    steps: f64,
    clear: &[[f64; 2]],
) -> Option<InferredSection> {
    if tapes.len() < 5 {
        return None;
    }
    let slope = slope(tapes);
    let n = tapes.len() as f64;
    let mean = tapes
        .iter()
        .fold((0.0, 0.0), |m, t| (m.0 + t.0 / n, m.1 + t.1 / n));
    let at = |k: f64| mean.1 + slope * (k - mean.0);
    let (here, first) = (at(0.0), at(tapes[0].0));
    let grown = here / at(steps);
    if !(1.0..=1.3).contains(&grown) {
        return None;
    }
    let outline = clear.iter().map(|p| p.map(|x| x * grown)).collect();
    Some(InferredSection {
        outline,
        share: 1.0,
        doubt: libm::hypot(ONWARD.0 * (here - first) / here, ONWARD.1),
    })
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

    #[test]
    fn a_section_inferred_from_below_grows_as_those_do_with_its_doubt() {
        // Clear from 3 steps down on; each step up adds 3 mm to 300.
        let tapes: Vec<(f64, f64)> = (3..15)
            .map(|k| (f64::from(k), 330.0 - 3.0 * f64::from(k)))
            .collect();
        let clear = disk(300.0 / TAU);
        let inferred = onward(&tapes, 10.0, &clear).unwrap();
        proof::near(tape(&inferred.outline), 330.0, 0.2);
        assert!(
            inferred.doubt > 0.015 && inferred.doubt < 0.03,
            "{}",
            inferred.doubt
        );
        assert!(onward(&tapes[..4], 10.0, &clear).is_none());
    }

    #[test]
    fn a_section_far_from_what_those_below_tell_is_drawn_half_the_way_to_it() {
        let inferred = |radius: f64| InferredSection {
            outline: disk(radius),
            share: 0.3,
            doubt: 0.01,
        };
        let near = bounded(inferred(52.0), Some(inferred(50.0)));
        proof::near(tape(&near.outline), tape(&disk(52.0)), 1e-6);
        for far in [62.0, 40.0] {
            let bounded = bounded(inferred(far), Some(inferred(50.0)));
            proof::near(tape(&bounded.outline), TAU * (far + 50.0) / 2.0, 0.5);
            assert!(bounded.doubt > 0.09);
        }
    }
}
