//! A sweep as one page: its table, each number over each param, and all of them side by side.

use super::row::Row;
use super::table::{cell, columns, params, short, summary, trouble};
use crate::page;
use serde_json::json;

const SCRIPT: &str = include_str!("page.js");

/// The page.
pub fn page(name: &str, about: &str, rows: &[Row]) -> String {
    let columns = columns(rows);
    let heads: Vec<String> = rows
        .first()
        .map_or(vec![], params)
        .into_iter()
        .map(|p| p.0)
        .collect();
    let metrics: Vec<String> = columns
        .iter()
        .map(|(name, unit)| match unit.is_empty() {
            true => name.clone(),
            false => format!("{name} [{unit}]"),
        })
        .collect();
    let mut head = heads.clone();
    head.extend(metrics.iter().cloned());
    head.extend(["made", "time", "trouble"].map(String::from));
    let line = |row: &Row| {
        let mut line: Vec<String> = params(row).into_iter().map(|p| p.1).collect();
        line.extend(
            columns
                .iter()
                .map(|(n, _)| cell(row, n).map_or(String::new(), short)),
        );
        line.extend([row.made.to_string(), format!("{:.1} s", row.seconds)]);
        line.push(trouble(row).unwrap_or_default());
        line
    };
    let lines: Vec<Vec<String>> = rows.iter().map(line).collect();
    let data = json!({
        "params": heads, "metrics": metrics,
        "rows": rows.iter().map(|r| json!({
            "name": r.point.name(name),
            "params": params(r).into_iter().map(|p| p.1).collect::<Vec<_>>(),
            "metrics": columns.iter().map(|(n, _)| cell(r, n)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
    });
    let title = if about.is_empty() { name } else { about };
    let body = format!(
        "<h1>{}</h1>\n<p class=\"soft\">sweep <code>{}</code>; {}</p>\n\
         <section><h2>Each number over each param</h2><p id=\"legend\" class=\"soft\"></p><div id=\"view\" class=\"plots\"></div></section>\n\
         <section><h2>All side by side</h2><div id=\"parallel\"></div></section>\n\
         <section><h2>All points</h2>{}</section>",
        page::escaped(title),
        page::escaped(name),
        page::escaped(&summary(rows)),
        page::table("points", &head, &lines),
    );
    page::page(title, &body, &data, SCRIPT)
}
