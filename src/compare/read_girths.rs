//! Girths as a `girths.json` has them.

use crate::score::RELATIVE;
use serde_json::Value;
use shape::Unit;

/// A girth as `girths.json` has it, lengths in the unit of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadGirth {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// Where on the body, by the table of girths; older files do not say.
    pub part: Option<String>,
    /// Along the contour.
    pub contour: f64,
    /// By tape.
    pub tape: f64,
}

/// The unit and the girths of a `girths.json`, or what is wrong with it.
pub(super) fn read_girths(text: &str) -> Result<(Unit, Vec<ReadGirth>), String> {
    let file: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    let unit = match file["unit"] == RELATIVE {
        true => Unit::Relative,
        false => Unit::Metric,
    };
    let suffix = suffix(unit);
    let tape = format!("tape_{suffix}");
    let one = |girth: &Value| {
        let text = |key: &str| girth[key].as_str().map(str::to_owned);
        Some(ReadGirth {
            name: text("name")?,
            label: text("label")?,
            part: text("part"),
            contour: girth[suffix].as_f64()?,
            tape: girth[&tape].as_f64()?,
        })
    };
    let list = file["girths"].as_array().ok_or("it has no list `girths`")?;
    let whole = |girth: &Value| {
        let why = || format!("a girth has no `name`, `label`, `{suffix}` or `{tape}`");
        one(girth).ok_or_else(why)
    };
    Ok((unit, list.iter().map(whole).collect::<Result<_, _>>()?))
}

/// What keys end in.
pub(super) fn suffix(unit: Unit) -> &'static str {
    match unit {
        Unit::Metric => "cm",
        Unit::Relative => "rel",
    }
}
