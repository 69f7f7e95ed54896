//! Girths side by side, and whether they are the same within a tolerance.

use super::side::Side;
use crate::girth_file::{ReadGirth, suffix};
use crate::repeat::LEAST_CHANGE;
use crate::score::iso_mm;
use serde_json::{Map, Value, json};
use shape::{NINE_IN_TEN, Unit};
use stage::{Message, message};
use std::collections::BTreeMap;

stage::messages! {
    MIXED = "compare-mixed": "lengths of {relative} are relative, for nothing of known length was given, those of {metric} are centimetres: they cannot be compared";
}

/// One girth of all sides, lengths in their unit.
#[derive(Debug, Clone, PartialEq)]
pub struct GirthRow {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// What lengths are in.
    pub unit: Unit,
    /// Along the contour, one entry a side.
    pub contour: Vec<Option<f64>>,
    /// By tape, one entry a side.
    pub tape: Vec<Option<f64>>,
    /// Tape against the first side's, one entry for each other; none where lengths are relative. \[mm\]
    pub off_mm: Vec<Option<f64>>,
    /// How much is no difference. \[mm\]
    pub tolerance_mm: f64,
    /// Whether the tapes are the same within it, one entry for each other side.
    pub same: Vec<Option<bool>>,
    /// What the two captures report of the difference, one entry for each other side.
    pub judged: Vec<Judged>,
}

/// What two captures report of a difference of their tapes; `None` where either reports nothing. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Judged {
    /// Holds the difference of the true lengths nine times in ten: both intervals as independent errors.
    pub interval_mm: Option<[f64; 2]>,
    /// Least significant change: what measuring the same body twice exceeds one time in twenty.
    pub least_change_mm: Option<f64>,
    /// Whether the difference exceeds it.
    pub changed: Option<bool>,
}

/// Technical errors of measurement by the girth's name, as `tailor repeat` found them. \[mm\]
pub type TechnicalErrors = BTreeMap<String, f64>;

/// The difference `b` less `a`, both in centimetres, by both intervals and by what repetition gives: the technical error
/// where somebody measured it, else what the captures report themselves of repetition and of their scales.
fn judged(a: &ReadGirth, b: &ReadGirth, known: &TechnicalErrors) -> Judged {
    let off = 10.0 * (b.tape - a.tape);
    let reach = |low: bool| {
        let [x, y] = [a.interval?, b.interval?];
        // How far each may err so that the difference is less, or more, than was found.
        let (first, second) = match low {
            true => (x[1] - a.tape, b.tape - y[0]),
            false => (a.tape - x[0], y[1] - b.tape),
        };
        Some(10.0 * libm::hypot(first, second))
    };
    let ends = reach(true).zip(reach(false));
    let own = |g: &ReadGirth| Some(libm::hypot(g.repeat? / NINE_IN_TEN, g.scale.unwrap_or(0.0)));
    let by_captures = || Some(1.96 * 10.0 * libm::hypot(own(a)?, own(b)?));
    let least = known
        .get(&a.name)
        .map(|error| LEAST_CHANGE * error)
        .or_else(by_captures);
    let round = |mm: f64| (10.0 * mm).round() / 10.0;
    Judged {
        interval_mm: ends.map(|(low, high)| [round(off - low), round(off + high)]),
        least_change_mm: least.map(round),
        changed: least.map(|least| off.abs() > least),
    }
}

impl GirthRow {
    /// For other programs.
    pub(super) fn json(&self) -> Value {
        let suffix = suffix(self.unit);
        let mut row = Map::new();
        let mut put = |key: &str, value: Value| row.insert(key.to_owned(), value);
        put("name", json!(self.name));
        put("label", json!(self.label));
        put(suffix, json!(self.contour));
        put(&format!("tape_{suffix}"), json!(self.tape));
        if self.unit == Unit::Metric {
            put("off_mm", json!(self.off_mm));
            put("tolerance_mm", json!(self.tolerance_mm));
            put("same", json!(self.same));
            let of = |f: &dyn Fn(&Judged) -> Value| self.judged.iter().map(f).collect::<Value>();
            put("off_interval_mm", of(&|j| json!(j.interval_mm)));
            put("lsc95_mm", of(&|j| json!(j.least_change_mm)));
            put("changed", of(&|j| json!(j.changed)));
        }
        Value::Object(row)
    }
}

/// Why girths of these sides cannot be compared: some have a scale, some have none.
pub fn mixed(sides: &[Side]) -> Option<Message> {
    let of = |unit: Unit| -> Vec<&str> {
        let some = sides.iter().filter(|s| s.unit == Some(unit));
        some.map(|s| s.name.as_str()).collect()
    };
    let (metric, relative) = (of(Unit::Metric), of(Unit::Relative));
    (!metric.is_empty() && !relative.is_empty())
        .then(|| message!(MIXED, relative = relative, metric = metric))
}

/// The girths that any side has, in the order in which they are met; none where units are [`mixed`].
/// Relative lengths are shown side by side, without a verdict in millimetres.
/// What repetition gives is taken from `known` errors, else by the captures themselves.
pub fn girths(sides: &[Side], tolerance_mm: Option<f64>, known: &TechnicalErrors) -> Vec<GirthRow> {
    if mixed(sides).is_some() {
        return vec![];
    }
    let unit = sides.iter().find_map(|s| s.unit).unwrap_or_default();
    let mut firsts: Vec<&ReadGirth> = Vec::new();
    for g in sides.iter().flat_map(|s| &s.girths) {
        if !firsts.iter().any(|known| known.name == g.name) {
            firsts.push(g);
        }
    }
    let row = |girth: &ReadGirth| {
        let of = |f: fn(&ReadGirth) -> f64| -> Vec<Option<f64>> {
            let find = |s: &Side| s.girths.iter().find(|g| g.name == girth.name).map(f);
            sides.iter().map(find).collect()
        };
        let tape = of(|g| g.tape);
        let tolerance = tolerance_mm.unwrap_or_else(|| iso_mm(&girth.name, girth.part.as_deref()));
        let off = |other: &Option<f64>| match unit {
            Unit::Metric => Some((((*other)? - tape[0]?) * 100.0).round() / 10.0),
            Unit::Relative => None,
        };
        let off: Vec<Option<f64>> = tape.iter().skip(1).map(off).collect();
        let find = |s: &'_ Side| s.girths.iter().find(|g| g.name == girth.name).cloned();
        let first = find(&sides[0]);
        let judge = |other: &Side| match (unit, &first, find(other)) {
            (Unit::Metric, Some(a), Some(b)) => judged(a, &b, known),
            _ => Judged::default(),
        };
        GirthRow {
            name: girth.name.clone(),
            label: girth.label.clone(),
            unit,
            contour: of(|g| g.contour),
            same: off
                .iter()
                .map(|o| o.map(|mm| mm.abs() <= tolerance))
                .collect(),
            off_mm: off,
            judged: sides.iter().skip(1).map(judge).collect(),
            tape,
            tolerance_mm: tolerance,
        }
    };
    firsts.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::girth_file::GirthFile;
    use proof::near;

    /// A waist with its interval, what repeats and its scale. \[cm\]
    fn waist(tape: f64, low: f64, high: f64) -> ReadGirth {
        let text = format!(
            r#"{{"unit":"cm","girths":[{{"name":"WC","label":"waist","cm":{tape},"tape_cm":{tape},"interval_cm":[{low},{high}],
            "repeat_cm":0.329,"sigma_cm":{{"scale":0.15}}}}]}}"#
        );
        GirthFile::read(&text).unwrap().girths.remove(0)
    }

    #[test]
    fn a_difference_is_judged_by_both_intervals_and_by_what_repeats() {
        let (a, b) = (waist(80.0, 79.7, 80.4), waist(81.0, 80.6, 81.3));
        let found = judged(&a, &b, &TechnicalErrors::new());
        // Less: the first up to 4 mm more, the second 4 mm less; more: 3 and 3.
        let [low, high] = found.interval_mm.unwrap();
        near(low, 10.0 - 32f64.sqrt(), 0.051);
        near(high, 10.0 + 18f64.sqrt(), 0.051);
        // Each 2 mm by repetition and 1.5 mm by its scale.
        near(
            found.least_change_mm.unwrap(),
            1.96 * 2.5 * 2f64.sqrt(),
            0.051,
        );
        assert_eq!(found.changed, Some(true));
        let known = TechnicalErrors::from([("WC".to_owned(), 5.0)]);
        let found = judged(&a, &b, &known);
        assert_eq!(
            (found.least_change_mm, found.changed),
            (Some(13.9), Some(false))
        );
    }

    #[test]
    fn what_a_capture_does_not_report_is_not_judged() {
        let silent = ReadGirth {
            interval: None,
            repeat: None,
            ..waist(81.0, 80.6, 81.3)
        };
        let found = judged(&waist(80.0, 79.7, 80.4), &silent, &TechnicalErrors::new());
        assert_eq!(found, Judged::default());
    }
}
