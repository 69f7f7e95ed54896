//! Where a value is on an axis.

use system::text::short;

/// An axis: numbers by size, or words in their order.
#[derive(Debug, Clone)]
pub(super) enum Scale {
    /// From the least to the greatest; by ratios if `log`.
    Numbers {
        low: f64,
        high: f64,
        log: bool,
        /// The values that there are, if they are few.
        known: Vec<f64>,
    },
    /// In the order in which they come.
    Words(Vec<String>),
}

/// So many values are all written under an axis.
const WRITTEN: usize = 6;

impl Scale {
    /// Of the values of a param, as they are written.
    pub(super) fn of(texts: &[&str]) -> Scale {
        let numbers: Option<Vec<f64>> = texts
            .iter()
            .map(|t| t.parse().ok().filter(|x: &f64| x.is_finite()))
            .collect();
        match numbers {
            Some(mut known) if !known.is_empty() => {
                known.sort_by(f64::total_cmp);
                known.dedup();
                let log = by_ratios(&known);
                Scale::Numbers {
                    low: known[0],
                    high: known[known.len() - 1],
                    log,
                    known,
                }
            }
            _ => {
                let mut words: Vec<String> = Vec::new();
                for text in texts {
                    if !words.iter().any(|w| w == text) {
                        words.push((*text).to_owned());
                    }
                }
                Scale::Words(words)
            }
        }
    }

    /// From a number to another, with a margin beyond.
    pub(super) fn around(low: f64, high: f64) -> Scale {
        let margin = match high - low {
            0.0 => low.abs().max(1.0) * 0.05,
            span => 0.06 * span,
        };
        Scale::Numbers {
            low: low - margin,
            high: high + margin,
            log: false,
            known: vec![],
        }
    }

    /// The place of a value, 0 to 1; `None` where it is none of the axis.
    pub(super) fn place(&self, text: &str) -> Option<f64> {
        match self {
            Scale::Numbers { .. } => Some(self.at(text.parse().ok()?)),
            Scale::Words(words) => {
                let at = words.iter().position(|w| w == text)?;
                Some((at as f64 + 0.5) / words.len() as f64)
            }
        }
    }

    /// The place of a number, 0 to 1.
    pub(super) fn at(&self, x: f64) -> f64 {
        match self {
            Scale::Words(_) => 0.5,
            Scale::Numbers { low, high, .. } if low == high => 0.5,
            Scale::Numbers { low, high, log, .. } => {
                let f = |x: f64| if *log { libm::log(x) } else { x };
                (f(x) - f(*low)) / (f(*high) - f(*low))
            }
        }
    }

    /// What is written along the axis: place and word.
    pub(super) fn marks(&self) -> Vec<(f64, String)> {
        match self {
            Scale::Words(words) => {
                let place = |i: usize| (i as f64 + 0.5) / words.len() as f64;
                let all = words.iter().enumerate();
                all.map(|(i, w)| (place(i), w.clone())).collect()
            }
            Scale::Numbers {
                low,
                high,
                log,
                known,
            } => {
                let values = match () {
                    () if !known.is_empty() && known.len() <= WRITTEN => known.clone(),
                    () if *log => vec![*low, (low * high).sqrt(), *high],
                    () => round(*low, *high),
                };
                values.iter().map(|x| (self.at(*x), short(*x))).collect()
            }
        }
    }
}

/// Round numbers between two: steps of 1, 2 or 5 times a power of ten, about four.
fn round(low: f64, high: f64) -> Vec<f64> {
    let span = (high - low) / 4.0;
    if !(span > 0.0 && span.is_finite()) {
        return vec![low];
    }
    let power = libm::pow(10.0, libm::log10(span).floor());
    let times = [1.0, 2.0, 5.0].into_iter().find(|t| t * power >= span);
    let step = times.unwrap_or(10.0) * power;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    // Whole numbers of steps, written as short as they are.
    let value = |i: i64| format!("{:.11e}", i as f64 * step).parse().unwrap_or(0.0);
    (first..=last).map(value).collect()
}

/// Whether ascending values are spread more evenly by their ratios than by their differences.
fn by_ratios(values: &[f64]) -> bool {
    if values.len() < 3 || values[0] <= 0.0 {
        return false;
    }
    let uneven = |f: &dyn Fn(f64) -> f64| {
        let gaps = values.windows(2).map(|w| f(w[1]) - f(w[0]));
        let (least, most) = gaps.fold((f64::MAX, 0.0f64), |(a, b), g| (a.min(g), b.max(g)));
        most / least
    };
    uneven(&libm::log) < uneven(&|x| x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_logarithmic_where_values_are_ratios() {
        let log = |texts: &[&str]| matches!(Scale::of(texts), Scale::Numbers { log: true, .. });
        assert!(log(&["0.1", "0.3", "1", "3", "10"]));
        assert!(log(&["1.5", "2", "3", "4", "6", "8", "12"]));
        assert!(!log(&["1", "2", "3", "4"]));
        assert!(!log(&["0", "3", "8"]));
        assert!(!log(&["2", "8"]));
        assert_eq!(Scale::of(&["a", "b"]).place("b"), Some(0.75));
        assert_eq!(round(-1.3, 6.1), [0.0, 2.0, 4.0, 6.0]);
    }
}
