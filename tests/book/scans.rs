//! The table of surfaces of people through a phone, from what `docs/tables/scans.py` wrote.

use super::figures::json;
use super::tables::{hold, made_with, signed};
use serde_json::Value;
use std::fmt::Write;

/// Tapes that share a column.
const COLUMNS: [(&str, &[&str]); 7] = [
    ("waist; narrowest", &["WC", "WC_narrowest"]),
    ("navel; hip bone", &["WC_navel", "WC_hip_bone"]),
    ("hip; widest", &["HC", "HC_max"]),
    ("chest", &["CC"]),
    ("neck", &["NC"]),
    ("thighs", &["TC_L", "TC_R"]),
    ("calves", &["CFC_L", "CFC_R"]),
];

/// One row a capture: masks, tapes at their planes against the true surface's, size and trunk.
fn scans(data: &Value) -> String {
    let mut table = String::from("| scan | mat; plate | masks: IoU, least | lost; kept |");
    COLUMNS
        .iter()
        .for_each(|(name, _)| table += &format!(" {name} |"));
    table += " size | trunk [mm] |\n|---|---|---|---|";
    COLUMNS.iter().for_each(|_| table += "---|");
    table += "---|---|\n";
    for (scan, rows) in data["scans"].as_object().unwrap() {
        for row in rows.as_array().unwrap() {
            let [mat, plate] = ["mat", "plate"].map(|key| match row[key] == true {
                true => key,
                false => "–",
            });
            let _ = write!(table, "| {scan} | {mat}; {plate} |");
            if let Some(why) = row["failed"].as_str() {
                let _ = writeln!(table, " {} |", why.replace('|', "/"));
                continue;
            }
            let number = |key: &str| row["masks"][key].as_f64().unwrap();
            let (iou, least) = (number("iou"), number("least_iou"));
            let (lost, kept) = (number("lost_pct"), number("kept_pct"));
            let _ = write!(table, " {iou:.3}, {least:.3} | {lost:.1}; {kept:.1} |");
            let percent = |value: &Value| match value.as_f64() {
                Some(x) => signed(&format!("{x:+.1}")),
                None => "–".into(),
            };
            for (_, names) in COLUMNS {
                let cells: Vec<String> = names
                    .iter()
                    .map(|name| percent(&row["tape_pct"][name]))
                    .collect();
                let _ = write!(table, " {} |", cells.join("; "));
            }
            let size = match row["mat"] == true {
                true => "held".into(),
                false => percent(&row["size_pct"]),
            };
            let trunk = row["trunk_mm"].as_f64().unwrap();
            let _ = writeln!(table, " {size} | {trunk:.2} |");
        }
    }
    table + &made_with(data, &["program", "date"])
}

#[test]
fn what_comes_of_people_through_a_phone() {
    let table = scans(&json("docs/tables/scans.json"));
    hold("docs/lab/phone.md", "scans", &table);
}
