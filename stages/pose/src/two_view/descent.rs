//! Robust least squares of few unknowns by Levenberg and Marquardt, derivatives by differences.

use nalgebra::{DMatrix, DVector};

/// Minimises Σ c² ln(1 + r²/c²) from a start; all unknowns are of the order of one.
pub(crate) fn descend(
    start: &[f64],
    residuals: impl Fn(&[f64]) -> Vec<f64>,
    loss: f64,
    steps: usize,
) -> Vec<f64> {
    let c2 = loss * loss;
    let cost = |r: &[f64]| r.iter().map(|r| c2 * libm::log1p(r * r / c2)).sum::<f64>();
    let (mut x, n) = (start.to_vec(), start.len());
    let mut now = residuals(&x);
    let mut damping = 1e-3;
    let h = 1e-6;
    for _ in 0..steps {
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|k| {
                let mut moved = x.clone();
                moved[k] += h;
                let r = residuals(&moved);
                r.iter().zip(&now).map(|(a, b)| (a - b) / h).collect()
            })
            .collect();
        let weights: Vec<f64> = now.iter().map(|r| 1.0 / (1.0 + r * r / c2)).collect();
        let mut matrix = DMatrix::zeros(n, n);
        let mut right = DVector::zeros(n);
        for i in 0..n {
            for j in 0..=i {
                let sum = (0..now.len()).map(|k| weights[k] * columns[i][k] * columns[j][k]);
                matrix[(i, j)] = sum.sum::<f64>();
                matrix[(j, i)] = matrix[(i, j)];
            }
            right[i] = -(0..now.len())
                .map(|k| weights[k] * columns[i][k] * now[k])
                .sum::<f64>();
        }
        let before = cost(&now);
        let mut better = false;
        while damping < 1e9 {
            let mut damped = matrix.clone();
            (0..n).for_each(|i| damped[(i, i)] = damped[(i, i)] * (1.0 + damping) + 1e-12);
            if let Some(step) = damped.cholesky().map(|c| c.solve(&right)) {
                let moved: Vec<f64> = x.iter().zip(&step).map(|(x, s)| x + s).collect();
                let next = residuals(&moved);
                if cost(&next) < before {
                    better = cost(&next) < before * (1.0 - 1e-6);
                    (x, now) = (moved, next);
                    damping = (damping * 0.2f64).max(1e-9);
                    break;
                }
            }
            damping *= 6.0;
        }
        if !better {
            break;
        }
    }
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
