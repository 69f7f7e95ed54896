//! Robust least squares of few unknowns by Levenberg and Marquardt, derivatives by differences.

use crate::adjust::damped::{Problem, System, cauchy};
use nalgebra::{DMatrix, DVector};

/// A step that lowers the cost by less than this share is the last (structural: a search's end).
const GAIN: f64 = 1e-6;
/// Step of the differences; all unknowns are of the order of one.
/// It is derived: about the cube root of what doubles round, 6e-6.
const DIFFERENCE: f64 = 1e-6;

/// Residuals of unknowns under Cauchy's loss.
struct Residuals<F> {
    of: F,
    c2: f64,
}

impl<F: Fn(&[f64]) -> Vec<f64>> Problem for Residuals<F> {
    type State = Vec<f64>;
    type Rest = ();

    fn cost(&self, x: &Vec<f64>) -> f64 {
        let all = (self.of)(x);
        all.iter().map(|r| cauchy(Some(r * r), self.c2)).sum()
    }

    fn system(&self, x: &Vec<f64>, _: f64) -> System<()> {
        let now = DVector::from_vec((self.of)(x));
        let mut jacobian = DMatrix::zeros(now.len(), x.len());
        for k in 0..x.len() {
            let mut moved = x.clone();
            moved[k] += DIFFERENCE;
            let column = (DVector::from_vec((self.of)(&moved)) - &now) / DIFFERENCE;
            jacobian.set_column(k, &column);
        }
        let mut weighed = jacobian.clone();
        for (i, mut row) in weighed.row_iter_mut().enumerate() {
            row /= 1.0 + now[i] * now[i] / self.c2;
        }
        System {
            matrix: weighed.tr_mul(&jacobian),
            right: -weighed.tr_mul(&now),
            rest: (),
        }
    }

    fn moved(&self, x: &Vec<f64>, step: &DVector<f64>, (): &()) -> Vec<f64> {
        x.iter().zip(step).map(|(x, s)| x + s).collect()
    }
}

/// Minimises Σ c² ln(1 + r²/c²) from a start; all unknowns are of the order of one.
pub(crate) fn descend(
    start: &[f64],
    residuals: impl Fn(&[f64]) -> Vec<f64>,
    loss: f64,
    steps: usize,
) -> Vec<f64> {
    let mut x = start.to_vec();
    let problem = Residuals {
        of: residuals,
        c2: loss * loss,
    };
    crate::adjust::damped::descend(&problem, &mut x, steps, GAIN);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_in_spite_of_an_outlier() {
        let points: Vec<(f64, f64)> = (0..20)
            .map(|i| {
                let x = f64::from(i) / 20.0;
                (x, 0.3 + 0.7 * x + if i == 7 { 5.0 } else { 0.0 })
            })
            .collect();
        let residuals = |p: &[f64]| points.iter().map(|(x, y)| p[0] + p[1] * x - y).collect();
        let found = descend(&[0.0, 0.0], residuals, 0.05, 50);
        proof::near(found[0], 0.3, 1e-3);
        proof::near(found[1], 0.7, 1e-3);
    }
}
