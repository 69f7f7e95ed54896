//! Where stature and buttocks put the crotch, and what that means for a thigh whose upper end is closed on the surface.

use shape::NINE_IN_TEN;

/// Height of the crotch as a share of stature: a constant and a share of the buttocks' height. Fitted on the 6 068 people of
/// `models/tables/ansur2.csv` (a test below).
const CROTCH: [f64; 2] = [0.1713, 0.6104];
/// Its standard deviation; fitted with it.
const SIGMA: f64 = 0.0104;

/// How far above what shows a thigh is fullest, as a share of the way to the crotch, root mean square. Fitted on
/// `models/tables/thighs.csv` (a test below), thighs of made bodies: half of them had no web.
const FULLEST: f64 = 0.2;

/// How far below the expected crotch the legs of 95 in 100 part at most where no web joins them, as a share of stature. Fitted on the
/// 120 bodies without a web of the first 160 of `models/made/strangers.py`; so were those of 95 in 100 of the 60 of the next 80.
const WEBLESS: f64 = 0.037;

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
    0.5 * libm::erfc(-gap / SIGMA / std::f64::consts::SQRT_2)
}

/// What may be hidden of a thigh between where legs join on a surface and the crotch; shares of stature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hidden {
    /// How far the expected crotch is above where the legs join.
    pub(crate) above: f64,
    /// Root mean square of how far the thigh's fullest is above what shows.
    pub(crate) rms: f64,
    /// How much its tape grows upward, as far below what shows as the expected crotch is above it. \[mm a mm\]
    pub(crate) growth: f64,
}

impl Hidden {
    /// Of a body whose buttocks are so high, whose legs join so high and whose thigh's tape grows so much over a way.
    pub(crate) fn of(buttock: f64, join: f64, growth: impl Fn(f64) -> f64) -> Hidden {
        let above = crotch(buttock) - join;
        let z = above / SIGMA;
        let density = libm::exp(-0.5 * z * z) / std::f64::consts::TAU.sqrt();
        // The mean square of a normal distribution's part above nought.
        let square = (above * above + SIGMA * SIGMA) * self::above(above) + above * SIGMA * density;
        Hidden {
            above,
            rms: FULLEST * square.max(0.0).sqrt(),
            growth: growth(above),
        }
    }

    /// Whether legs join lower than those of 95 in 100 bodies between whose legs nothing is.
    pub(crate) fn by_a_web(&self) -> bool {
        self.above > WEBLESS
    }

    /// Whether more of a thigh is hidden, nine times in ten at most, than a survey allows two tapes to differ by: of a body of
    /// such a stature. \[mm\]
    pub(crate) fn matters(&self, stature: f64) -> bool {
        self.above > 0.0 && NINE_IN_TEN * self.rms * stature * self.growth > ALLOWED_MM
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::people;
    use crate::model::table::Table;
    use nalgebra::{Matrix2, Vector2};

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

    #[test]
    fn thighs_are_fullest_where_those_of_made_bodies_were() {
        let table = Table::checked_in("thighs.csv");
        let [tape, truth, sigma] = ["tape", "truth", "sigma"].map(|c| table.numbers(c).unwrap());
        let square = (0..table.len()).map(|i| ((tape[i] - truth[i]) / sigma[i]).powi(2));
        let rms = (square.sum::<f64>() / table.len() as f64).sqrt();
        assert!(table.len() > 70);
        // These deviations are those of a fullest place anywhere between what shows and the crotch.
        proof::near(rms / 3f64.sqrt(), FULLEST, 0.005);
    }

    #[test]
    fn what_is_hidden_grows_from_little_to_the_whole_gap() {
        let growing = |join: f64, growth: f64| Hidden::of(0.5, join, |_| growth);
        let at = |join: f64| growing(join, 1.0);
        let crotch = CROTCH[0] + 0.5 * CROTCH[1];
        assert!(at(crotch + 0.03).rms < 1e-3 && !at(crotch + 0.03).matters(1750.0));
        proof::near(at(crotch).rms, FULLEST * SIGMA / 2f64.sqrt(), 1e-12);
        let deep = at(crotch - 0.08);
        proof::near(deep.rms, FULLEST * libm::hypot(0.08, SIGMA), 1e-6);
        // 81 thousandths of 1.75 m, of which a fifth counts, at a fifth and at a tenth of a mm a mm.
        let matters = |growth: f64| growing(crotch - 0.08, growth).matters(1750.0);
        assert!(matters(0.2) && !matters(0.1));
    }
}
