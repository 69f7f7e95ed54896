//! The value in the middle.

use std::borrow::Borrow;

/// The middle one of some numbers, of an even count the upper one of two; `None` of none.
pub fn upper_median(values: impl IntoIterator<Item: Borrow<f64>>) -> Option<f64> {
    let mut all: Vec<f64> = values.into_iter().map(|x| *x.borrow()).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied()
}
