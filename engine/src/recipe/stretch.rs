//! The values from one number to another.

use super::written::Stretch;
use stage::Value;

/// The values of a range; without steps, its ends.
pub(crate) fn values(s: &Stretch) -> Vec<Value> {
    let steps = s.steps.unwrap_or(2);
    let at = |i: usize| match steps {
        1 => 0.0,
        _ => i as f64 / (steps - 1) as f64,
    };
    let numbers: Vec<f64> = (0..steps).map(|i| between(s, at(i))).collect();
    let whole = s.whole && (s.log || numbers.iter().all(|x| x.fract().abs() < 1e-9));
    let mut values: Vec<Value> = numbers.iter().map(|x| written(*x, whole)).collect();
    values.dedup();
    values
}

/// The number at a share of the way. The ends are exact.
pub(crate) fn between(s: &Stretch, share: f64) -> f64 {
    if share <= 0.0 || share >= 1.0 {
        return if share <= 0.0 { s.from } else { s.to };
    }
    let x = match s.log {
        true => s.from * libm::pow(s.to / s.from, share),
        false => s.from + (s.to - s.from) * share,
    };
    // Twelve digits: 0.3 and not 0.30000000000000004.
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// A number as a param has it: whole, or not.
pub(crate) fn written(x: f64, whole: bool) -> Value {
    match whole {
        true => Value::Int(x.round() as i64),
        false => Value::Float(x),
    }
}
