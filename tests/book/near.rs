//! The front page: short, and its table of how near results come, with strangers in it.

use super::figures::{digits, held_out, json};
use super::read;
use super::tables::{TRUNK, at_planes, between, hold, number};
use std::fmt::Write;

/// Words of the front page, as `wc` counts them: a screen and a half.
const MOST_WORDS: usize = 700;

/// Scans that nobody looked at while anything was made (docs/lab/phone.md).
const STRANGERS: [&str; 2] = ["s24", "s26"];

/// The least and the most, in millimetres.
pub(crate) fn millimetres(all: &[f64]) -> String {
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    format!("{least:.1} to {most:.1} mm")
}

#[test]
fn how_near_results_come() {
    let mut table = String::from(
        "| | tapes of the trunk, at their place | surface of the trunk, mean |\n|---|---|---|\n",
    );
    let bodies = json("docs/tables/bodies.json");
    let tuned = ["man", "woman"].map(|name| &bodies["captures"][name]["score"]);
    let tapes = tuned.iter().flat_map(|score| at_planes(score, &TRUNK));
    let surface = tuned.map(|score| number(&score["mesh"]["trunk"]["accuracy_mean_mm"]));
    let _ = writeln!(
        table,
        "| two made bodies that the program was tuned on | {} | {} |",
        between(tapes.collect(), 1),
        millimetres(&surface)
    );
    let scans = json("docs/tables/scans.json");
    let rows = STRANGERS
        .iter()
        .flat_map(|scan| scans["scans"][*scan].as_array().unwrap());
    let rows: Vec<_> = rows.collect();
    let tape = |row: &&serde_json::Value| {
        TRUNK
            .map(|name| row["tape_pct"][name].as_f64())
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
    };
    let tapes = rows.iter().flat_map(tape);
    let surface: Vec<f64> = rows.iter().map(|row| number(&row["trunk_mm"])).collect();
    let _ = writeln!(
        table,
        "| **two strangers**: scans of people, not looked at before, through all faults of a phone, no mat | {} | {} |",
        between(tapes.collect(), 1),
        millimetres(&surface)
    );
    let model = toml::from_str(&read("models/levels-1.toml")).unwrap();
    let waist = held_out(&model, "survey", "waist");
    let _ = writeln!(
        table,
        "| where the tape goes: waists of {:.0} bodies left out of the fit | {} % in the middle, {} % for nine in ten | |",
        waist("bodies"),
        digits(waist("tape_middle_percent")),
        digits(waist("tape_nine_in_ten_percent")),
    );
    let by = |data: &serde_json::Value| {
        [&data["program"], &data["date"]].map(|text| text.as_str().unwrap().to_owned())
    };
    let ([one, on], [other, then]) = (by(&bodies), by(&scans));
    let _ = writeln!(table, "\n*Bodies: {one}, {on}; scans: {other}, {then}.*");
    hold("README.md", "near", &table);
}

#[test]
fn the_front_page_is_a_screen_and_a_half() {
    let words = read("README.md").split_whitespace().count();
    assert!(words <= MOST_WORDS, "README.md has {words} words");
}
