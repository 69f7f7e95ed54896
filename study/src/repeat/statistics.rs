//! Repeated measurements in numbers: technical error, coefficient of variation, intraclass correlation, agreement.

/// Repeated measurements of some people: a list of each one's, in the order in which they were taken.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Repeats(pub Vec<Vec<f64>>);

/// How two measurements of the same agree (Bland and Altman 1986, Lancet 327:307).
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Mean and difference of each pair: a later measurement less the person's first.
    pub pairs: Vec<[f64; 2]>,
    /// Mean of the differences.
    pub bias: f64,
    /// Nineteen differences in twenty are between these: bias ± 1.96 of their standard deviation; `None` of one pair.
    pub limits: Option<[f64; 2]>,
}

const TWO_SIDED_95: f64 = 1.959_963_984_540_054;

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Sum of squares about a centre.
fn squares(values: &[f64], about: f64) -> f64 {
    values.iter().map(|v| (v - about) * (v - about)).sum()
}

impl Repeats {
    /// Those who were measured more than once.
    fn repeated(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.0.iter().filter(|p| p.len() > 1)
    }

    /// How many differences from people's own means are free: Σ(nᵢ − 1).
    pub fn freedom(&self) -> usize {
        self.repeated().map(|p| p.len() - 1).sum()
    }

    /// Mean of all that was measured more than once.
    pub fn mean(&self) -> f64 {
        mean(&self.repeated().flatten().copied().collect::<Vec<_>>())
    }

    /// Technical error of measurement: √(Σᵢ Σⱼ (xᵢⱼ − x̄ᵢ)² / Σ(nᵢ − 1)), of pairs √(Σd²/2N) (Ulijaszek and Kerr 1999,
    /// Br J Nutr 82:165); the same as the root mean square of people's standard deviations (Glüer 1995, Osteoporos Int 5:262)
    /// and Bland and Altman's within-subject standard deviation. `None` where nobody was measured twice.
    pub fn technical_error(&self) -> Option<f64> {
        let sum: f64 = self.repeated().map(|p| squares(p, mean(p))).sum();
        (self.freedom() > 0).then(|| (sum / self.freedom() as f64).sqrt())
    }

    /// What the technical error is between nineteen times in twenty, by χ² of its degrees of freedom.
    pub fn technical_error_interval(&self) -> Option<[f64; 2]> {
        let (error, free) = (self.technical_error()?, self.freedom());
        let end = |p: f64| error * (free as f64 / chi_square_quantile(p, free)).sqrt();
        Some([end(0.975), end(0.025)])
    }

    /// How far above the technical error the upper end of its interval is; of those who were measured twice.
    pub fn upper_factor(&self) -> f64 {
        let free = self.freedom().max(1);
        (free as f64 / chi_square_quantile(0.025, free)).sqrt()
    }

    /// Root mean square of people's coefficients of variation, weighted by their degrees of freedom (Glüer 1995).
    pub fn rms_cv(&self) -> Option<f64> {
        let share = |p: &Vec<f64>| squares(p, mean(p)) / (mean(p) * mean(p));
        let sum: f64 = self.repeated().map(share).sum();
        (self.freedom() > 0).then(|| (sum / self.freedom() as f64).sqrt())
    }

    /// Coefficient of reliability, 1 − TEM² / SD² of all measurements (Ulijaszek and Kerr 1999); of two people or more.
    pub fn reliability(&self) -> Option<f64> {
        let all: Vec<f64> = self.repeated().flatten().copied().collect();
        let spread = squares(&all, mean(&all)) / (all.len().max(2) - 1) as f64;
        let error = self.technical_error()?;
        (self.repeated().count() > 1 && spread > 0.0).then(|| 1.0 - error * error / spread)
    }

    /// Intraclass correlation ICC(2,1): two-way random effects, absolute agreement, one measurement (Shrout and Fleiss 1979,
    /// Psychol Bull 86:420): (MSR − MSE) / (MSR + (k − 1) MSE + k (MSC − MSE) / n). Of two people or more who were all
    /// measured equally often, at least twice; else `None`.
    pub fn icc_2_1(&self) -> Option<f64> {
        let (n, k) = (self.0.len(), self.0.first()?.len());
        if n < 2 || k < 2 || self.0.iter().any(|p| p.len() != k) {
            return None;
        }
        let (people, times) = (n as f64, k as f64);
        let all: Vec<f64> = self.0.iter().flatten().copied().collect();
        let grand = mean(&all);
        let rows: Vec<f64> = self.0.iter().map(|p| mean(p)).collect();
        let column = |j: usize| mean(&self.0.iter().map(|p| p[j]).collect::<Vec<_>>());
        let columns: Vec<f64> = (0..k).map(column).collect();
        let (of_rows, of_columns) = (
            times * squares(&rows, grand),
            people * squares(&columns, grand),
        );
        let rest = squares(&all, grand) - of_rows - of_columns;
        let msr = of_rows / (people - 1.0);
        let msc = of_columns / (times - 1.0);
        let mse = rest / ((people - 1.0) * (times - 1.0));
        let below = msr + (times - 1.0) * mse + times * (msc - mse) / people;
        (below > 0.0).then(|| (msr - mse) / below)
    }

    /// Each later measurement against the person's first. `None` where nobody was measured twice.
    pub fn agreement(&self) -> Option<Agreement> {
        let of = |p: &Vec<f64>| -> Vec<[f64; 2]> {
            let later = p[1..].iter();
            later.map(|v| [(v + p[0]) / 2.0, v - p[0]]).collect()
        };
        let pairs: Vec<[f64; 2]> = self.repeated().flat_map(of).collect();
        let off: Vec<f64> = pairs.iter().map(|p| p[1]).collect();
        let bias = (!off.is_empty()).then(|| mean(&off))?;
        let limits = (off.len() > 1).then(|| {
            let sd = (squares(&off, bias) / (off.len() - 1) as f64).sqrt();
            [bias - TWO_SIDED_95 * sd, bias + TWO_SIDED_95 * sd]
        });
        Some(Agreement {
            pairs,
            bias,
            limits,
        })
    }
}

/// The value under which a χ² of some degrees of freedom (one or more) is with probability `p` (0 to 1, both excluded), by
/// halving: the series of the incomplete gamma function (Abramowitz and Stegun 6.5.29) is its distribution.
pub fn chi_square_quantile(p: f64, free: usize) -> f64 {
    let a = free as f64 / 2.0;
    // ln Γ(a + 1), from Γ(1) or Γ(1/2) on.
    let first = if free.is_multiple_of(2) { 1.0 } else { 0.5 };
    let start = if free.is_multiple_of(2) {
        0.0
    } else {
        libm::log(std::f64::consts::PI.sqrt())
    };
    let steps = (a + 0.5 - first) as usize;
    let ln_gamma: f64 = start
        + (0..=steps)
            .map(|i| first + i as f64)
            .filter(|x| *x < a + 0.75)
            .map(libm::log)
            .sum::<f64>();
    let below = |x: f64| {
        let (mut term, mut sum, mut n) = (1.0, 1.0, 1.0);
        while term > 1e-16 * sum {
            term *= x / 2.0 / (a + n);
            sum += term;
            n += 1.0;
        }
        libm::exp(a * libm::log(x / 2.0) - x / 2.0 - ln_gamma) * sum
    };
    let (mut low, mut high) = (0.0, 20.0 + 4.0 * free as f64);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        match below(middle) < p {
            true => low = middle,
            false => high = middle,
        }
    }
    (low + high) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::near;

    /// Peak expiratory flow of seventeen people: Wright's meter twice, a mini meter (Bland and Altman 1986, table 1). \[l/min\]
    const WRIGHT: [[f64; 2]; 17] = [
        [494.0, 490.0],
        [395.0, 397.0],
        [516.0, 512.0],
        [434.0, 401.0],
        [476.0, 470.0],
        [557.0, 611.0],
        [413.0, 415.0],
        [442.0, 431.0],
        [650.0, 638.0],
        [433.0, 429.0],
        [417.0, 420.0],
        [656.0, 633.0],
        [267.0, 275.0],
        [478.0, 492.0],
        [178.0, 165.0],
        [423.0, 372.0],
        [427.0, 421.0],
    ];
    const MINI: [f64; 17] = [
        512.0, 430.0, 520.0, 428.0, 500.0, 600.0, 364.0, 380.0, 658.0, 445.0, 432.0, 626.0, 260.0,
        477.0, 259.0, 350.0, 451.0,
    ];

    #[test]
    fn bland_and_altmans_example() {
        let pairs = WRIGHT.iter().zip(&MINI).map(|(w, m)| vec![*m, w[0]]);
        let found = Repeats(pairs.collect()).agreement().unwrap();
        near(found.bias, -2.1, 0.05);
        // The paper takes 2 for 1.96: -79.7 and 75.5.
        let sd = (found.limits.unwrap()[1] - found.bias) / TWO_SIDED_95;
        near(sd, 38.8, 0.05);
        // Within subjects of Wright's meter 15.3 (Bland, An Introduction to Medical Statistics).
        let again = Repeats(WRIGHT.map(|w| w.to_vec()).to_vec());
        near(again.technical_error().unwrap(), 15.3, 0.05);
        assert_eq!(again.freedom(), 17);
        let half: f64 = WRIGHT.iter().map(|[a, b]| (a - b).powi(2)).sum::<f64>() / 34.0;
        near(again.technical_error().unwrap(), half.sqrt(), 1e-12);
    }

    #[test]
    fn shrout_and_fleiss_example() {
        let judges = [
            [9.0, 2.0, 5.0, 8.0],
            [6.0, 1.0, 3.0, 2.0],
            [8.0, 4.0, 6.0, 8.0],
            [7.0, 1.0, 2.0, 6.0],
            [10.0, 5.0, 6.0, 9.0],
            [6.0, 2.0, 4.0, 7.0],
        ];
        let repeats = Repeats(judges.map(|r| r.to_vec()).to_vec());
        near(repeats.icc_2_1().unwrap(), 0.29, 0.005);
        // One missing: people were not measured equally often.
        let mut fewer = repeats.clone();
        fewer.0[2].pop();
        assert_eq!(fewer.icc_2_1(), None);
        assert!(fewer.technical_error().is_some());
    }

    #[test]
    fn coefficients_of_variation_are_joined_as_squares() {
        // Standard deviations of 1 % and 7 %: root mean square 5 %.
        let pair = |mean: f64, cv: f64| {
            let half = mean * cv / std::f64::consts::SQRT_2;
            vec![mean - half, mean + half]
        };
        let repeats = Repeats(vec![pair(100.0, 0.01), pair(900.0, 0.07)]);
        near(repeats.rms_cv().unwrap(), 0.05, 1e-12);
    }

    #[test]
    fn chi_square_has_the_tables_quantiles() {
        // Pearson and Hartley, Biometrika Tables.
        for (p, free, want) in [
            (0.025, 1, 0.000_982),
            (0.975, 1, 5.023_9),
            (0.025, 2, 0.050_64),
            (0.975, 2, 7.377_8),
            (0.025, 9, 2.700_4),
            (0.975, 9, 19.022_8),
            (0.025, 30, 16.790_8),
            (0.975, 30, 46.979_2),
            (0.975, 100, 129.561),
        ] {
            near(chi_square_quantile(p, free) / want, 1.0, 2e-4);
        }
        // Twenty-seven degrees of freedom bound a precision error to +30 % on one side (Glüer 1995).
        near((27.0 / chi_square_quantile(0.05, 27)).sqrt(), 1.29, 0.01);
    }

    #[test]
    fn nobody_measured_twice_gives_no_figures() {
        let once = Repeats(vec![vec![1.0], vec![2.0]]);
        assert_eq!(
            (once.technical_error(), once.rms_cv(), once.icc_2_1()),
            (None, None, None)
        );
        assert_eq!((once.agreement(), once.reliability()), (None, None));
        assert_eq!(Repeats::default().icc_2_1(), None);
        let one = Repeats(vec![vec![1.0, 3.0]]);
        assert_eq!((one.icc_2_1(), one.reliability()), (None, None));
        assert_eq!(one.agreement().unwrap().limits, None);
    }
}
