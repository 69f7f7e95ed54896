//! Scores as text: one result, and the paper's Tables I and II with ours beside.

use crate::score::{Part, Score};
use shape::GirthId;
use std::fmt::Write;

fn or_dash(value: Option<f64>, digits: usize) -> String {
    value.map_or("–".into(), |x| format!("{x:+.digits$}"))
}

/// One result, in plain lines.
pub fn text(score: &Score) -> String {
    let mut text = String::new();
    if let Some(c) = &score.cameras {
        let _ = writeln!(
            text,
            "cameras   {} of {}; scale {} %; centres {} mm median, {} mm worst; rotation {} °; focal {} %",
            c.registered,
            c.of,
            or_dash(c.scale_error_pct, 3),
            or_dash(c.centre_mm_median, 2),
            or_dash(c.centre_mm_max, 2),
            or_dash(c.rotation_deg_median, 3),
            or_dash(c.focal_error_pct, 3),
        );
    }
    if let Some(m) = &score.masks {
        let _ = writeln!(
            text,
            "masks     {} compared; intersection over union {:.4} mean, {:.4} worst",
            m.count, m.iou_mean, m.iou_min
        );
    }
    if let Some(m) = &score.mesh {
        let closed = if m.closed { "closed" } else { "NOT closed" };
        let _ = writeln!(text, "surface   {} faces, {closed}", m.faces);
        let mut part = |name: &str, p: &Part| {
            let _ = writeln!(
                text,
                "  {name:<7} {:.2} mm mean, 90 % within {:.2} mm, bias {:+.2} mm; complete {:.1} % at 2 mm, {:.1} % at 5 mm",
                p.accuracy_mean_mm,
                p.accuracy_90_mm,
                p.bias_mm,
                p.complete_2mm * 100.0,
                p.complete_5mm * 100.0,
            );
        };
        part("all", &m.all);
        if let Some(trunk) = &m.trunk {
            part("trunk", trunk);
        }
    }
    text += &girths(score);
    text += &at_planes(score);
    if text.is_empty() {
        text +=
            "nothing to compare: neither cameras, masks, a surface nor girths are on both sides\n";
    }
    text
}

/// The girths beside their truth.
fn girths(score: &Score) -> String {
    let mut text = String::new();
    if !score.girths.is_empty() {
        let _ = writeln!(
            text,
            "girth      truth cm      cm   error %   tape %  tape mm = surface + level  ISO 20685-1"
        );
        for (name, girth) in &score.girths {
            let Some(g) = girth else {
                let _ = writeln!(text, "{name:<8}  not measured");
                continue;
            };
            let iso = match g.within_iso() {
                Some(true) => format!("pass (±{} mm)", g.iso_mm),
                Some(false) => format!("FAIL (±{} mm)", g.iso_mm),
                None => "–".into(),
            };
            let outside = if g.interval_holds == Some(false) {
                "  outside its interval"
            } else {
                ""
            };
            let _ = writeln!(
                text,
                "{name:<8} {:>10.2} {:>7} {:>9} {:>8} {:>8} {:>9} {:>7}  {iso}{outside}",
                g.truth_cm,
                g.cm.map_or("–".into(), |cm| format!("{cm:.2}")),
                or_dash(g.error_pct, 2),
                or_dash(g.tape_error_pct, 2),
                or_dash(g.tape_error_mm, 1),
                or_dash(g.surface_mm, 1),
                or_dash(g.level_mm, 1),
            );
        }
    }
    text
}

/// Tapes against the true surface at the planes that were measured: what the surface errs.
fn at_planes(score: &Score) -> String {
    let mut text = String::new();
    if !score.girths_at_measured_planes.is_empty() {
        text += "tape at the measured plane   truth there cm  tape cm  surface %  surface mm\n";
    }
    for (name, plane) in &score.girths_at_measured_planes {
        let _ = match plane {
            Some(t) => writeln!(
                text,
                "{name:<24} {:>14.2} {:>8.2} {:>+10.2} {:>+11.1}",
                t.truth_there_cm, t.tape_cm, t.tape_pct, t.tape_mm
            ),
            None => writeln!(
                text,
                "{name:<24} the true surface has no such section there: limb and trunk are one, or the plane misses it"
            ),
        };
    }
    text
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
pub fn paper_tables(scores: &[Score]) -> String {
    let mut text =
        String::from("relative error %   ours            paper, Table I   paper, Table II\n");
    for (row, first, second) in PAPER {
        let errors: Vec<f64> = scores.iter().filter_map(|s| error_pct(s, row)).collect();
        let (name, ours) = (row.name(), spread(&errors));
        let _ = writeln!(text, "{name:<18} {ours:<15} {first:<16} {second}");
    }
    text
}

/// Tapes over repeated runs: mean ± spread of their error, how often within the limit of ISO
/// 20685-1, and how often the interval holds the truth.
pub fn iso_table(scores: &[Score]) -> String {
    let mut text = String::from(
        "tape      error %         error mm        ISO 20685-1           interval holds the truth\n",
    );
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
            spread(&all.iter().filter_map(|g| value(g)).collect::<Vec<_>>())
        };
        let count = |holds: fn(&crate::score::GirthScore) -> Option<bool>| {
            all.iter().filter(|g| holds(g) == Some(true)).count()
        };
        let n = all.len();
        let within = count(|g| g.within_iso());
        let verdict = match within == n {
            true => "pass",
            false => "FAIL",
        };
        let _ = writeln!(
            text,
            "{name:<9} {:<15} {:<15} {:<21} {} of {n}",
            of(|g| g.tape_error_pct),
            of(|g| g.tape_error_mm),
            format!("{verdict}: {within} of {n} in {limit} mm"),
            count(|g| g.interval_holds),
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
        let table = paper_tables(&runs);
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
        let table = iso_table(&runs);
        let waist = table.lines().find(|l| l.starts_with("WC")).unwrap();
        assert!(waist.contains("+3.00 ± 7.21"), "{waist}");
        assert!(waist.contains("FAIL: 2 of 3 in 9 mm"), "{waist}");
        assert!(waist.ends_with("2 of 3"), "{waist}");
        assert!(!table.contains("NC"), "what no run measured has no row");
        assert!(iso_table(&runs[..1]).contains("pass: 1 of 1"));
    }
}
