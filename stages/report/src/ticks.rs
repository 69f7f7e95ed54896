//! Ticks of an axis: round numbers at their own places.

/// Round numbers from `low` to `high`, at most so many, their steps 1, 2 or 5 times a power of ten; and how many digits
/// behind the point they have.
pub(crate) fn ticks(low: f64, high: f64, most: usize) -> (Vec<f64>, usize) {
    let steps = (FINEST..=LARGEST).flat_map(|power| [1, 2, 5].map(|lead| (lead, power)));
    for (lead, power) in steps {
        let step = decimal(lead, power);
        let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
        if last - first < most as i64 {
            let all = (first..=last).map(|k| decimal(k * lead, power));
            return (all.collect(), usize::try_from(-power).unwrap_or(0));
        }
    }
    (vec![], 0)
}

/// Powers of ten that steps may have (structural).
const FINEST: i32 = -6;
/// Largest power that is written out (structural: the axis's layout).
const LARGEST: i32 = 9;

/// A number times a power of ten, as near as there is one.
fn decimal(number: i64, power: i32) -> f64 {
    let ten = (0..power.abs()).fold(1.0, |ten, _| ten * 10.0);
    match power < 0 {
        true => number as f64 / ten,
        false => number as f64 * ten,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::Dice;

    #[test]
    fn ticks_are_round_and_have_the_digits_that_they_need() {
        let of = |low, high| {
            let (all, digits) = ticks(low, high, 6);
            let text = |v: &f64| format!("{v:.digits$}");
            all.iter().map(text).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(of(42.4, 47.0), "43 44 45 46 47");
        assert_eq!(of(36.1, 54.2), "40 45 50");
        assert_eq!(of(0.412, 0.441), "0.415 0.420 0.425 0.430 0.435 0.440");
        assert_eq!(of(-0.1, 0.1), "-0.10 -0.05 0.00 0.05 0.10");
        assert_eq!(of(980.0, 1240.0), "1000 1050 1100 1150 1200");
    }

    #[test]
    fn a_label_is_its_ticks_own_value() {
        let mut dice = Dice(1);
        for _ in 0..256 {
            let low = dice.within(0.001, 2000.0);
            let high = low + dice.within(0.005, 900.0);
            let (all, digits) = ticks(low, high, 6);
            assert!((2..=6).contains(&all.len()), "{low} {high}: {all:?}");
            for tick in &all {
                assert!((low - 1e-9..=high + 1e-9).contains(tick), "{low} {high}");
                let label: f64 = format!("{tick:.digits$}").parse().unwrap();
                assert_eq!(label, *tick, "{low} {high}");
            }
            let step = all[1] - all[0];
            let even = |p: &[f64]| (p[1] - p[0] - step).abs() < 1e-9 * high;
            assert!(all.windows(2).all(even), "{low} {high}: {all:?}");
        }
    }
}
