//! Many captures: their table, all measured one after the other, their girths as one CSV.

use super::app::App;
use super::pages::home::Line;
use super::work;
use crate::cli::cohort;
use serde_json::Value;
use std::sync::Arc;

/// Every capture, the newest first.
pub(super) fn lines(app: &App) -> Vec<Line> {
    let all = app.home.all().into_iter();
    all.map(|(place, record)| {
        let state = app.jobs.progress(&place).state;
        let girths = place.girths(state);
        Line {
            place,
            record,
            state,
            girths,
        }
    })
    .collect()
}

/// Measures every capture that was not, the oldest first; what is wrong with one stands on its page.
pub(super) fn measure(app: &Arc<App>) {
    for line in lines(app).into_iter().rev() {
        if ["none", "stopped", "interrupted"].contains(&line.state) && !line.record.files.is_empty()
        {
            let _ = work::measure(app, &line.place);
        }
    }
}

/// A cell that no spreadsheet takes for a formula.
fn cell(text: &str) -> String {
    match text.starts_with(['=', '+', '-', '@', '\t']) {
        true => cohort::cell(&format!("'{text}")),
        false => cohort::cell(text),
    }
}

/// One girth of one capture a row; lengths of captures without a scale have `relative` for a unit.
pub(super) fn csv(lines: &[Line]) -> String {
    let mut csv = "capture,id,begun,name,label,unit,tape,interval_low,interval_high\n".to_owned();
    for line in lines {
        let Some(girths) = &line.girths else { continue };
        let relative = girths["unit"] == "relative";
        let (unit, suffix) = if relative {
            ("relative", "rel")
        } else {
            ("cm", "cm")
        };
        for girth in girths["girths"].as_array().into_iter().flatten() {
            let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
            let number = |value: &Value| value.as_f64().map_or(String::new(), |n| n.to_string());
            let interval = &girth[&format!("interval_{suffix}")];
            let cells = [
                cell(&line.record.name),
                line.place.id.clone(),
                line.record.begun.to_string(),
                cell(&text(&girth["name"])),
                cell(&text(&girth["label"])),
                unit.to_owned(),
                number(&girth[&format!("tape_{suffix}")]),
                number(&interval[0]),
                number(&interval[1]),
            ];
            csv += &(cells.join(",") + "\n");
        }
    }
    csv
}

#[cfg(test)]
mod tests {
    use super::cell;

    #[test]
    fn no_name_becomes_a_formula_or_another_cell() {
        assert_eq!(cell("=1+1"), "'=1+1");
        assert_eq!(cell("a,\"b\""), "\"a,\"\"b\"\"\"");
        assert_eq!(cell("Anna"), "Anna");
    }
}
