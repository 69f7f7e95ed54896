//! The table of girths as text: what docs and `tailor show girths --as definitions` print.

use shape::{GirthId, GirthSet, LevelRule, Measured, PlaneRule, TABLE};
use std::fmt::Write;

fn plane(rule: PlaneRule) -> &'static str {
    match rule {
        PlaneRule::Horizontal => "horizontal",
        PlaneRule::AcrossLimb => "across the limb",
        PlaneRule::AcrossNeck => "across the neck",
        PlaneRule::ThroughPoints => "through the points",
    }
}

fn level(rule: LevelRule) -> String {
    match rule {
        LevelRule::Greatest(low, high) => format!("longest tape, {low} to {high}"),
        LevelRule::Least(low, high) => format!("shortest tape, {low} to {high}"),
        LevelRule::Share { from, to, at } => format!("{at} of the way, {from} to {to}"),
        LevelRule::Mark(mark) => format!("on the surface: {mark}"),
        LevelRule::Model(place) => format!("a model's estimate: {place}"),
        LevelRule::Given => "as the user defines it".into(),
    }
}

fn set(set: GirthSet) -> &'static str {
    match set {
        GirthSet::Iso8559 => "iso8559",
        GirthSet::Who => "who",
        GirthSet::Ansur => "ansur",
        GirthSet::Paper => "paper",
    }
}

/// Every definition as a row of a Markdown table.
pub fn definitions_to_markdown() -> String {
    let mut text = String::from(
        "| name | what | where the tape is | standards | plane | level | two tapes agree within | sets |\n|---|---|---|---|---|---|---|---|\n",
    );
    for row in TABLE {
        let name = match (row.id, row.id.side()) {
            (GirthId::Own, _) => "your own".into(),
            (_, Some(_)) => format!("{0}_L, {0}_R", row.name),
            _ => row.name.to_owned(),
        };
        let length = match row.measured {
            Measured::Tape => "",
            Measured::Contour => " (along the skin)",
        };
        let sets: Vec<&str> = row.sets.iter().map(|s| set(*s)).collect();
        let (plane, level, limit) = (plane(row.plane), level(row.level), row.region.limit_mm());
        let (standards, sets) = (row.standards(), sets.join(", "));
        let (label, sentence) = (row.label, row.sentence);
        let _ = writeln!(
            text,
            "| {name} | {label} | {sentence}{length} | {standards} | {plane} | {level} | {limit} mm | {sets} |"
        );
    }
    text
}
