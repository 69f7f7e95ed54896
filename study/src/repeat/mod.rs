//! Repeatability: how near captures of the same person come to each other, girth by girth.
//!
//! ```text
//! girths.json ─ capture ─┐
//! girths.json ─ capture ─┼─ study ─┬─ words: Markdown, JSON, CSV
//! girths.json ─ capture ─┘    │    └─ page, Bland–Altman plots (SVG)
//!                         statistics, known: what other studies report
//! ```

mod captures;
mod known;
mod page;
mod plot;
mod statistics;
mod study;
mod words;

pub use captures::{By, Capture, captures};
pub use known::{KNOWN, Known, allowed_mm};
pub use page::page;
pub use plot::bland_altman_svg;
pub use statistics::{Agreement, Repeats, chi_square_quantile};
pub use study::{GirthStudy, NotRepeated, Study, Tapes, study, study_of};
pub use words::{csv, json, markdown};

use serde_json::Value;
use std::collections::BTreeMap;

/// In how many standard deviations of one measurement a change of two is seen nineteen times in twenty: 1.96 √2.
pub const LEAST_CHANGE: f64 = 1.959_963_984_540_054 * std::f64::consts::SQRT_2;

/// The technical errors of a `repeat.json`, by the girth's name. \[mm\]
///
/// # Errors
///
/// It is no such file.
pub fn technical_errors(text: &str) -> Result<BTreeMap<String, f64>, String> {
    let file: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    let list = file["repeatability"].as_array().ok_or(
        "it has no list `repeatability`: give a repeat.json that `tailor repeat --out` wrote",
    )?;
    let one = |row: &Value| Some((row["name"].as_str()?.to_owned(), row["tem_mm"].as_f64()?));
    let all = list
        .iter()
        .map(|row| one(row).ok_or("a girth has no `name` or `tem_mm`"));
    all.collect::<Result<_, _>>().map_err(str::to_owned)
}
