//! A study of repeatability as Markdown, CSV and JSON.

use super::known::KNOWN;
use super::study::{GirthStudy, Study};
use crate::table::{self, Table};
use serde_json::{Value, json};
use std::fmt::Write;

/// What the words of the head mean.
pub(super) const LEGEND: &str = "TEM: technical error of measurement, one standard deviation of a measurement about the person's mean, with its 95 % interval; \
    0.03 mm at least, for files hold lengths to 0.1 mm. \
    RMS-CV: the same as a share of the length. LSC: least significant change of one capture against another, 2.77 TEM. \
    ICC(2,1): share of all variance that is between people. Allowed: most that the ANSUR II survey lets two trained measurers differ (NATICK/TR-11/017, appendix G).";

fn number(x: Option<f64>, digits: usize) -> String {
    x.map_or("-".into(), |x| format!("{x:.digits$}"))
}

pub(super) fn girth_table(study: &Study) -> Table {
    let head = [
        "girth",
        "people",
        "captures",
        "mean [mm]",
        "TEM [mm]",
        "95 %",
        "TEM [%]",
        "RMS-CV [%]",
        "LSC [mm]",
        "ICC(2,1)",
        "bias [mm]",
        "limits of agreement [mm]",
        "allowed [mm]",
    ];
    let mut table = vec![head.map(String::from).to_vec()];
    for g in &study.girths {
        let [low, high] = g.tem_interval;
        let limits = g.agreement.limits;
        let limits = limits.map_or("-".into(), |[a, b]| format!("{a:+.1} to {b:+.1}"));
        let again: Vec<_> = g.people.iter().filter(|p| p.1.len() > 1).collect();
        let count: usize = again.iter().map(|p| p.1.len()).sum();
        table.push(vec![
            format!("{} ({})", g.name, g.label),
            again.len().to_string(),
            count.to_string(),
            format!("{:.1}", g.mean),
            format!("{:.2}", g.tem),
            format!("{low:.2} to {high:.2}"),
            format!("{:.2}", 100.0 * g.tem / g.mean),
            format!("{:.2}", 100.0 * g.rms_cv),
            format!("{:.1}", g.least_change()),
            number(g.icc, 3),
            format!("{:+.1}", g.agreement.bias),
            limits,
            number(g.allowed, 0),
        ]);
    }
    table
}

pub(super) fn known_table() -> Table {
    let mut table = vec![["study", "with", "found"].map(String::from).to_vec()];
    table.extend(
        KNOWN
            .iter()
            .map(|k| [k.study, k.with, k.found].map(String::from).to_vec()),
    );
    table
}

/// People with their captures, one a line.
pub(super) fn people(study: &Study) -> Vec<String> {
    let line = |(person, of): &(String, Vec<String>)| format!("{person}: {}", of.join(", "));
    study.people.iter().map(line).collect()
}

/// All of it, as Markdown.
pub fn markdown(study: &Study) -> String {
    let mut text = String::from("# Repeatability\n\n");
    people(study)
        .iter()
        .for_each(|p| text += &format!("- {p}\n"));
    let _ = write!(
        text,
        "\n{}\n{LEGEND}\n",
        table::markdown(&girth_table(study))
    );
    for warning in &study.warnings {
        let _ = write!(text, "\nWarning: {warning}.\n");
    }
    let _ = write!(
        text,
        "\n## What other studies report\n\n{}",
        table::markdown(&known_table())
    );
    text
}

fn girth_json(g: &GirthStudy) -> Value {
    let people: Vec<Value> = g
        .people
        .iter()
        .map(|(p, t)| json!({ "person": p, "tape_mm": t }))
        .collect();
    json!({
        "name": g.name, "label": g.label, "mean_mm": g.mean, "degrees_of_freedom": g.freedom,
        "tem_mm": g.tem, "tem_interval_mm": g.tem_interval, "tem_pct": 100.0 * g.tem / g.mean, "rms_cv_pct": 100.0 * g.rms_cv,
        "lsc95_mm": g.least_change(), "icc_2_1": g.icc, "reliability": g.reliability,
        "bias_mm": g.agreement.bias, "limits_of_agreement_mm": g.agreement.limits, "allowed_mm": g.allowed,
        "pairs_mm": g.agreement.pairs, "people": people,
    })
}

/// The same for other programs.
pub fn json(study: &Study) -> Value {
    let people: Vec<Value> = study
        .people
        .iter()
        .map(|(p, of)| json!({ "person": p, "captures": of }))
        .collect();
    let known: Vec<Value> = KNOWN
        .iter()
        .map(|k| json!({ "study": k.study, "with": k.with, "found": k.found }))
        .collect();
    json!({
        "program": concat!("tailor ", env!("CARGO_PKG_VERSION")),
        "people": people,
        "repeatability": study.girths.iter().map(girth_json).collect::<Vec<_>>(),
        "warnings": study.warnings,
        "literature": known,
    })
}

/// A table for a spreadsheet (RFC 4180), one girth a row; millimetres and percent, empty where unknown.
pub fn csv(study: &Study) -> String {
    let head = "name,label,people,captures,mean_mm,degrees_of_freedom,tem_mm,tem_low_mm,tem_high_mm,tem_pct,rms_cv_pct,lsc95_mm,icc_2_1,reliability,bias_mm,limit_low_mm,limit_high_mm,allowed_mm";
    let mut table: Table = vec![head.split(',').map(String::from).collect()];
    let cell = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.4}"));
    for g in &study.girths {
        let again: Vec<_> = g.people.iter().filter(|p| p.1.len() > 1).collect();
        let count: usize = again.iter().map(|p| p.1.len()).sum();
        let limits = g.agreement.limits;
        let mut row = vec![g.name.clone(), g.label.clone()];
        row.extend([again.len().to_string(), count.to_string()]);
        row.extend([format!("{:.3}", g.mean), g.freedom.to_string()]);
        let numbers = [
            Some(g.tem),
            Some(g.tem_interval[0]),
            Some(g.tem_interval[1]),
            Some(100.0 * g.tem / g.mean),
            Some(100.0 * g.rms_cv),
            Some(g.least_change()),
            g.icc,
            g.reliability,
            Some(g.agreement.bias),
            limits.map(|l| l[0]),
            limits.map(|l| l[1]),
            g.allowed,
        ];
        row.extend(numbers.map(cell));
        table.push(row);
    }
    shape::csv_table(table)
}
