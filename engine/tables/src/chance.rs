//! How sure a mean is: Student's t, and a test that shuffles signs.

/// So many pairs are tested by all their signs, 2¹⁶; more by as many draws.
const EXACT_PAIRS: usize = 16;

/// Draws of the test that is not exact.
const DRAWS: usize = 1 << EXACT_PAIRS;

/// Mean of some numbers, one or more.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation, by n − 1; of two numbers or more.
pub(crate) fn deviation(values: &[f64]) -> Option<f64> {
    let about = mean(values);
    let squares: f64 = values.iter().map(|v| (v - about) * (v - about)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt())
}

/// What holds the true mean nineteen times in twenty, where numbers scatter normally; of two numbers or more.
pub(crate) fn interval(values: &[f64]) -> Option<[f64; 2]> {
    let reach = t_quantile(0.975, values.len().checked_sub(1)?) * deviation(values)?
        / (values.len() as f64).sqrt();
    let about = mean(values);
    Some([about - reach, about + reach])
}

/// The value under which Student's t of some degrees of freedom (one or more) is with probability `p` (above 0.5), by
/// halving; its distribution by Abramowitz and Stegun 26.7.3 and 26.7.4.
fn t_quantile(p: f64, free: usize) -> f64 {
    let within = |t: f64| {
        let angle = libm::atan(t / (free as f64).sqrt());
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let (mut term, mut sum) = if free % 2 == 1 {
            (cosine, 0.0)
        } else {
            (1.0, 0.0)
        };
        let first = 2 + free % 2;
        for k in (first..=free).step_by(2) {
            sum += term;
            term *= cosine * cosine * (k - 1) as f64 / k as f64;
        }
        match free % 2 {
            1 => (angle + sine * sum) * std::f64::consts::FRAC_2_PI,
            _ => sine * sum,
        }
    };
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        match within(middle) < 2.0 * p - 1.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    (low + high) / 2.0
}

/// How often signs by chance give a sum of differences as far from nought as theirs is (Fisher 1935: without a difference
/// either sign of each is as likely): of all signs, or, of more than sixteen pairs, of as many draws, always the same.
/// Also whether all were tried.
pub(crate) fn sign_test(differences: &[f64]) -> (f64, bool) {
    let sum: f64 = differences.iter().sum();
    let size: f64 = differences.iter().map(|d| d.abs()).sum();
    // Sums of the same numbers in another order differ in their last digits.
    let as_far = |other: f64| other.abs() >= sum.abs() - 1e-12 * size;
    // The sums of every eight under all their signs, so that a sum of all is a few of these.
    let tables: Vec<Vec<f64>> = differences.chunks(8).map(signed).collect();
    if differences.len() <= EXACT_PAIRS {
        let all = 1usize << differences.len();
        let at = |bits: usize, k: usize| tables.get(k).map_or(0.0, |t| t[bits >> (8 * k) & 255]);
        let far = (0..all)
            .filter(|bits| as_far(at(*bits, 0) + at(*bits, 1)))
            .count();
        return (far as f64 / all as f64, true);
    }
    // SplitMix64 (Steele, Lea and Flood 2014), 64 signs a number.
    let mut state = 1u64;
    let mut bits = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let mut far = 0;
    for _ in 0..DRAWS {
        let mut drawn = 0.0;
        for eight in tables.chunks(8) {
            let bits = bits().to_le_bytes();
            let part = eight.iter().zip(bits);
            // The last table may be of fewer than eight: the rest of its bits are not used.
            drawn += part
                .map(|(t, byte)| t[byte as usize % t.len()])
                .sum::<f64>();
        }
        far += usize::from(as_far(drawn));
    }
    // What was found is one of the draws (Phipson and Smyth 2010).
    ((far + 1) as f64 / (DRAWS + 1) as f64, false)
}

/// Sums of some numbers, at most eight, under all their signs: a bit that is set turns one around.
fn signed(some: &[f64]) -> Vec<f64> {
    let sum = |bits: usize| {
        let one = |(i, d): (usize, &f64)| if bits >> i & 1 == 1 { -d } else { *d };
        some.iter().enumerate().map(one).sum()
    };
    (0..1 << some.len()).map(sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::near;

    #[test]
    fn students_table() {
        for (free, want) in [
            (1, 12.706),
            (2, 4.303),
            (3, 3.182),
            (7, 2.365),
            (8, 2.306),
            (30, 2.042),
        ] {
            near(t_quantile(0.975, free), want, 5e-4);
        }
        near(t_quantile(0.95, 9), 1.833, 5e-4);
    }

    /// Darwin's maize: crossed less self-fertilised, fifteen pairs, in eighths of an inch (Fisher 1935, §17 and §21).
    const MAIZE: [f64; 15] = [
        49.0, -67.0, 8.0, 16.0, 6.0, 23.0, 28.0, 41.0, 14.0, 29.0, 56.0, 24.0, 75.0, 60.0, -48.0,
    ];

    #[test]
    fn fishers_example() {
        // 1726 of 32768 are as far (863 on either side), where t gives 4.97 %.
        assert_eq!(sign_test(&MAIZE), (1726.0 / 32768.0, true));
        near(mean(&MAIZE), 20.93, 0.005);
        near(deviation(&MAIZE).unwrap(), 37.74, 0.005);
        let [low, high] = interval(&MAIZE).unwrap();
        near(low, 0.03, 0.01);
        near(high, 41.84, 0.01);
    }

    #[test]
    fn draws_come_to_what_all_signs_do_and_are_always_the_same() {
        let many: Vec<f64> = MAIZE.iter().chain(&MAIZE[..5]).copied().collect();
        let (p, exact) = sign_test(&many);
        assert!(!exact);
        assert_eq!(sign_test(&many).0, p);
        // All 2^20 signs, counted once by adding up how often each whole sum comes: 0.07664.
        near(p, 0.07664, 0.003);
        assert_eq!(sign_test(&[0.0; 3]), (1.0, true));
    }
}
