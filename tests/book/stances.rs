//! How alike the girths of one body come out in twelve stances: the table of `docs/tables/stances.json`.

use super::figures::{digits, json};
use super::tables::{hold, made_with};
use serde_json::Value;
use std::fmt::Write;

/// What of a girth is asked in all stances.
const GIRTHS: [(&str, &str); 11] = [
    ("hip", "HC"),
    ("waist", "WC"),
    ("waist at the navel", "WC_navel"),
    ("chest", "CC"),
    ("neck", "NC"),
    ("upper arm, left", "AC_L"),
    ("upper arm, right", "AC_R"),
    ("thigh, left", "TC_L"),
    ("thigh, right", "TC_R"),
    ("calf, left", "CFC_L"),
    ("calf, right", "CFC_R"),
];

/// How far the farthest is from the middle one, and how many are within a hundredth of it. \[%\]
fn spread(mut of: Vec<f64>) -> (f64, usize) {
    of.sort_by(f64::total_cmp);
    let Some(middle) = of.get(of.len() / 2).copied() else {
        return (0.0, 0);
    };
    let off: Vec<f64> = of
        .iter()
        .map(|t| 100.0 * (t / middle - 1.0).abs())
        .collect();
    let far = off.iter().copied().fold(0.0, f64::max);
    (far, off.iter().filter(|o| **o <= 1.0).count())
}

#[test]
fn girths_of_one_body_in_twelve_stances() {
    let data = json("docs/tables/stances.json");
    let stances = data["stances"].as_array().unwrap();
    let mut table = String::from(
        "| | given | within 1 % of their middle | farthest, % | farthest of the true tapes, % | missing |\n|---|---|---|---|---|---|\n",
    );
    for (head, name) in GIRTHS {
        let rows = stances.iter().filter_map(|stance| {
            let mut rows = stance["rows"].as_array().unwrap().iter();
            Some((&stance["stance"], rows.find(|r| r["girth"] == name)?))
        });
        let rows: Vec<(&Value, &Value)> = rows.collect();
        let all = |key: &str| {
            rows.iter()
                .filter_map(|(_, row)| row[key].as_f64())
                .collect()
        };
        let (tapes, truths): (Vec<f64>, Vec<f64>) = (all("tape"), all("truth"));
        let given = tapes.len();
        let ((far, near), truth) = (spread(tapes), spread(truths).0);
        let missing = rows.iter().filter_map(|(stance, row)| {
            let why = row["missing"].as_str()?;
            Some(format!("{}: `{why}`", stance.as_str()?.replace('_', " ")))
        });
        let missing: Vec<String> = missing.collect();
        let _ = writeln!(
            table,
            "| {head} | {given} of {} | {near} | {} | {} | {} |",
            rows.len(),
            digits(far),
            digits(truth),
            missing.join("; ")
        );
    }
    table += &made_with(&data, &["program", "date"]);
    hold("docs/lab/girths.md", "stances", &table);
}
