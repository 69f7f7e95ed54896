//! Metrics in JSON, which knows no number that is not finite, and whose reader misses some by a last digit.

use serde::{Deserialize, Serialize};
use stage::Metric;

/// Name, value and unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct MetricText(String, Number, String);

/// A number; as a text what is not finite (`"NaN"`, `"inf"`, `"-inf"`), and what would come back as its neighbour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
enum Number {
    Finite(f64),
    Text(String),
}

/// Whether a number is the same once it was written and read.
fn comes_back(value: f64) -> bool {
    let text = serde_json::to_string(&value).unwrap_or_default();
    let read = serde_json::from_str::<f64>(&text).ok();
    read.is_some_and(|read| read.to_bits() == value.to_bits())
}

impl MetricText {
    pub(super) fn of(metric: &Metric) -> MetricText {
        let value = match comes_back(metric.value) {
            true => Number::Finite(metric.value),
            false => Number::Text(metric.value.to_string()),
        };
        MetricText(metric.name.clone(), value, metric.unit.clone())
    }

    pub(super) fn metric(self) -> Metric {
        let value = match self.1 {
            Number::Finite(value) => value,
            Number::Text(text) => text.parse().unwrap_or(f64::NAN),
        };
        Metric {
            name: self.0,
            value,
            unit: self.2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_comes_back_and_finite_numbers_are_numbers() {
        for value in [0.1, -3.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let metric = Metric {
                name: "x".into(),
                value,
                unit: "mm".into(),
            };
            let json = serde_json::to_string(&MetricText::of(&metric)).unwrap();
            let back: MetricText = serde_json::from_str(&json).unwrap();
            assert_eq!(back.metric().value.to_bits(), value.to_bits(), "{json}");
        }
        let mut dice = proof::Dice(7);
        let missed = (0..10_000).map(|_| 100.0 * dice.normal()).filter(|x| {
            let metric = Metric {
                name: "x".into(),
                value: *x,
                unit: "mm".into(),
            };
            let json = serde_json::to_string(&MetricText::of(&metric)).unwrap();
            let back: MetricText = serde_json::from_str(&json).unwrap();
            assert_eq!(back.metric().value.to_bits(), x.to_bits(), "{json}");
            !comes_back(*x)
        });
        assert!(
            missed.count() > 0,
            "the reader of JSON misses none any more"
        );
        let old: MetricText = serde_json::from_str("[\"x\", 2.5, \"mm\"]").unwrap();
        assert_eq!(old.metric().value, 2.5);
    }
}
