//! Girths as a table for a spreadsheet.

use crate::girths::{Written, rows};
use shape::{GirthId, Girths, Sigmas, csv_table};

/// What is the same for all girths of a capture: columns and cells.
fn of_capture(girths: &Girths, to: Written) -> (Vec<String>, Vec<String>) {
    let mut columns = ["capture", "date", "scale_sigma_pct"]
        .map(String::from)
        .to_vec();
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.4}"));
    let text = |t: &Option<String>| t.clone().unwrap_or_default();
    let percent = girths.scale_sigma.map(|share| 100.0 * share);
    let mut cells = vec![text(&girths.capture), text(&girths.date), number(percent)];
    for (name, mm) in [
        ("stature", girths.stature_mm),
        ("stature_sigma", girths.stature_sigma_mm),
    ] {
        columns.push(to.key(name));
        cells.push(to.cell(mm));
    }
    for (name, value) in [
        ("weight_kg", girths.weight_kg),
        ("bmi", girths.bmi),
        ("volume_l", girths.volume_l),
    ] {
        columns.push(name.into());
        cells.push(number(value));
    }
    for name in Girths::RATIOS {
        let ratio = girths.ratios.iter().find(|r| r.0 == name);
        columns.push(name.into());
        cells.push(number(ratio.map(|r| r.1)));
    }
    (columns, cells)
}

/// A table for a spreadsheet (RFC 4180): one girth a row, lengths as in [`crate::girths_to_json`], each row with what is known of
/// the capture, so that tables of several captures may be put under each other; what is missing has a row with a note and
/// no number.
pub fn girths_to_csv(girths: &Girths) -> String {
    let to = Written::of(girths.unit);
    let sigmas = Sigmas::default()
        .named()
        .map(|(name, _)| format!("sigma_{name}"));
    let lengths = [
        "tape",
        "interval_low",
        "interval_high",
        "",
        "spline",
        "height",
        "silhouette",
    ];
    let lengths = lengths.iter().map(|l| (*l).to_owned());
    let columns: Vec<String> = lengths
        .chain(sigmas)
        .chain(["repeat".to_owned()])
        .map(|l| match l.as_str() {
            "" => to.suffix.to_owned(),
            named => to.key(named),
        })
        .collect();
    let (of_all, capture_cells) = of_capture(girths, to);
    let named = ["name", "label"].map(String::from).into_iter();
    let head = named.chain(columns.iter().cloned()).chain(of_all);
    let mut table: Vec<Vec<String>> = vec![head.chain(["note".to_owned()]).collect()];
    for r in rows(girths) {
        let [low, high] = match r.interval_mm {
            Some(ends) => ends.map(Some),
            None => [None; 2],
        };
        let mut cells = vec![
            Some(r.tape_mm),
            low,
            high,
            Some(r.contour_mm),
            Some(r.spline_mm),
            r.plane.map(|p| p.point_mm[2]),
            r.silhouette_mm,
        ];
        cells.extend(r.sigmas.named().map(|(_, mm)| mm));
        cells.push(r.repeat_mm);
        let cells = cells.into_iter().map(|mm| to.cell(mm));
        let note = match r.id {
            GirthId::UpperArmMean => r.definition,
            _ => r.remarks.join("; "),
        };
        let row = [r.name, r.label].into_iter().chain(cells);
        table.push(
            row.chain(capture_cells.iter().cloned())
                .chain([note])
                .collect(),
        );
    }
    for missing in &girths.missing {
        let empty = std::iter::repeat_n(String::new(), columns.len() + 1);
        let row = [missing.name.clone()].into_iter().chain(empty);
        let row = row.chain(capture_cells.iter().cloned());
        table.push(row.chain([missing.why.to_string()]).collect());
    }
    csv_table(table)
}
