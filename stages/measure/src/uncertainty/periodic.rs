//! A periodic cubic smoothing spline, its mean, and how sure that is: between values it is as unsure as it bends where they are.
//!
//! Harmonic k of a function with such a prior has a variance of s²/k⁴ (Wahba 1990, Spline Models for Observational Data, 2.1);
//! its posterior is the spline, and its posterior deviation covers as often as it promises (Wahba 1983). How much the function bends
//! against what values scatter is not known: that ratio is summed over by its restricted likelihood.

use nalgebra::{DMatrix, DVector};

/// Harmonics of the function (structural: the variance of what is left out is a ten-thousandth of the first one's).
const HARMONICS: usize = 10;
/// Values' variance as a share of the first harmonic's: from, to, and how many are summed over (structural: from a
/// function that bends a hundred times as much as values scatter to one that is as good as even).
const RATIOS: ([f64; 2], usize) = ([1e-4, 1e4], 17);

/// A spline at its values.
pub(crate) struct Spline {
    /// Its mean all around, in the values' unit.
    pub(crate) mean: f64,
    /// The mean's standard deviation.
    pub(crate) sigma: f64,
    /// What it leaves of each value.
    pub(crate) left: Vec<f64>,
}

/// Lays a spline on values at angles \[rad\], each with a weight. `None` of fewer than two values, or if one is not finite.
pub(crate) fn spline(angles: &[f64], values: &[f64], weights: &[f64]) -> Option<Spline> {
    let n = angles.len();
    if n < 2 {
        return None;
    }
    let unknowns = 1 + 2 * HARMONICS;
    let design = DMatrix::from_fn(n, unknowns, |i, j| match j {
        0 => 1.0,
        j if j % 2 == 1 => libm::cos(j.div_ceil(2) as f64 * angles[i]),
        j => libm::sin((j / 2) as f64 * angles[i]),
    });
    let weighted = DMatrix::from_fn(n, unknowns, |i, j| weights[i] * design[(i, j)]);
    let want = DVector::from_column_slice(values);
    let (normal, right) = (weighted.transpose() * &design, weighted.transpose() * &want);
    let square: f64 = values.iter().zip(weights).map(|(v, w)| w * v * v).sum();
    let decades = RATIOS.0.map(libm::log);
    let likely: Vec<Likely> = (0..RATIOS.1)
        .map(|i| i as f64 / (RATIOS.1 - 1) as f64)
        .map(|t| libm::exp(decades[0] + t * (decades[1] - decades[0])))
        .filter_map(|ratio| likely(&normal, &right, (square, n), ratio))
        .filter(|l| l.fit[0].is_finite())
        .collect();
    if likely.is_empty() {
        return None;
    }
    let best = likely.iter().map(|l| l.log).fold(f64::MIN, f64::max);
    let shares: Vec<f64> = likely.iter().map(|l| libm::exp(l.log - best)).collect();
    let all: f64 = shares.iter().sum();
    let over = |of: &dyn Fn(&Likely) -> f64| {
        let sum = likely.iter().zip(&shares).map(|(l, share)| share * of(l));
        sum.sum::<f64>() / all
    };
    let mean = over(&|l| l.fit[0]);
    let variance = over(&|l| l.variance + (l.fit[0] - mean) * (l.fit[0] - mean));
    let mut fit = DVector::zeros(unknowns);
    for (l, share) in likely.iter().zip(&shares) {
        fit += &l.fit * (share / all);
    }
    Some(Spline {
        mean,
        sigma: variance.sqrt(),
        left: (want - design * fit).as_slice().to_vec(),
    })
}

/// The spline of one ratio of variances.
struct Likely {
    fit: DVector<f64>,
    /// Of the mean.
    variance: f64,
    /// Logarithm of the restricted likelihood, but for a constant.
    log: f64,
}

/// The spline of a ratio, by the normal equations of all values, the sum of their squares and their count.
fn likely(
    normal: &DMatrix<f64>,
    right: &DVector<f64>,
    (square, n): (f64, usize),
    ratio: f64,
) -> Option<Likely> {
    let mut bound = normal.clone();
    let mut prior = 0.0;
    for j in 1..bound.nrows() {
        let pull = ratio * (j.div_ceil(2) as f64).powi(4);
        bound[(j, j)] += pull;
        prior += libm::log(pull);
    }
    let cholesky = bound.cholesky()?;
    let fit = cholesky.solve(right);
    let free = (n - 1) as f64;
    // No values are surer than rounding.
    let scatter = ((square - fit.dot(right)) / free).max(1e-12);
    let first = DVector::from_fn(right.len(), |j, _| f64::from(u8::from(j == 0)));
    let variance = scatter * cholesky.solve(&first)[0];
    let size: f64 = cholesky
        .l_dirty()
        .diagonal()
        .iter()
        .map(|d| 2.0 * libm::log(*d))
        .sum();
    Some(Likely {
        log: -0.5 * (free * libm::log(scatter) + size - prior),
        fit,
        variance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;
    use std::f64::consts::TAU;

    /// Values that scatter about a bent function, and its mean.
    fn drawn(dice: &mut Dice, angles: &[f64]) -> (Vec<f64>, f64) {
        let mut normal = || dice.normal();
        let mean = 3.0 + normal();
        let bends: Vec<[f64; 2]> = (1..=8)
            .map(|k| [normal(), normal()].map(|x| 2.0 * x / f64::from(k * k)))
            .collect();
        let at = |angle: f64| {
            let of = |(k, [c, s]): (usize, &[f64; 2])| {
                let (sin, cos) = libm::sincos((k + 1) as f64 * angle);
                c * cos + s * sin
            };
            mean + bends.iter().enumerate().map(of).sum::<f64>()
        };
        (
            angles.iter().map(|a| at(*a) + 0.5 * normal()).collect(),
            mean,
        )
    }

    #[test]
    fn the_mean_is_within_its_deviation_as_often_as_promised_however_wide_a_gap_is() {
        for gap in [0.0, 0.2, 0.4] {
            let angles: Vec<f64> = (0..30)
                .map(|i| TAU * (1.0 - gap) * f64::from(i) / 30.0)
                .collect();
            let weights = vec![1.0; 30];
            let mut within = 0;
            let mut dice = Dice(7);
            for _ in 0..400 {
                let (values, mean) = drawn(&mut dice, &angles);
                let of = spline(&angles, &values, &weights).unwrap();
                within += u32::from((of.mean - mean).abs() < 1.645 * of.sigma);
            }
            let share = f64::from(within) / 400.0;
            assert!((0.85..=0.95).contains(&share), "{gap}: {share}");
        }
    }

    #[test]
    fn a_function_without_scatter_is_its_own_spline() {
        let angles: Vec<f64> = (0..24).map(|i| TAU * f64::from(i) / 24.0).collect();
        let values: Vec<f64> = angles.iter().map(|a| 2.0 + libm::cos(2.0 * a)).collect();
        let of = spline(&angles, &values, &[1.0; 24]).unwrap();
        proof::near(of.mean, 2.0, 1e-6);
        assert!(of.left.iter().all(|e| e.abs() < 0.01) && of.sigma < 0.01);
        let nothing = vec![f64::NAN; 24];
        assert!(spline(&nothing, &values, &[1.0; 24]).is_none());
        assert!(spline(&angles, &nothing, &[1.0; 24]).is_none());
    }
}
