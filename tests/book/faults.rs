//! Tables of what a phone's faults cost, from what `docs/tables/faults.py` wrote.

use super::figures::json;
use super::tables::{hold, made_with, signed};
use serde_json::Value;
use std::fmt::Write;

/// What each fault changes against the same photos without one: surface; tape, and the scale where that is free.
fn faults(data: &Value) -> String {
    let (rows, clean) = (&data["rows"], &data["rows"]["clean"]);
    let shown = ["WC", "WC_narrowest", "WC_navel", "HC", "HC_max", "CC"];
    let scaled = data["free_scale"] == true;
    let percent = |x: f64| signed(&format!("{x:+.2}"));
    let mut table = String::from("| fault |");
    shown.iter().for_each(|g| table += &format!(" {g} |"));
    table += if scaled { " scale |" } else { "" };
    table += "\n|---|";
    shown.iter().for_each(|_| table += "---|");
    table += if scaled { "---|" } else { "" };
    table.push('\n');
    let open = || "–".to_owned();
    for (fault, row) in rows.as_object().unwrap() {
        let of = |row: &Value, what: &str, g: &str| row[what][g].as_f64();
        let cell = |g: &&str| {
            let surface = of(row, "surface_pct", g)
                .zip(of(clean, "surface_pct", g))
                .map(|(a, b)| percent(a - b));
            let tape = of(row, "tape_cm", g)
                .zip(of(clean, "tape_cm", g))
                .map(|(a, b)| percent(100.0 * (a / b - 1.0)));
            format!(
                " {}; {} |",
                surface.unwrap_or_else(open),
                tape.unwrap_or_else(open)
            )
        };
        if fault != "clean" {
            let mut cells: String = shown.iter().map(cell).collect();
            if scaled {
                let scale = row["scale_pct"].as_f64().zip(clean["scale_pct"].as_f64());
                let scale = scale.map(|(a, b)| percent(a - b));
                cells += &format!(" {} |", scale.unwrap_or_else(open));
            }
            let _ = writeln!(table, "| {fault} |{cells}");
        }
    }
    table + &made_with(data, &["program", "date"])
}

#[test]
fn what_a_phones_faults_cost_without_a_plate() {
    let with_mat = faults(&json("docs/tables/faults.json"));
    hold("docs/lab/phone.md", "faults", &with_mat);
    let no_mat = faults(&json("docs/tables/faults-no-mat.json"));
    hold("docs/lab/phone.md", "faults-no-mat", &no_mat);
}
