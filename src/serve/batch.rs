//! Many captures: their table, all measured one after the other, their girths as one CSV.

use super::app::App;
use super::pages::home::Line;
use super::work;
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

/// Measures every capture that was not, the oldest first; what is wrong with one is on its page.
pub(super) fn measure(app: &Arc<App>) {
    for line in lines(app).into_iter().rev() {
        if ["none", "stopped", "interrupted"].contains(&line.state) && !line.record.files.is_empty()
        {
            let _ = work::measure(app, &line.place);
        }
    }
}

/// One girth of one capture a row; lengths of captures without a scale have `relative` for a unit.
pub(super) fn csv(lines: &[Line]) -> String {
    let head = [
        "capture",
        "id",
        "begun",
        "name",
        "label",
        "unit",
        "tape",
        "interval_low",
        "interval_high",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
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
            rows.push(vec![
                line.record.name.clone(),
                line.place.id.clone(),
                line.record.begun.to_string(),
                text(&girth["name"]),
                text(&girth["label"]),
                unit.to_owned(),
                number(&girth[&format!("tape_{suffix}")]),
                number(&interval[0]),
                number(&interval[1]),
            ]);
        }
    }
    shape::csv_table(rows)
}
