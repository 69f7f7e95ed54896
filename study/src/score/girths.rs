//! Girths against the true ones, and the limits of ISO 20685-1.

use crate::score::truth::{True, Unreadable, error, json};
use serde::Serialize;
use serde_json::Value;
use shape::{GirthId, Region};
use stage::message;
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
    /// What the surface errs at the plane that was measured, where a true surface is known. \[mm\]
    pub surface_mm: Option<f64>,
    /// What the plane's place adds to that. \[mm\]
    pub level_mm: Option<f64>,
    /// Most that ISO 20685-1 allows: 9 mm for large girths, 4 mm for small ones. \[mm\]
    pub iso_mm: f64,
}

impl GirthScore {
    /// Whether the tape is within the limit of ISO 20685-1.
    pub fn within_iso(&self) -> Option<bool> {
        self.tape_error_mm.map(|mm| mm.abs() <= self.iso_mm)
    }
}

/// The limit of ISO 20685-1 for a girth of a file: by the part of the body that the file names, else by
/// the table; small where neither has it. \[mm\]
pub fn iso_mm(name: &str, part: Option<&str>) -> f64 {
    let by_table = || GirthId::named(name).map(|id| id.definition().region);
    let region = part.and_then(Region::named).or_else(by_table);
    region.unwrap_or(Region::Anywhere).limit_mm()
}

/// A file's unit as it calls it; results without a scale cannot be compared with centimetres.
pub const RELATIVE: &str = "relative";

stage::messages! {
    /// Why such results are not scored.
    NO_SCALE = "score-no-scale": "its lengths are relative, for nothing of known length was given or known lengths contradict each other: they cannot be compared with centimetres; give one when measuring, such as --stature, and score that";
}

/// The girths of a `girths.json` against the true ones.
pub(crate) fn girths(
    path: &Path,
    known: &BTreeMap<String, True>,
) -> Result<BTreeMap<String, Option<GirthScore>>, Unreadable> {
    let file = json(path)?.unwrap_or(Value::Null);
    if file.get("unit").is_some_and(|unit| unit == RELATIVE) {
        return Err(error(path, message!(NO_SCALE)));
    }
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
                surface_mm: None,
                level_mm: None,
                iso_mm: iso_mm(name, found.get("part").and_then(Value::as_str)),
            }
        });
        (name.clone(), score)
    };
    Ok(known.iter().map(score).collect())
}
