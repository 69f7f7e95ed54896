//! How often intervals hold on bodies that nothing was fitted to: the table of `docs/tables/strangers.json`.

use super::figures::{digits, json};
use super::tables::{hold, made_with, signed};
use serde_json::Value;
use std::fmt::Write;

/// A girth of one body that has an interval: error, half the interval's width, as shares of the truth, and whether it holds.
struct Judged {
    error: f64,
    half: f64,
    holds: bool,
}

fn judged(row: &Value) -> Option<Judged> {
    let of = |key: &str| row[key].as_f64();
    let (tape, low, high, truth) = (of("tape")?, of("low")?, of("high")?, of("truth")?);
    // What an eye that sets a level leaves open is granted.
    let ends = row["ends"].as_array().into_iter().flatten();
    let truths: Vec<f64> = ends.filter_map(Value::as_f64).chain([truth]).collect();
    let least = truths.iter().copied().fold(f64::MAX, f64::min);
    let most = truths.iter().copied().fold(f64::MIN, f64::max);
    Some(Judged {
        error: tape / truth - 1.0,
        half: (high - low) / 2.0 / truth,
        holds: low <= most && least <= high,
    })
}

fn cells(rows: &[&Value]) -> String {
    let judged: Vec<Judged> = rows.iter().filter_map(|row| judged(row)).collect();
    let n = judged.len() as f64;
    let mut off: Vec<f64> = judged.iter().map(|j| 100.0 * j.error.abs()).collect();
    off.sort_by(f64::total_cmp);
    let at = |q: f64| off[((off.len() - 1) as f64 * q) as usize];
    let mean = |of: fn(&Judged) -> f64| 100.0 * judged.iter().map(of).sum::<f64>() / n;
    let share = judged.iter().filter(|j| j.holds).count() as f64 / n;
    let levels: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["level"].as_f64())
        .collect();
    let level = match levels.len() {
        0 => String::new(),
        n => {
            let mean = levels.iter().sum::<f64>() / n as f64;
            let square = levels.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / n as f64;
            format!("{}; {:.0}", signed(&format!("{mean:+.0}")), square.sqrt())
        }
    };
    let people: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["people"].as_f64())
        .collect();
    let of_people = match people.len() {
        0 => String::new(),
        n => {
            let near = people.iter().filter(|off| off.abs() < 1.645).count();
            format!("{:.2}", near as f64 / n as f64)
        }
    };
    format!(
        "{} of {} | {level} | {} | {}; {} | {} | {share:.2} | {of_people} |",
        judged.len(),
        rows.len(),
        signed(&format!("{:+.2}", mean(|j| j.error))),
        digits(at(0.5)),
        digits(at(0.9)),
        digits(mean(|j| j.half)),
    )
}

#[test]
fn intervals_on_bodies_that_nothing_was_fitted_to() {
    let data = json("docs/tables/strangers.json");
    let of = |all: &str, names: &[&str]| -> Vec<Value> {
        let all = data[all].as_array().unwrap().iter();
        let rows = all.flat_map(|body| body["rows"].as_array().unwrap());
        let ours = |row: &&Value| names.iter().any(|n| row["girth"] == *n);
        rows.filter(ours).cloned().collect()
    };
    let mut table = String::from(
        "| | given | level, mean; deviation, mm | tape, mean, % | middle; nine in ten, % | half an interval, % | 90 % interval holds | the survey's would |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (head, all, names) in [
        ("hip", "bodies", &["HC"][..]),
        ("chest (the rig's nipples)", "bodies", &["CC"]),
        ("waist at the navel (the rig's)", "bodies", &["WC_navel"]),
        ("neck (the rig's plane)", "bodies", &["NC"]),
        (
            "neck (as a tape comes to rest at the rig's larynx)",
            "bodies",
            &["NC_rest"],
        ),
        ("upper arm (the rig's plane)", "bodies", &["AC_L", "AC_R"]),
        (
            "upper arm (as a tape comes to rest at the rig's place)",
            "bodies",
            &["AC_rest"],
        ),
        ("thigh", "bodies", &["TC_L", "TC_R"]),
        ("calf", "bodies", &["CFC_L", "CFC_R"]),
        ("waist, scans", "scans", &["WC"]),
        ("chest, scans", "scans", &["CC"]),
    ] {
        let rows = of(all, names);
        let _ = writeln!(
            table,
            "| {head} | {}",
            cells(&rows.iter().collect::<Vec<_>>())
        );
    }
    table += &made_with(&data, &["program", "date"]);
    hold("docs/lab/girths.md", "strangers", &table);
}
