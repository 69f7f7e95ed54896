//! The captures of one person in the order of their days, with their surfaces.

use super::day::day_in;
use crate::repeat::{By, Capture, captures};
use crate::sections::{Body, body};
use serde_json::Value;
use shape::{Mesh, Unit, mesh_from_ply};
use std::path::{Path, PathBuf};

/// One capture.
pub struct Visit {
    /// What was measured.
    pub capture: Capture,
    /// Its day, `YYYY-MM-DD`: of the capture, else of the folder's name.
    pub day: Option<String>,
    /// The surface that was measured.
    pub mesh: Mesh,
    /// What its slices show.
    pub body: Body,
}

/// Captures by day.
pub struct Series {
    /// The earliest first, or in the order in which they were given where a day is unknown.
    pub visits: Vec<Visit>,
    /// What is odd, in sentences.
    pub warnings: Vec<String>,
}

/// Months without a capture that are warned of. \[days\]
const GAP: i64 = 183;

/// The ground that a capture's heights are measured from. \[mm\]
fn ground(folder: &Path, mesh: &Mesh) -> Result<f64, String> {
    let file = folder.join("landmarks.json");
    let lowest = mesh.bounds().map_or(0.0, |b| b.0.z);
    match std::fs::read_to_string(&file) {
        Err(_) => Ok(lowest),
        Ok(text) => {
            let value: Value =
                serde_json::from_str(&text).map_err(|e| format!("{}: {e}", file.display()))?;
            Ok(value["ground_mm"].as_f64().unwrap_or(lowest))
        }
    }
}

fn visit(capture: Capture) -> Result<Visit, String> {
    let place = capture.folder.join("body.ply");
    let wrong = |why: String| format!("{}: {why}", place.display());
    let bytes = std::fs::read(&place).map_err(|e| {
        wrong(format!(
            "{e}: a surface is needed beside the girths, as `tailor measure` writes it"
        ))
    })?;
    let mesh = mesh_from_ply(&bytes).map_err(|e| wrong(e.to_string()))?;
    if mesh.faces.is_empty() || mesh.unit == Unit::Relative {
        return Err(wrong("it is no surface of known scale".into()));
    }
    let ground = ground(&capture.folder, &mesh)?;
    let body = body(&mesh, ground).ok_or_else(|| wrong("no body is on the ground there".into()))?;
    let day = capture
        .girths
        .date
        .clone()
        .filter(|d| stage::day_number(d).is_some());
    Ok(Visit {
        day: day.or_else(|| day_in(&capture.name)),
        mesh,
        body,
        capture,
    })
}

/// Their surfaces beside captures.
pub(super) fn visits(captures: Vec<Capture>) -> Result<Vec<Visit>, String> {
    captures.into_iter().map(visit).collect()
}

/// Reads the captures of one person.
///
/// # Errors
///
/// Fewer than two, one that was not measured, has no surface or no scale, or the same twice.
pub fn series(folders: &[PathBuf]) -> Result<Series, String> {
    if folders.len() < 2 {
        return Err(
            "give two captures or more of the person: folders that `tailor measure` wrote".into(),
        );
    }
    let all = captures(folders, By::One)?;
    let mut visits: Vec<Visit> = visits(all)?;
    let mut warnings = Vec::new();
    let number = |v: &Visit| v.day.as_deref().and_then(stage::day_number);
    let unknown: Vec<&str> = visits
        .iter()
        .filter(|v| number(v).is_none())
        .map(|v| v.capture.name.as_str())
        .collect();
    if unknown.is_empty() {
        visits.sort_by_key(number);
        for pair in visits.windows(2) {
            let gap = number(&pair[1])
                .zip(number(&pair[0]))
                .map_or(0, |(b, a)| b - a);
            if gap > GAP {
                warnings.push(format!(
                    "nothing was captured for {gap} days between {} and {}",
                    pair[0].capture.name, pair[1].capture.name
                ));
            }
        }
    } else {
        warnings.push(format!(
            "{}: no day is known, so captures are in the order in which they were given; give it with `tailor measure DIR --date 2026-05-01`, or in the folder's name",
            unknown.join(", ")
        ));
    }
    Ok(Series { visits, warnings })
}
