//! The weighted median (paper, eq. 6–7).

/// The number that minimises `Σ weight |value − number|`: the least value at which half of the
/// weight is reached. [`None`] without positive weight.
pub fn weighted_median(samples: &mut [(f64, f64)]) -> Option<f64> {
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = samples.iter().map(|s| s.1).sum();
    if total <= 0.0 || !total.is_finite() {
        return None;
    }
    let mut below = 0.0;
    samples
        .iter()
        .find(|(_, weight)| {
            below += weight;
            below >= total / 2.0
        })
        .map(|(value, _)| *value)
}

/// The weight of a neighbour (paper, eq. 7): `η e^{−|x − x_v|} + κ e^{−|H_x − H_v|}`, the distance in
/// units of `length` and the difference of mean curvatures in units of its inverse.
pub fn weight(eta: f64, kappa: f64, distance: f64, curvature: f64, length: f64) -> f64 {
    eta * libm::exp(-distance / length) + kappa * libm::exp(-curvature * length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_has_a_smaller_weighted_sum() {
        let mut dice = proof::Dice(5);
        for _ in 0..200 {
            let mut samples: Vec<_> = (0..7).map(|_| (dice.unit(), dice.unit())).collect();
            let cost =
                |m: f64, s: &[(f64, f64)]| s.iter().map(|(v, w)| w * (v - m).abs()).sum::<f64>();
            let median = weighted_median(&mut samples).unwrap();
            let best = samples
                .iter()
                .map(|s| cost(s.0, &samples))
                .fold(f64::MAX, f64::min);
            assert!(cost(median, &samples) <= best + 1e-12);
        }
        assert_eq!(weighted_median(&mut [(1.0, 0.0)]), None);
    }

    #[test]
    fn an_outlier_of_little_weight_moves_nothing() {
        let mut samples = [(0.1, 1.0), (0.2, 1.0), (0.3, 1.0), (1e9, 1.4)];
        assert_eq!(weighted_median(&mut samples), Some(0.3));
        let mut samples = [(0.1, 1.0), (0.2, 1.0), (0.3, 1.0), (1e9, 0.4)];
        assert_eq!(weighted_median(&mut samples), Some(0.2));
    }
}
