//! How time and memory grow: the tables of `docs/tables/growth.json`.

use super::read;
use super::tables::{hold, made_with, number};
use serde_json::Value;
use std::fmt::Write;

#[test]
fn time_and_memory_over_photos_pixels_and_faces() {
    let data: Value = serde_json::from_str(&read("docs/tables/growth.json")).unwrap();
    let mut table = String::from(
        "| | by the clock, s | of the processor, s | memory, GB | faces |\n|---|---|---|---|---|\n",
    );
    for (over, key, unit) in [
        ("photos", "photos", " photos of 1.5 megapixels"),
        ("megapixels", "megapixels", " megapixels, 18 photos"),
        ("faces", "edge_px", " px edges, 18 photos of 1.5 megapixels"),
    ] {
        for row in data["rows"][over].as_array().unwrap() {
            let of = |key: &str| number(&row[key]);
            let _ = writeln!(
                table,
                "| {}{unit} | {:.0} | {:.0} | {:.2} | {:.0} 000 |",
                row[key],
                of("seconds"),
                of("processor_s"),
                of("peak_gb"),
                of("faces") / 1000.0,
            );
        }
    }
    let _ = writeln!(
        table,
        "\n| grows as the power of | time of the processor | memory |\n|---|---|---|"
    );
    for over in ["photos", "megapixels", "faces"] {
        let of = |what: &str| number(&data["exponents"][over][what]);
        let (time, memory) = (of("processor_s"), of("peak_gb"));
        let _ = writeln!(table, "| {over} | {time:.2} | {memory:.2} |");
    }
    table += &made_with(&data, &["program", "date", "machine"]);
    hold("docs/performance.md", "growth", &table);
}
