//! Where stature and buttocks put the crotch, and what that means for a thigh whose upper end is closed on the surface.

/// Height of the crotch as a share of stature: a constant and a share of the buttocks' height. Fitted on the 6 068 people of
/// `models/tables/ansur2.csv` (a test below).
const CROTCH: [f64; 2] = [0.1713, 0.6104];
/// Its standard deviation; fitted with it.
pub(crate) const SIGMA: f64 = 0.0104;

/// How far below the expected crotch legs part where nothing is between them, as a share of stature: mean and standard deviation. Fitted on
/// the first 160 bodies of `models/tables/thighs.csv`; 0.0190 and 0.0114 of the 80 that are left out (a test below has what that bounds).
const WEBLESS: [f64; 2] = [0.0185, 0.0129];
/// How much longer a thigh's tape is a stature farther up, as a share of it: mean and standard deviation; fitted there, 2.04
/// and 1.34 of those left out.
const GROWTH: [f64; 2] = [2.085, 1.424];
/// Logarithm of a thigh's tape over the hip's: mean and standard deviation. Fitted there; −0.555 and 0.063 of those left out.
/// ANSUR II's people differ half as much, and 95 in 100 are below the same.
const OF_HIP: [f64; 2] = [-0.5506, 0.0639];
/// Whether anything is between thighs below the crotch is even odds before one sees how low they part (structural).
const EVEN: f64 = 0.5;
/// Steps of the way that may be hidden (structural: more change no mm).
const STEPS: usize = 40;

/// Most that two tapes around a thigh may differ by: the allowable observer error of ANSUR II (Measurer's Handbook,
/// NATICK/TR-11/017, appendix G).
const ALLOWED_MM: f64 = 6.0;

/// How high the crotch of a body is whose buttocks are so high; shares of stature.
pub(crate) fn crotch(buttock: f64) -> f64 {
    CROTCH[0] + CROTCH[1] * buttock
}

/// How likely the crotch of a body whose buttocks are so high is no lower than a height; shares of stature.
pub(crate) fn no_lower(buttock: f64, height: f64) -> f64 {
    above(crotch(buttock) - height)
}

/// How likely a crotch so far below its middle is above that.
fn above(gap: f64) -> f64 {
    normal_above(-gap / SIGMA)
}

/// How likely something normally distributed is so many deviations above its mean at least.
fn normal_above(z: f64) -> f64 {
    0.5 * libm::erfc(z / std::f64::consts::SQRT_2)
}

/// How likely it is there, but for a factor.
fn normal(z: f64) -> f64 {
    libm::exp(-0.5 * z * z)
}

/// What may be hidden of a thigh between where legs join on a surface and the crotch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hidden {
    /// How far the expected crotch is above where the legs join, as a share of stature.
    pub(crate) above: f64,
    /// By which share of the tape that shows the thigh is longer, on the mean.
    mean: f64,
    /// And at most, nineteen times in twenty.
    pub(crate) most: f64,
}

impl Hidden {
    /// Of a body with such a crotch whose legs join so high, shares of stature, and a thigh whose tape there is such a share of the hip's. Its legs part
    /// there, or something between them hides a way, anywhere as likely, down to where both thighs would be one. Over such a way a thigh grows as thighs
    /// do, and to what they are of a hip.
    pub(crate) fn of(crotch: f64, join: f64, one: f64, of_hip: f64) -> Hidden {
        let above = crotch - join;
        let parts = |way: f64| normal((above - way - WEBLESS[0]) / WEBLESS[1]);
        let step = (crotch - one).max(0.0) / STEPS as f64;
        let by_hip = OF_HIP[0] - libm::log(of_hip);
        let ways: Vec<[f64; 3]> = (1..=STEPS)
            .map(|i| step * i as f64)
            .map(|way| {
                let [mean, sigma] = GROWTH.map(|g| g * way);
                let [a, b] = [sigma, OF_HIP[1]].map(|s| 1.0 / (s * s));
                let weight = EVEN / STEPS as f64 * parts(way);
                [weight, (a * mean + b * by_hip) / (a + b), (a + b).sqrt()]
            })
            .collect();
        let all = (1.0 - EVEN) * parts(0.0) + ways.iter().map(|w| w[0]).sum::<f64>();
        let sum =
            |of: &dyn Fn(&[f64; 3]) -> f64| ways.iter().map(|w| w[0] * of(w)).sum::<f64>() / all;
        let longer = |by: f64| sum(&|w| normal_above((by - w[1]) * w[2]));
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..30 {
            let middle = (low + high) / 2.0;
            match longer(middle) > 0.05 {
                true => low = middle,
                false => high = middle,
            }
        }
        Hidden {
            above,
            mean: sum(&|w| w[1]),
            most: low,
        }
    }

    /// Whether more of a thigh with such a tape is hidden, on the mean, than a survey allows two tapes to differ by. \[mm\]
    pub(crate) fn matters(&self, tape: f64) -> bool {
        self.mean * tape > ALLOWED_MM
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::people;
    use crate::model::table::Table;
    use nalgebra::{Matrix2, Vector2};
    use shape::NINE_IN_TEN;

    /// Least squares of the crotch's share on the buttocks', of some people: both numbers and the deviation.
    fn fitted(all: &[(f64, f64)]) -> (Vector2<f64>, f64) {
        let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for (buttock, crotch) in all {
            let row = Vector2::new(1.0, *buttock);
            normal += row * row.transpose();
            right += row * *crotch;
        }
        let fit = normal.cholesky().unwrap().solve(&right);
        let off = all.iter().map(|(b, c)| (c - fit[0] - fit[1] * b).powi(2));
        (fit, (off.sum::<f64>() / all.len() as f64).sqrt())
    }

    #[test]
    fn the_crotch_is_that_of_the_survey_and_holds_on_the_half_that_is_left_out() {
        let people = people(&Table::checked_in("ansur2.csv")).unwrap();
        let all: Vec<(f64, f64)> = people
            .iter()
            .map(|p| (p.anatomy[2], p.anatomy[1]))
            .collect();
        let (fit, sigma) = fitted(&all);
        proof::near(fit[0], CROTCH[0], 5e-5);
        proof::near(fit[1], CROTCH[1], 5e-5);
        proof::near(sigma, SIGMA, 5e-5);
        let half: Vec<_> = all.iter().step_by(2).copied().collect();
        let (fit, sigma) = fitted(&half);
        let rest = all.iter().skip(1).step_by(2);
        let off: Vec<f64> = rest.map(|(b, c)| c - fit[0] - fit[1] * b).collect();
        let inside = off.iter().filter(|o| o.abs() < 1.645 * sigma).count();
        let share = inside as f64 / off.len() as f64;
        assert!((0.89..0.93).contains(&share), "{share}");
    }

    /// Mean and standard deviation.
    fn spread(all: impl Iterator<Item = f64>) -> [f64; 2] {
        let all: Vec<f64> = all.collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let square = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        [mean, (square / all.len() as f64).sqrt()]
    }

    /// A made body's thigh: whether a web was made, its true tape, how far above its upper end the expected crotch is, the hip's tape, its own and those
    /// 0.02 and 0.04 below; shares of stature.
    type Thigh = [f64; 7];

    /// Thighs of the first 160 made bodies, and of the rest. A ring that takes in the other leg is no thigh's.
    fn thighs() -> (Vec<Thigh>, Vec<Thigh>) {
        let table = Table::checked_in("thighs.csv");
        let names = ["web", "truth", "above", "hip", "tape", "lower20", "lower40"];
        let columns = names.map(|c| table.numbers(c).unwrap());
        let ids = table.text("id").unwrap();
        let first = |i: usize| ids[i].rsplit('/').next().unwrap().parse::<u32>().unwrap() < 160;
        let own = |t: &Thigh| t[5].max(t[6]) < 1.15 * t[4];
        let all = (0..table.len()).map(|i| (first(i), columns.each_ref().map(|c| c[i])));
        let (fit, rest): (Vec<_>, Vec<_>) =
            all.filter(|(_, t)| own(t)).partition(|(first, _)| *first);
        let rows = |part: Vec<(bool, Thigh)>| part.into_iter().map(|(_, t)| t).collect();
        (rows(fit), rows(rest))
    }

    #[test]
    fn thighs_part_grow_and_are_of_a_hip_as_those_of_made_bodies() {
        let near = |fitted: [f64; 2], own: [f64; 2], within: f64| {
            proof::near(fitted[0], own[0], within);
            proof::near(fitted[1], own[1], within);
        };
        let (fit, _) = thighs();
        let bare: Vec<_> = fit.iter().filter(|t| t[0] == 0.0).collect();
        near(spread(bare.iter().map(|t| t[2])), WEBLESS, 1e-4);
        let grown = |t: &&Thigh| [(t[4] / t[5] - 1.0) / 0.02, (t[4] / t[6] - 1.0) / 0.04];
        near(spread(bare.iter().flat_map(grown)), GROWTH, 5e-3);
        near(
            spread(fit.iter().map(|t| libm::log(t[1] / t[3]))),
            OF_HIP,
            1e-3,
        );
        let people = Table::checked_in("ansur2.csv");
        let [thigh, hip] =
            ["thigh", "buttock"].map(|c| people.numbers(&format!("{c}circumference")).unwrap());
        let survey = spread(thigh.iter().zip(&hip).map(|(t, h)| libm::log(t / h)));
        assert!(survey[1] < 0.6 * OF_HIP[1]);
        let top = |[mean, sigma]: [f64; 2]| mean + NINE_IN_TEN * sigma;
        proof::near(top(survey), top(OF_HIP), 0.01);
    }

    #[test]
    fn what_is_hidden_of_thighs_that_are_left_out_of_the_fit_is_bounded_however_low_they_are_joined()
     {
        let (_, rest) = thighs();
        // As they are, and joined on purpose so much lower.
        for (lower, tape, least) in [(0.0, 4, 0.93), (0.02, 5, 0.90), (0.04, 6, 0.96)] {
            let inside = |t: &&Thigh| {
                let hidden = Hidden::of(0.481, 0.481 - t[2] - lower, 0.385, t[tape] / t[3]);
                t[1] <= t[tape] * (1.0 + hidden.most)
            };
            let share = rest.iter().filter(inside).count() as f64 / rest.len() as f64;
            assert!(rest.len() > 150 && share > least, "{lower}: {share}");
        }
    }

    #[test]
    fn what_is_hidden_grows_by_degrees_from_nothing_and_is_less_of_a_thigh_that_is_full_for_its_hip()
     {
        let at = |above: f64, of_hip: f64| Hidden::of(0.48, 0.48 - above, 0.385, of_hip);
        assert!(at(-0.02, 0.57).most < 2e-3 && !at(0.0, 0.57).matters(600.0));
        assert!(at(0.06, 0.57).matters(600.0));
        for above in (-20..90).map(|mm| f64::from(mm) / 1000.0) {
            let rise = at(above + 0.001, 0.57).most - at(above, 0.57).most;
            assert!((0.0..6e-3).contains(&rise), "{above}: {rise}");
            assert!(at(above, 0.62).most <= at(above, 0.57).most);
        }
    }
}
