//! The table of people who turn on the spot, from what `docs/tables/turning.py` wrote.

use super::figures::json;
use super::tables::{hold, made_with, signed};
use serde_json::Value;
use std::fmt::Write;

/// One row a capture: azimuths, and tapes with their intervals against the surface's own.
fn turning(data: &Value) -> String {
    let mut table = String::from(
        "| scan | photos | azimuth: by outlines and features; by texture, too [°] | waist [%] | hip [%] |\n|---|---|---|---|---|\n",
    );
    for (scan, rows) in data["scans"].as_object().unwrap() {
        for row in rows.as_array().unwrap() {
            let size = row["size"].as_str().unwrap().replace('x', "×");
            if let Some(why) = row["failed"].as_str() {
                let _ = writeln!(table, "| {scan} | {size} | {} |", why.replace('|', "/"));
                continue;
            }
            let number = |key: &str| row[key].as_f64().map_or("–".into(), |n| format!("{n:.2}"));
            let tape = |name: &str| {
                let of = |k: usize| row["tape_pct"][name][k].as_f64();
                match (of(0), of(1), of(2)) {
                    (Some(off), Some(low), Some(high)) => format!(
                        "{}; {} to {}",
                        signed(&format!("{off:+.1}")),
                        signed(&format!("{low:+.1}")),
                        signed(&format!("{high:+.1}"))
                    ),
                    _ => "–".into(),
                }
            };
            let _ = writeln!(
                table,
                "| {scan} | {} of {size} | {}; {} | {} | {} |",
                row["photos"],
                number("first_azimuth_deg"),
                number("azimuth_deg"),
                tape("WC"),
                tape("HC")
            );
        }
    }
    table + &made_with(data, &["program", "date"])
}

#[test]
fn what_comes_of_people_who_turn_on_the_spot() {
    let table = turning(&json("docs/tables/turning.json"));
    hold("docs/lab/turning.md", "turning", &table);
}
