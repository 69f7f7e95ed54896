//! Several results as text: the paper's Tables I and II with ours beside, and the limits of ISO 20685-1.

use super::table::line;
use crate::reader::Reader;
use crate::score::Score;
use shape::GirthId;
use stage::message;
use std::fmt::Write;

stage::messages! {
    COUNT = "score-count": "{count} of {all}";
    FAIL_ALL = "score-fail-all": "FAIL: {within} of {all} in {mm} mm";
    ISO = "score-iso": "tape      error %         error mm        ISO 20685-1           interval holds the truth";
    PAPER_HEAD = "score-paper": "relative error %   ours            paper, Table I   paper, Table II";
    PASS_ALL = "score-pass-all": "pass: {within} of {all} in {mm} mm";
}

/// What a row of the paper's tables is of.
#[derive(Clone, Copy)]
enum PaperRow {
    Girth(GirthId),
    WaistToHip,
}

impl PaperRow {
    fn name(self) -> String {
        match self {
            PaperRow::Girth(id) => id.name(),
            PaperRow::WaistToHip => "WHR".into(),
        }
    }
}

/// The paper's relative errors, mean ± spread: Table I (mannequin) and Table II (human).
const PAPER: [(PaperRow, &str, &str); 6] = [
    (
        PaperRow::Girth(GirthId::Waist),
        "+3.17 ± 2.95",
        "-1.91 ± 2.99",
    ),
    (
        PaperRow::Girth(GirthId::Hip),
        "-0.95 ± 1.51",
        "+1.42 ± 3.17",
    ),
    (PaperRow::WaistToHip, "+4.14 ± 1.14", "-3.26 ± 2.76"),
    (
        PaperRow::Girth(GirthId::Neck),
        "+1.17 ± 4.75",
        "+4.56 ± 3.04",
    ),
    (
        PaperRow::Girth(GirthId::Chest),
        "+4.57 ± 1.47",
        "-3.24 ± 1.20",
    ),
    (PaperRow::Girth(GirthId::UpperArmMean), "–", "-4.31 ± 2.16"),
];

/// Relative errors over repeated runs, mean ± spread, beside those of the paper.
pub fn paper_tables(scores: &[Score], reader: &dyn Reader) -> String {
    let mut text = line(reader, &message!(PAPER_HEAD));
    for (row, first, second) in PAPER {
        let errors: Vec<f64> = scores.iter().filter_map(|s| error_pct(s, row)).collect();
        let (name, ours) = (row.name(), reader.number(spread(&errors)));
        let _ = writeln!(
            text,
            "{name:<18} {ours:<15} {:<16} {}",
            reader.number(first.to_owned()),
            reader.number(second.to_owned())
        );
    }
    text
}

/// Tapes over repeated runs: mean ± spread of their error, how often within the limit of ISO
/// 20685-1, and how often the interval holds the truth.
pub fn iso_table(scores: &[Score], reader: &dyn Reader) -> String {
    let mut text = line(reader, &message!(ISO));
    let names: std::collections::BTreeSet<&String> =
        scores.iter().flat_map(|s| s.girths.keys()).collect();
    for name in names {
        let all: Vec<_> = scores
            .iter()
            .filter_map(|s| s.girths.get(name)?.as_ref())
            .filter(|g| g.tape_error_mm.is_some())
            .collect();
        let Some(limit) = all.first().map(|g| g.iso_mm) else {
            continue;
        };
        let of = |value: fn(&crate::score::GirthScore) -> Option<f64>| {
            reader.number(spread(
                &all.iter().filter_map(|g| value(g)).collect::<Vec<_>>(),
            ))
        };
        let count = |holds: fn(&crate::score::GirthScore) -> Option<bool>| {
            all.iter().filter(|g| holds(g) == Some(true)).count()
        };
        let n = all.len();
        let within = count(|g| g.within_iso());
        let verdict = match within == n {
            true => message!(PASS_ALL, within = within, all = n, mm = limit),
            false => message!(FAIL_ALL, within = within, all = n, mm = limit),
        };
        let inside = message!(COUNT, count = count(|g| g.interval_holds), all = n);
        let _ = writeln!(
            text,
            "{name:<9} {:<15} {:<15} {:<21} {}",
            of(|g| g.tape_error_pct),
            of(|g| g.tape_error_mm),
            reader.message(&verdict),
            reader.message(&inside),
        );
    }
    text
}

/// Mean ± spread of repeated errors; one alone is itself.
fn spread(errors: &[f64]) -> String {
    match errors {
        [] => "–".into(),
        [one] => format!("{one:+.2}"),
        many => {
            let n = many.len() as f64;
            let mean = many.iter().sum::<f64>() / n;
            let square = many.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (n - 1.0);
            format!("{mean:+.2} ± {:.2}", square.sqrt())
        }
    }
}

/// The relative error of a girth's contour, or of the ratio of waist to hip.
fn error_pct(score: &Score, row: PaperRow) -> Option<f64> {
    let girth = |id: GirthId| score.girths.get(&id.name())?.as_ref();
    match row {
        PaperRow::Girth(id) => girth(id)?.error_pct,
        PaperRow::WaistToHip => {
            let (w, h) = (girth(GirthId::Waist)?, girth(GirthId::Hip)?);
            Some((w.cm? / h.cm? / (w.truth_cm / h.truth_cm) - 1.0) * 100.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reader::English;
    use crate::score::GirthScore;

    fn run(tape_mm: f64, cm: f64) -> Score {
        let girth = GirthScore {
            truth_cm: 100.0,
            cm: Some(cm),
            error_pct: Some(cm - 100.0),
            tape_error_pct: Some(tape_mm / 10.0),
            tape_error_mm: Some(tape_mm),
            interval_holds: Some(tape_mm.abs() < 8.0),
            iso_mm: 9.0,
            surface_mm: None,
            level_mm: None,
        };
        Score {
            cameras: None,
            masks: None,
            mesh: None,
            girths: [("WC".to_owned(), Some(girth)), ("NC".to_owned(), None)].into(),
            girths_at_measured_planes: Default::default(),
        }
    }

    #[test]
    fn repeated_runs_give_mean_and_spread_beside_the_papers() {
        let runs = [run(1.0, 101.0), run(-3.0, 99.0), run(11.0, 103.0)];
        let table = paper_tables(&runs, &English);
        let waist = table.lines().find(|l| l.starts_with("WC")).unwrap();
        assert!(
            waist.contains("+1.00 ± 2.00") && waist.contains("+3.17 ± 2.95"),
            "{waist}"
        );
        let neck = table.lines().find(|l| l.starts_with("NC")).unwrap();
        assert!(
            neck.contains('–') && neck.contains("+1.17 ± 4.75"),
            "{neck}"
        );
        let table = iso_table(&runs, &English);
        let waist = table.lines().find(|l| l.starts_with("WC")).unwrap();
        assert!(waist.contains("+3.00 ± 7.21"), "{waist}");
        assert!(waist.contains("FAIL: 2 of 3 in 9 mm"), "{waist}");
        assert!(waist.ends_with("2 of 3"), "{waist}");
        assert!(!table.contains("NC"), "what no run measured has no row");
        assert!(iso_table(&runs[..1], &English).contains("pass: 1 of 1"));
    }
}
