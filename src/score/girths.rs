//! Girths against the true ones, and the limits of ISO 20685-1.

use crate::score::truth::{True, Unreadable, json};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// One girth against the true one.
#[derive(Debug, Clone, Serialize)]
pub struct GirthScore {
    /// The true contour. \[cm\]
    pub truth_cm: f64,
    /// The contour that was found. \[cm\]
    pub cm: Option<f64>,
    /// Its relative error.
    pub error_pct: Option<f64>,
    /// Relative error of the tape.
    pub tape_error_pct: Option<f64>,
    /// Error of the tape. \[mm\]
    pub tape_error_mm: Option<f64>,
    /// Whether the tape's interval holds the true tape.
    pub interval_holds: Option<bool>,
    /// Most that ISO 20685-1 allows: 9 mm for large girths, 4 mm for small ones. \[mm\]
    pub iso_mm: f64,
}

impl GirthScore {
    /// Whether the tape is within the limit of ISO 20685-1.
    pub fn within_iso(&self) -> Option<bool> {
        self.tape_error_mm.map(|mm| mm.abs() <= self.iso_mm)
    }
}

/// Large girths are those around the trunk.
pub(crate) fn iso_mm(name: &str) -> f64 {
    if ["WC", "HC", "CC", "HC_max"].contains(&name) {
        9.0
    } else {
        4.0
    }
}

/// The girths of a `girths.json` against the true ones.
pub(crate) fn girths(
    path: &Path,
    known: &BTreeMap<String, True>,
) -> Result<BTreeMap<String, Option<GirthScore>>, Unreadable> {
    let file = json(path)?.unwrap_or(Value::Null);
    let list = file
        .get("girths")
        .and_then(Value::as_array)
        .cloned()
        .unwrap_or_default();
    let named = |name: &str| {
        list.iter()
            .find(|g| g.get("name").is_some_and(|n| n == name))
    };
    let score = |(name, truth): (&String, &True)| {
        let score = named(name).map(|found| {
            let number = |key: &str| found.get(key).and_then(Value::as_f64);
            let (cm, tape) = (number("cm"), number("tape_cm").map(|cm| cm * 10.0));
            let tapes = tape.zip(truth.tape_mm);
            let interval: Vec<f64> = found
                .get("interval_cm")
                .and_then(Value::as_array)
                .map(|l| l.iter().filter_map(Value::as_f64).collect())
                .unwrap_or_default();
            GirthScore {
                truth_cm: truth.contour_mm / 10.0,
                cm,
                error_pct: cm.map(|cm| (cm * 10.0 / truth.contour_mm - 1.0) * 100.0),
                tape_error_pct: tapes.map(|(got, want)| (got / want - 1.0) * 100.0),
                tape_error_mm: tapes.map(|(got, want)| got - want),
                interval_holds: match (interval.as_slice(), truth.tape_mm) {
                    ([lo, hi], Some(mm)) => Some((lo * 10.0..=hi * 10.0).contains(&mm)),
                    _ => None,
                },
                iso_mm: iso_mm(name),
            }
        });
        (name.clone(), score)
    };
    Ok(known.iter().map(score).collect())
}
