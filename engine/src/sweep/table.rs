//! The rows of a sweep as text, CSV and JSON.

use super::points::plain;
use super::row::{End, Row};
use crate::cli::text::count;
use serde_json::{Value, json};
use std::fmt::Write;

/// A column of a metric: its name and unit.
pub(super) fn columns(rows: &[Row]) -> Vec<(String, String)> {
    let mut columns: Vec<(String, String)> = Vec::new();
    for (name, metric) in rows.iter().flat_map(|r| &r.metrics) {
        let at = columns.iter().position(|(n, _)| n == name);
        let at = at.unwrap_or_else(|| {
            columns.push((name.clone(), String::new()));
            columns.len() - 1
        });
        if let Some(metric) = metric {
            columns[at].1 = metric.unit.clone();
        }
    }
    columns
}

/// What a row tells in a column.
pub(super) fn cell(row: &Row, column: &str) -> Option<f64> {
    let metric = row.metrics.iter().find(|(name, _)| name == column);
    metric.and_then(|(_, metric)| Some(metric.as_ref()?.value))
}

/// The params of a row as it names them, the variant first if there is one.
pub(super) fn params(row: &Row) -> Vec<(String, String)> {
    let variant = row
        .point
        .variant
        .iter()
        .map(|v| ("variant".to_owned(), v.clone()));
    let values = row.point.values.iter();
    variant
        .chain(values.map(|(n, p, v)| (format!("{n}.{p}"), plain(v))))
        .collect()
}

/// Why a row has no result.
pub(super) fn trouble(row: &Row) -> Option<String> {
    match &row.end {
        End::Done => None,
        End::Failed(node, why) => Some(format!("{node} failed: {why}")),
        End::Wrong(why) => Some(why.clone()),
        End::Stopped => Some("stopped".into()),
    }
}

/// A number with as many digits as tell something.
pub(crate) fn short(x: f64) -> String {
    match x.abs() {
        _ if x.fract() == 0.0 && x.abs() < 1e12 => format!("{x:.0}"),
        a if a >= 100.0 => format!("{x:.1}"),
        a if a >= 1.0 => format!("{x:.2}"),
        _ => format!("{x:.4}"),
    }
}

/// A table for people, and a line that sums up.
pub fn text(about: &str, rows: &[Row]) -> String {
    let columns = columns(rows);
    let named = rows.first().map_or(vec![], params);
    let texts = named.len();
    let failed = rows.iter().any(|r| r.end != End::Done);
    let units = columns.iter();
    let units = units.map(|(n, u)| format!("{n} {u}").trim_end().to_owned());
    let mut table = crate::cli::text::table();
    let head = named.into_iter().map(|p| p.0).chain(units);
    let head = head.chain(["made".to_owned(), "time".to_owned()]);
    table.add_row(head.chain(failed.then(String::new)));
    for row in rows {
        let number = |(name, _): &(String, String)| cell(row, name).map_or("-".into(), short);
        let mut line: Vec<String> = params(row).into_iter().map(|p| p.1).collect();
        line.extend(columns.iter().map(number));
        line.extend([row.made.to_string(), format!("{:.1} s", row.seconds)]);
        line.extend(failed.then(|| trouble(row).unwrap_or_default()));
        table.add_row(line);
    }
    for column in texts..texts + columns.len() + 2 {
        crate::cli::text::to_the_right(&mut table, column);
    }
    let mut text = String::new();
    if !about.is_empty() {
        let _ = writeln!(text, "{about}");
    }
    let _ = writeln!(text, "{}", crate::cli::text::lines(&mut table));
    let _ = writeln!(text, "{}", summary(rows));
    text
}

/// What it cost, and what it would have.
pub(super) fn summary(rows: &[Row]) -> String {
    let sum = |f: fn(&Row) -> f64| rows.iter().map(f).sum::<f64>();
    let failed = rows.iter().filter(|r| r.end != End::Done).count();
    let failed = match failed {
        0 => String::new(),
        n => format!(" ({n} without a result)"),
    };
    let (made, found) = rows
        .iter()
        .fold((0, 0), |(m, f), r| (m + r.made, f + r.found));
    format!(
        "{}{failed}: {} made in {:.1} s, {found} found; {:.1} s in all, {:.1} s of them while no stage ran; each point alone: {:.1} s",
        count(rows.len(), "point"),
        count(made, "result"),
        sum(|r| r.work),
        sum(|r| r.seconds),
        sum(|r| r.engine),
        sum(|r| r.alone),
    )
}

/// One line a point.
pub fn csv(rows: &[Row]) -> String {
    let columns = columns(rows);
    let mut head: Vec<String> = rows
        .first()
        .map_or(vec![], params)
        .into_iter()
        .map(|p| p.0)
        .collect();
    head.extend(
        columns
            .iter()
            .map(|(n, u)| format!("{n} {u}").trim_end().to_owned()),
    );
    head.extend(
        [
            "made",
            "found",
            "seconds",
            "engine_seconds",
            "alone_seconds",
            "trouble",
        ]
        .map(String::from),
    );
    let mut lines = vec![head];
    for row in rows {
        let mut line: Vec<String> = params(row).into_iter().map(|p| p.1).collect();
        line.extend(
            columns
                .iter()
                .map(|(n, _)| cell(row, n).map_or(String::new(), |x| x.to_string())),
        );
        line.extend([row.made.to_string(), row.found.to_string()]);
        line.extend([row.seconds, row.engine, row.alone].map(|s| format!("{s:.3}")));
        line.push(trouble(row).unwrap_or_default());
        lines.push(line);
    }
    let mut table = ::csv::Writer::from_writer(Vec::new());
    for line in lines {
        table
            .write_record(line)
            .expect("bug: a row of another length");
    }
    let bytes = table.into_inner().expect("bug: memory is full");
    String::from_utf8(bytes).expect("bug: texts are UTF-8")
}

/// For other programs.
pub fn json(program: &str, name: &str, about: &str, rows: &[Row]) -> Value {
    let row = |row: &Row| {
        let cell = |(name, metric): &(String, Option<stage::Metric>)| {
            let m = metric.as_ref();
            json!({ "name": name, "value": m.map(|m| m.value), "unit": m.map(|m| m.unit.clone()) })
        };
        let params = params(row).into_iter().map(|(k, v)| (k, Value::from(v)));
        json!({
            "point": row.point.name(name), "variant": row.point.variant, "set": row.point.sets(),
            "params": params.collect::<serde_json::Map<_, _>>(),
            "metrics": row.metrics.iter().map(cell).collect::<Vec<_>>(),
            "done": row.end == End::Done, "why": trouble(row),
            "made": row.made, "found": row.found, "seconds": row.seconds,
            "alone_seconds": row.alone, "work_seconds": row.work, "engine_seconds": row.engine,
        })
    };
    json!({
        "program": program, "sweep": name, "about": about,
        "points": rows.iter().map(row).collect::<Vec<_>>(), "summary": summary(rows),
    })
}
