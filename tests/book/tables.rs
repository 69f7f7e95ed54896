//! Tables between marks in the pages are written from data: none is copied by hand.

use super::{place, read};
use serde_json::Value;
use shape::Refusal;
use std::fmt::Write;

/// Holds a page's part between marks to what it should be, or writes it there.
#[track_caller]
pub(crate) fn hold(page: &str, mark: &str, want: &str) {
    let text = read(page);
    let (open, close) = (format!("<!-- {mark} -->\n"), format!("<!-- /{mark} -->"));
    let begin = text
        .find(&open)
        .unwrap_or_else(|| panic!("{page}: no {open}"))
        + open.len();
    let end = begin
        + text[begin..]
            .find(&close)
            .unwrap_or_else(|| panic!("{page}: no {close}"));
    if std::env::var_os("TAILOR_BOOK").is_some_and(|v| v == "write") {
        let new = format!("{}{want}{}", &text[..begin], &text[end..]);
        std::fs::write(place(page), new).unwrap();
    } else {
        assert_eq!(
            &text[begin..end],
            want,
            "{page}: TAILOR_BOOK=write cargo test --release --test book"
        );
    }
}

#[test]
fn reasons_of_missing_girths() {
    let mut table = String::from("| reason | on the screen |\n|---|---|\n");
    for refusal in Refusal::ALL {
        let _ = writeln!(table, "| `{}` | {} |", refusal.code(), refusal.why());
    }
    hold("docs/report.md", "refusals", &table);
}

/// The captures of the table, with what heads their columns.
const BODIES: [(&str, &str); 3] = [
    ("mannequin", "mannequin"),
    ("man", "man, sways"),
    ("woman", "woman, sways, no mat"),
];

pub(crate) const TRUNK: [&str; 7] = [
    "WC",
    "WC_navel",
    "WC_hip_bone",
    "WC_narrowest",
    "HC",
    "HC_max",
    "CC",
];

pub(crate) fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no number: {value}"))
}

/// What the surface errs at the measured planes of girths that were measured. \[%\]
pub(crate) fn at_planes(score: &Value, names: &[&str]) -> Vec<f64> {
    let planes = &score["girths_at_measured_planes"];
    let one = |name: &&str| planes[*name]["tape_pct"].as_f64();
    names.iter().filter_map(one).collect()
}

fn trunk(score: &Value) -> String {
    between(at_planes(score, &TRUNK), 2)
}

/// The least and the most, with a sign. \[%\]
pub(crate) fn between(errors: Vec<f64>, digits: usize) -> String {
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let most = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    signed(&format!("{least:+.digits$} to {most:+.digits$} %"))
}

fn limbs(score: &Value) -> String {
    let worse = |names: &[&str]| {
        let errors = at_planes(score, names);
        let worst = errors
            .into_iter()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        worst.map_or("refused".to_owned(), |e| format!("{e:+.1}"))
    };
    let [arm, thigh, calf] = [["AC_L", "AC_R"], ["TC_L", "TC_R"], ["CFC_L", "CFC_R"]];
    signed(&format!(
        "{}; {}; {} %",
        worse(&arm),
        worse(&thigh),
        worse(&calf)
    ))
}

/// The line below a table: how its data came about.
pub(crate) fn made_with(data: &Value, keys: &[&str]) -> String {
    let printed: Vec<&str> = keys.iter().map(|k| data[*k].as_str().unwrap()).collect();
    format!("\n*{}.*\n", printed.join(", "))
}

/// With a true minus sign.
pub(crate) fn signed(text: &str) -> String {
    text.replace('-', "−")
}

#[test]
fn errors_and_times_of_three_bodies() {
    let data: Value = serde_json::from_str(&read("docs/tables/bodies.json")).unwrap();
    let of = |name: &str| &data["captures"][name];
    let row = |what: &str, cell: &dyn Fn(&Value) -> String| {
        let cells: Vec<String> = BODIES.iter().map(|(name, _)| cell(of(name))).collect();
        format!("| {what} | {} |\n", cells.join(" | "))
    };
    let heads: Vec<&str> = BODIES.iter().map(|(_, head)| *head).collect();
    let mut table = format!("| | {} |\n|---|---|---|---|\n", heads.join(" | "));
    table += &row("surface of the trunk: mean; 90 % within", &|c| {
        let trunk = &c["score"]["mesh"]["trunk"];
        let (mean, most) = (
            number(&trunk["accuracy_mean_mm"]),
            number(&trunk["accuracy_90_mm"]),
        );
        format!("{mean:.2}; {most:.2} mm")
    });
    table += &row(
        "trunk's tapes against the true surface at the same plane",
        &|c| trunk(&c["score"]),
    );
    table += &row("upper arms; thighs; calves, the worse side", &|c| {
        limbs(&c["score"])
    });
    table += &row("masks, IoU: mean; least", &|c| {
        let of = |key: &str| number(&c["score"]["masks"][key]);
        format!("{:.3}; {:.3}", of("iou_mean"), of("iou_min"))
    });
    table += &row("cameras: size of all; focal length", &|c| {
        let of = |key: &str| number(&c["score"]["cameras"][key]);
        let (size, focal) = (of("scale_error_pct"), of("focal_error_pct"));
        signed(&format!("{size:+.2}; {focal:+.2} %"))
    });
    table += &row("time; memory", &|c| {
        format!(
            "{:.0} s; {:.2} GB",
            number(&c["seconds"]),
            number(&c["peak_gb"])
        )
    });
    table += &made_with(&data, &["program", "date", "machine"]);
    hold("docs/accuracy.md", "bodies", &table);
}
