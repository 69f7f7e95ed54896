//! A person over time as Markdown, CSV and JSON.

use super::change::{Change, Followed};
use crate::table::{self, Table};
use follow::PARTS;
use serde_json::{Value, json};
use shape::Part;
use std::fmt::Write;

/// What the words of the tables mean.
pub(super) const LEGEND: &str = "Tapes are at the level of the first capture, carried to the other captures by laying the first body on each. ± contains the true change nine times in ten. \
    LSC: least significant change, what measuring the same body twice exceeds one time in twenty; * marks what exceeds it.";

/// The note where nobody measured what repetition gives.
pub(super) const BY_CAPTURES: &str = "LSC is made of what captures report of themselves, which contains errors that all of them share: it is wide. Measure what repetition gives with \
    `tailor repeat --same-level`, and hand that over with --repeat.";

pub(super) fn word(part: Part) -> &'static str {
    match part {
        Part::Head => "head",
        Part::Trunk => "trunk",
        Part::ArmLeft => "left arm",
        Part::ArmRight => "right arm",
        Part::LegLeft => "left leg",
        Part::LegRight => "right leg",
    }
}

/// What a capture is headed by: its day, else its name.
pub(super) fn heads(followed: &Followed) -> Vec<String> {
    followed
        .days
        .iter()
        .map(|d| d.day.clone().unwrap_or_else(|| d.name.clone()))
        .collect()
}

fn cell(change: &Change) -> String {
    match (&change.tape_mm, change.change_mm) {
        (Err(why), _) => format!("none: {}", why.code()),
        (Ok(tape), None) => format!("{:.1}", tape / 10.0),
        (Ok(tape), Some(off)) => {
            let reach = change
                .interval_mm
                .map(|[low, high]| format!(" ± {:.1}", (high - low) / 2.0));
            let mark = if change.changed == Some(true) {
                " *"
            } else {
                ""
            };
            format!(
                "{:.1} ({off:+.1}{} mm){mark}",
                tape / 10.0,
                reach.unwrap_or_default()
            )
        }
    }
}

pub(super) fn girth_table(followed: &Followed) -> Table {
    let mut head = vec!["girth [cm]".to_owned()];
    head.extend(heads(followed));
    head.push("LSC [mm]".into());
    let mut table = vec![head];
    for line in &followed.lines {
        let mut row = vec![format!("{} ({})", line.name, line.label)];
        row.extend(
            line.at
                .iter()
                .enumerate()
                .map(|(i, c)| match (i, &c.tape_mm) {
                    (0, Ok(tape)) => format!("{:.1}", tape / 10.0),
                    _ => cell(c),
                }),
        );
        let least = line
            .at
            .iter()
            .filter_map(|c| c.least_change_mm)
            .reduce(f64::max);
        row.push(least.map_or("-".into(), |mm| format!("{mm:.1}")));
        table.push(row);
    }
    table
}

pub(super) fn volume_table(followed: &Followed) -> Table {
    let mut head = vec!["volume [l]".to_owned()];
    head.extend(heads(followed));
    let mut table = vec![head];
    for (i, part) in PARTS.into_iter().enumerate() {
        let mut row = vec![word(part).to_owned()];
        row.extend(
            followed
                .days
                .iter()
                .map(|d| format!("{:.2}", d.volumes_l[i])),
        );
        table.push(row);
    }
    let mut row = vec!["all".to_owned()];
    row.extend(
        followed
            .days
            .iter()
            .map(|d| format!("{:.2}", d.volumes_l.iter().sum::<f64>())),
    );
    table.push(row);
    table
}

/// All of it, as Markdown.
pub fn markdown(followed: &Followed) -> String {
    let mut text = format!(
        "# {}\n\n{}\n{LEGEND}\n\n{}",
        followed.person,
        table::markdown(&girth_table(followed)),
        table::markdown(&volume_table(followed))
    );
    if followed.by_captures {
        let _ = write!(text, "\n{BY_CAPTURES}\n");
    }
    for warning in &followed.warnings {
        let _ = write!(text, "\nWarning: {warning}.\n");
    }
    text
}

/// A table for a spreadsheet (RFC 4180): a girth on a day a row; millimetres, empty where unknown.
pub fn csv(followed: &Followed) -> String {
    let head = "person,capture,date,name,label,tape_mm,own_tape_mm,change_mm,change_low_mm,change_high_mm,lsc95_mm,changed";
    let mut table: Table = vec![head.split(',').map(String::from).collect()];
    let cell = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.2}"));
    for line in &followed.lines {
        for (day, c) in followed.days.iter().zip(&line.at) {
            let ends = c.interval_mm;
            let numbers = [
                c.tape_mm.ok(),
                c.own_mm,
                c.change_mm,
                ends.map(|e| e[0]),
                ends.map(|e| e[1]),
                c.least_change_mm,
            ];
            let date = day.day.clone().unwrap_or_default();
            let mut row = vec![followed.person.clone(), day.name.clone(), date];
            row.extend([line.name.clone(), line.label.clone()]);
            row.extend(numbers.map(cell));
            row.push(
                c.changed
                    .map_or("", |c| if c { "yes" } else { "no" })
                    .into(),
            );
            table.push(row);
        }
    }
    shape::csv_table(table)
}

/// The same for other programs.
pub fn json(followed: &Followed) -> Value {
    let day = |d: &super::change::Day| {
        let volumes = PARTS
            .iter()
            .zip(&d.volumes_l)
            .map(|(p, v)| (word(*p).to_owned(), json!(v)));
        json!({
            "capture": d.name, "date": d.day, "stature_mm": d.stature_mm, "volume_l": volumes.collect::<serde_json::Map<_, _>>(),
            "turned_deg": d.turned_deg, "median_growth_mm": d.growth_mm, "somebody_else": d.doubts.iter().map(ToString::to_string).collect::<Vec<_>>(),
        })
    };
    let one = |c: &Change| {
        json!({
            "tape_mm": c.tape_mm.ok(), "reason": c.tape_mm.err().map(|r| r.code()), "own_tape_mm": c.own_mm, "change_mm": c.change_mm,
            "change_interval_mm": c.interval_mm, "lsc95_mm": c.least_change_mm, "changed": c.changed,
        })
    };
    let line = |l: &super::change::Line| json!({ "name": l.name, "label": l.label, "at": l.at.iter().map(one).collect::<Vec<_>>() });
    json!({
        "program": concat!("tailor ", env!("CARGO_PKG_VERSION")),
        "person": followed.person,
        "captures": followed.days.iter().map(day).collect::<Vec<_>>(),
        "girths": followed.lines.iter().map(line).collect::<Vec<_>>(),
        "warnings": followed.warnings,
    })
}
