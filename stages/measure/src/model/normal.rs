//! A normal distribution over named variables: means, covariances, and what some of them give of another.

use nalgebra::{DMatrix, DVector};

/// A multivariate normal distribution.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Normal {
    /// Means.
    pub mean: DVector<f64>,
    /// Covariances, symmetric.
    pub covariance: DMatrix<f64>,
}

/// What observed variables give of one more.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Conditional {
    /// Its mean.
    pub mean: f64,
    /// Its variance.
    pub variance: f64,
    /// Logarithm of the density of what was observed.
    pub log_density: f64,
    /// Squared Mahalanobis distance of what was observed from the mean.
    pub distance: f64,
    /// How much the mean moves with each observed value.
    pub weights: Vec<f64>,
}

impl Normal {
    /// Mean and covariance of rows (n − 1 in the denominator). `None` with less than two rows.
    pub(crate) fn of(rows: &DMatrix<f64>) -> Option<Normal> {
        let (n, width) = rows.shape();
        if n < 2 {
            return None;
        }
        let mean = DVector::from_fn(width, |j, _| rows.column(j).sum() / n as f64);
        let centred = DMatrix::from_fn(n, width, |i, j| rows[(i, j)] - mean[j]);
        let covariance = centred.transpose() * &centred / (n as f64 - 1.0);
        Some(Normal { mean, covariance })
    }

    /// The distribution of variable `target` given the values of some. `None` where the observed
    /// covariance is singular or a value is not finite.
    pub(crate) fn given(&self, observed: &[(usize, f64)], target: usize) -> Option<Conditional> {
        self.given_noisy(observed, &[], target)
    }

    /// The same where observed values have variances of their own beside those of the distribution.
    pub(crate) fn given_noisy(
        &self,
        observed: &[(usize, f64)],
        more: &[f64],
        target: usize,
    ) -> Option<Conditional> {
        let n = observed.len();
        let own = |i: usize| more.get(i).copied().unwrap_or(0.0);
        let among = DMatrix::from_fn(n, n, |i, j| {
            let shared = self.covariance[(observed[i].0, observed[j].0)];
            shared + if i == j { own(i) } else { 0.0 }
        });
        let cross = DVector::from_fn(n, |i, _| self.covariance[(observed[i].0, target)]);
        let off = DVector::from_fn(n, |i, _| observed[i].1 - self.mean[observed[i].0]);
        let factor = among.cholesky()?;
        let (weights, scaled) = (factor.solve(&cross), factor.solve(&off));
        let distance = off.dot(&scaled);
        let log_determinant: f64 = 2.0
            * factor
                .l()
                .diagonal()
                .iter()
                .map(|d| libm::log(*d))
                .sum::<f64>();
        let found = Conditional {
            mean: self.mean[target] + weights.dot(&off),
            variance: self.covariance[(target, target)] - weights.dot(&cross),
            log_density: -0.5
                * (distance + log_determinant + n as f64 * libm::log(std::f64::consts::TAU)),
            distance,
            weights: weights.iter().copied().collect(),
        };
        let sound = found.mean.is_finite() && found.variance > 0.0 && distance.is_finite();
        sound.then_some(found)
    }
}

/// A symmetric matrix from the rows of its lower triangle.
pub(crate) fn symmetric(rows: &[Vec<f64>], width: usize) -> Option<DMatrix<f64>> {
    let triangle = rows.iter().enumerate().all(|(i, row)| row.len() == i + 1);
    let finite = rows.iter().flatten().all(|x| x.is_finite());
    let at = |i: usize, j: usize| rows[i.max(j)][i.min(j)];
    (rows.len() == width && triangle && finite).then(|| DMatrix::from_fn(width, width, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = 2 a − b + noise of variance 0.25, with a, b of variances 1, 4 and covariance 0.5.
    fn known() -> Normal {
        let (va, vb, ab) = (1.0, 4.0, 0.5);
        let (ya, yb) = (2.0 * va - ab, 2.0 * ab - vb);
        let y = 4.0 * va + vb - 4.0 * ab + 0.25;
        Normal {
            mean: DVector::from_vec(vec![1.0, 2.0, 0.0]),
            covariance: DMatrix::from_row_slice(3, 3, &[va, ab, ya, ab, vb, yb, ya, yb, y]),
        }
    }

    #[test]
    fn a_linear_relation_is_found_again() {
        let found = known().given(&[(0, 1.5), (1, 1.0)], 2).unwrap();
        proof::near(found.mean, 2.0 * 0.5 - (-1.0), 1e-12);
        proof::near(found.variance, 0.25, 1e-12);
    }

    #[test]
    fn without_one_of_two_the_variance_is_that_of_the_sum() {
        let found = known().given(&[(0, 1.0)], 2).unwrap();
        proof::near(found.mean, 0.0, 1e-12);
        // Var(b | a) = 4 − 0.25.
        proof::near(found.variance, 3.75 + 0.25, 1e-12);
        proof::near(found.distance, 0.0, 1e-12);
    }

    #[test]
    fn a_value_with_a_variance_of_its_own_weighs_less_and_leaves_more_open() {
        let seen = [(0, 1.5), (1, 1.0)];
        let (sharp, noisy) = (
            known().given(&seen, 2).unwrap(),
            known().given_noisy(&seen, &[3.0], 2).unwrap(),
        );
        assert!(noisy.weights[0] < 0.5 * sharp.weights[0]);
        assert!(noisy.variance > 2.0 * sharp.variance);
        let gone = known().given_noisy(&seen, &[1e12], 2).unwrap();
        proof::near(gone.mean, known().given(&seen[1..], 2).unwrap().mean, 1e-6);
    }

    #[test]
    fn nothing_observed_leaves_the_prior_and_no_number_gives_nothing() {
        let found = known().given(&[], 2).unwrap();
        proof::near(found.mean, 0.0, 1e-12);
        assert_eq!(known().given(&[(0, f64::NAN)], 2), None);
    }

    #[test]
    fn mean_and_covariance_of_rows_are_those_of_the_textbook() {
        let rows = DMatrix::from_row_slice(3, 2, &[1.0, 2.0, 2.0, 4.0, 3.0, 6.0]);
        let normal = Normal::of(&rows).unwrap();
        proof::near(normal.mean[1], 4.0, 1e-12);
        proof::near(normal.covariance[(0, 1)], 2.0, 1e-12);
    }
}
