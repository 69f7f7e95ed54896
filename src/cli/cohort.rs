//! Many captures, one table: a row a capture, what failed with its reason.

use super::measuring::Measured;
use super::provenance::{get, warnings};
use command::{Fault, Ran};
use serde_json::{Value, json};
use shape::{Cameras, Girths, Scale, Unit, csv_table};
use stage::Message;
use std::path::Path;
use std::sync::Arc;
use tables::aligned::{lines, table, to_the_right};

/// What came of a capture.
pub(super) struct Row {
    /// The folder or video, as it was given.
    pub(super) capture: String,
    out: String,
    came: Result<Came, String>,
}

/// What was measured, and how far it can be trusted.
struct Came {
    girths: Arc<Girths>,
    scale: Scale,
    warnings: Vec<Message>,
}

impl Row {
    /// Of a run that came to its end.
    pub(super) fn measured(capture: &Path, measured: &Measured) -> Row {
        let (graph, outcome) = (&measured.graph, &measured.outcome);
        let girths = get::<Girths>(graph, outcome, "girths");
        let cameras = get::<Cameras>(graph, outcome, "cameras");
        let warnings = warnings(&Ran::of(graph, outcome, &[]), girths.as_deref());
        let came = girths.zip(cameras).map(|(girths, cameras)| Came {
            girths,
            scale: cameras.scale,
            warnings,
        });
        Row {
            capture: capture.display().to_string(),
            out: measured.out.display().to_string(),
            came: came.ok_or_else(|| "the pipeline makes no girths".to_owned()),
        }
    }

    /// Of a capture that came to nothing.
    pub(super) fn failed(capture: &Path, out: &Path, fault: &Fault) -> Row {
        // What to repeat is on the screen; a table has one line a reason.
        let why = fault.text().lines().next().unwrap_or_default();
        Row {
            capture: capture.display().to_string(),
            out: out.display().to_string(),
            came: Err(why.to_owned()),
        }
    }

    fn girths(&self) -> Option<&Girths> {
        self.came.as_ref().ok().map(|came| &*came.girths)
    }

    fn unit(&self) -> &'static str {
        match self.girths().map(|g| g.unit) {
            Some(Unit::Metric) => "cm",
            Some(Unit::Relative) => "relative",
            None => "",
        }
    }

    /// A length as files write it: centimetres, or against the radius of the camera ring.
    fn length(&self, mm: f64) -> String {
        match self.unit() {
            "relative" => format!("{:.5}", mm / 1000.0),
            _ => format!("{:.2}", mm / 10.0),
        }
    }
}

/// Where lengths come from, in a word.
fn origin(scale: Scale) -> &'static str {
    match scale {
        Scale::Mat => "mat",
        Scale::Tags => "tags",
        Scale::Reference => "reference",
        Scale::Disk => "disk",
        Scale::Stature => "stature",
        Scale::Given => "cameras",
        Scale::Nothing => "none",
        Scale::Disputed(_) => "disputed",
    }
}

/// The names of all girths that some capture has, in the order of the first that has each.
fn names(rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for girth in rows.iter().filter_map(Row::girths).flat_map(|g| &g.girths) {
        if !names.contains(&girth.name) {
            names.push(girth.name.clone());
        }
    }
    names
}

/// One line a capture: tapes with their intervals, scale, what was warned of, why there is nothing.
pub(super) fn csv(rows: &[Row]) -> Vec<u8> {
    let names = names(rows);
    let mut head: Vec<String> = ["capture", "unit", "scale", "stature"]
        .map(String::from)
        .into();
    for name in &names {
        head.extend([name.clone(), format!("{name}_lo"), format!("{name}_hi")]);
    }
    head.extend(["missing", "warnings", "trouble"].map(String::from));
    let mut all = vec![head];
    for row in rows {
        let scale = row.came.as_ref().map_or("", |came| origin(came.scale));
        let mm = |mm: Option<f64>| mm.map_or(String::new(), |mm| row.length(mm));
        let mut line = vec![row.capture.clone(), row.unit().into(), scale.into()];
        line.push(mm(row.girths().and_then(|g| g.stature_mm)));
        for name in &names {
            let girth = row.girths().and_then(|g| g.get(name));
            let interval = girth.and_then(|g| g.interval_mm);
            line.push(mm(girth.map(|g| g.tape_mm)));
            line.extend([mm(interval.map(|i| i[0])), mm(interval.map(|i| i[1]))]);
        }
        let missing = row
            .girths()
            .map(|g| g.missing.iter().map(|m| m.name.as_str()));
        line.push(missing.map_or(String::new(), |m| m.collect::<Vec<_>>().join(" ")));
        line.push(row.came.as_ref().map_or(String::new(), |c| {
            let all: Vec<&str> = c.warnings.iter().map(|w| w.as_str()).collect();
            all.join("; ")
        }));
        line.push(row.came.as_ref().err().cloned().unwrap_or_default());
        all.push(line);
    }
    csv_table(all).into_bytes()
}

/// For other programs: each capture as `girths.json` has it would be too much; what the table has.
pub(super) fn json(row: &Row) -> Value {
    let came = match &row.came {
        Ok(came) => came,
        Err(why) => return json!({ "capture": row.capture, "done": false, "why": why }),
    };
    let length = |mm: f64| row.length(mm).parse::<f64>().expect("bug: a number");
    let girth = |g: &shape::Girth| {
        let interval = g.interval_mm.map(|i| i.map(length));
        json!({ "name": g.name, "label": g.label, "tape": length(g.tape_mm), "interval": interval })
    };
    let missing = |m: &shape::Missing| json!({ "name": m.name, "why": m.why });
    json!({
        "capture": row.capture, "out": row.out, "done": true, "unit": row.unit(),
        "scale": origin(came.scale),
        "stature": came.girths.stature_mm.map(length),
        "girths": came.girths.girths.iter().map(girth).collect::<Vec<_>>(),
        "missing": came.girths.missing.iter().map(missing).collect::<Vec<_>>(),
        "warnings": came.warnings,
    })
}

/// For people: tapes with half of their intervals, one line a capture.
pub(super) fn text(rows: &[Row]) -> String {
    let names = names(rows);
    let mut shown = table();
    let head = ["capture", "unit", "scale"].into_iter().map(String::from);
    let head = head.chain(names.iter().cloned());
    shown.add_row(head.chain(["warnings".to_owned(), String::new()]));
    for row in rows {
        let Ok(came) = &row.came else {
            let blank = (0..names.len() + 3).map(|_| "-".to_owned());
            let why = row.came.as_ref().err().cloned().unwrap_or_default();
            shown.add_row(
                std::iter::once(row.capture.clone())
                    .chain(blank)
                    .chain([why]),
            );
            continue;
        };
        let mut line = vec![
            row.capture.clone(),
            row.unit().into(),
            origin(came.scale).into(),
        ];
        for name in &names {
            line.push(came.girths.get(name).map_or("-".into(), |g| {
                let half = g.interval_mm.map(|i| row.length((i[1] - i[0]) / 2.0));
                let half = half.map_or(String::new(), |half| format!(" ± {half}"));
                row.length(g.tape_mm) + &half
            }));
        }
        line.extend([came.warnings.len().to_string(), String::new()]);
        shown.add_row(line);
    }
    (3..names.len() + 4).for_each(|column| to_the_right(&mut shown, column));
    lines(&mut shown)
}

#[cfg(test)]
#[path = "cohort_tests.rs"]
mod tests;
