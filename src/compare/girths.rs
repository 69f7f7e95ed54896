//! Girths side by side, and whether they are the same within a tolerance.

use super::read_girths::{ReadGirth, suffix};
use super::side::Side;
use crate::score::iso_mm;
use serde_json::{Map, Value, json};
use shape::Unit;

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
        }
        Value::Object(row)
    }
}

/// Why girths of these sides cannot be compared: some have a scale, some have none.
pub fn mixed(sides: &[Side]) -> Option<String> {
    let of = |unit: Unit| -> Vec<&str> {
        let some = sides.iter().filter(|s| s.unit == Some(unit));
        some.map(|s| s.name.as_str()).collect()
    };
    let (metric, relative) = (of(Unit::Metric), of(Unit::Relative));
    (!metric.is_empty() && !relative.is_empty()).then(|| {
        format!(
            "lengths of {} are relative, for nothing of known length was given, those of {} are centimetres: they cannot be compared",
            relative.join(", "),
            metric.join(", ")
        )
    })
}

/// The girths that any side has, in the order in which they are met; none where units are [`mixed`].
/// Relative lengths stand side by side, but no limit in millimetres is held against them.
pub fn girths(sides: &[Side], tolerance_mm: Option<f64>) -> Vec<GirthRow> {
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
            tape,
            tolerance_mm: tolerance,
        }
    };
    firsts.into_iter().map(row).collect()
}
