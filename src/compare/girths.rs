//! Girths side by side, and whether they are the same within a tolerance.

use super::side::Side;
use crate::score::iso_mm;
use serde::{Deserialize, Serialize};

/// A girth as `girths.json` has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Told {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// Along the contour. \[cm\]
    pub cm: f64,
    /// By tape. \[cm\]
    pub tape_cm: f64,
    /// The tape's interval. \[cm\]
    pub interval_cm: Option<[f64; 2]>,
}

/// One girth of all sides.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GirthRow {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// Along the contour, one entry a side. \[cm\]
    pub cm: Vec<Option<f64>>,
    /// By tape, one entry a side. \[cm\]
    pub tape_cm: Vec<Option<f64>>,
    /// Tape against the first side's, one entry for each other. \[mm\]
    pub off_mm: Vec<Option<f64>>,
    /// How much is no difference. \[mm\]
    pub tolerance_mm: f64,
    /// Whether the tapes are the same within it, one entry for each other side.
    pub same: Vec<Option<bool>>,
}

/// The girths that any side has, in the order in which they are met.
pub fn girths(sides: &[Side], tolerance_mm: Option<f64>) -> Vec<GirthRow> {
    let mut names: Vec<(&str, &str)> = Vec::new();
    for g in sides.iter().flat_map(|s| &s.girths) {
        if !names.iter().any(|(n, _)| *n == g.name) {
            names.push((&g.name, &g.label));
        }
    }
    let row = |(name, label): (&str, &str)| {
        let of = |f: fn(&Told) -> f64| -> Vec<Option<f64>> {
            let find = |s: &Side| s.girths.iter().find(|g| g.name == name).map(f);
            sides.iter().map(find).collect()
        };
        let tape = of(|g| g.tape_cm);
        let tolerance = tolerance_mm.unwrap_or_else(|| iso_mm(name));
        let off = |other: &Option<f64>| Some((((*other)? - tape[0]?) * 100.0).round() / 10.0);
        let off: Vec<Option<f64>> = tape.iter().skip(1).map(off).collect();
        GirthRow {
            name: name.into(),
            label: label.into(),
            cm: of(|g| g.cm),
            same: off
                .iter()
                .map(|o| o.map(|mm| mm.abs() <= tolerance))
                .collect(),
            off_mm: off,
            tape_cm: tape.clone(),
            tolerance_mm: tolerance,
        }
    };
    names.into_iter().map(row).collect()
}
