//! Girths and landmarks as JSON and CSV.

use crate::{Girth, Girths, Landmarks};
use serde_json::{Value, json};
use std::fmt::Write;

/// Millimetres as centimetres with two digits behind the point.
fn cm(mm: f64) -> f64 {
    (mm * 10.0).round() / 100.0
}

/// `girths.json`: `cm` along the contour, `tape_cm` convex in the plane, `spline_cm` the paper's.
pub fn girths_to_json(girths: &Girths) -> String {
    let one = |g: &Girth| {
        json!({
            "name": g.name, "label": g.label, "definition": g.definition,
            "cm": cm(g.contour_mm), "tape_cm": cm(g.tape_mm), "spline_cm": cm(g.spline_mm),
            "silhouette_cm": g.silhouette_mm.map(cm),
            "interval_cm": g.interval_mm.map(cm),
            "plane": { "point_mm": g.plane.point_mm, "normal": g.plane.normal },
        })
    };
    let mut list: Vec<Value> = girths.girths.iter().map(one).collect();
    if let (Some(l), Some(r)) = (girths.get("AC_L"), girths.get("AC_R")) {
        let mean = |f: fn(&Girth) -> f64| cm((f(l) + f(r)) / 2.0);
        list.push(json!({
            "name": "AC", "label": "upper arm", "definition": "mean of AC_L and AC_R",
            "cm": mean(|g| g.contour_mm), "tape_cm": mean(|g| g.tape_mm),
            "spline_cm": mean(|g| g.spline_mm),
            "interval_cm": [mean(|g| g.interval_mm[0]), mean(|g| g.interval_mm[1])],
        }));
    }
    let ratios: serde_json::Map<String, Value> = girths
        .ratios
        .iter()
        .map(|(name, value, _)| (name.clone(), json!(value)))
        .collect();
    let missing: Vec<_> = girths
        .missing
        .iter()
        .map(|m| json!({ "name": m.name, "why": m.why }))
        .collect();
    let file = json!({
        "unit": "cm", "girths": list, "ratios": ratios, "missing": missing,
        "stature_cm": girths.stature_mm.map(cm), "weight_kg": girths.weight_kg,
        "bmi": girths.bmi, "volume_l": girths.volume_l,
    });
    serde_json::to_string_pretty(&file).expect("bug: girths JSON cannot hold")
}

/// The JSON schema (draft 2020-12) of what [`girths_to_json`] writes.
pub fn girths_schema() -> &'static str {
    include_str!("girths.schema.json")
}

/// A table for a spreadsheet (RFC 4180): one girth a row, centimetres; what is missing has a row
/// with a note and no number.
pub fn girths_to_csv(girths: &Girths) -> String {
    let mut csv = String::from(
        "name,label,tape_cm,interval_low_cm,interval_high_cm,cm,spline_cm,height_cm,silhouette_cm,note\n",
    );
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let number = |mm: Option<f64>| mm.map_or(String::new(), |mm| format!("{:.2}", cm(mm)));
    let mut row = |name: &str, label: &str, lengths: [Option<f64>; 7], note: &str| {
        let lengths = lengths.map(number).join(",");
        let note = if note.is_empty() {
            String::new()
        } else {
            quoted(note)
        };
        let _ = writeln!(csv, "{name},{},{lengths},{note}", quoted(label));
    };
    for g in &girths.girths {
        let [lo, hi] = g.interval_mm.map(Some);
        let (tape, contour, spline) = (g.tape_mm, g.contour_mm, g.spline_mm);
        let height = Some(g.plane.point_mm[2]);
        let lengths = [
            Some(tape),
            lo,
            hi,
            Some(contour),
            Some(spline),
            height,
            g.silhouette_mm,
        ];
        row(&g.name, &g.label, lengths, "");
    }
    if let (Some(l), Some(r)) = (girths.get("AC_L"), girths.get("AC_R")) {
        let mean = |f: fn(&Girth) -> f64| Some((f(l) + f(r)) / 2.0);
        let lengths = [
            mean(|g| g.tape_mm),
            mean(|g| g.interval_mm[0]),
            mean(|g| g.interval_mm[1]),
            mean(|g| g.contour_mm),
            mean(|g| g.spline_mm),
            None,
            None,
        ];
        row("AC", "upper arm", lengths, "mean of AC_L and AC_R");
    }
    for missing in &girths.missing {
        row(&missing.name, "", [None; 7], &missing.why);
    }
    csv
}

/// Landmarks: planes, points, what is missing.
pub fn landmarks_to_json(landmarks: &Landmarks) -> String {
    let found: Vec<_> = landmarks
        .found
        .iter()
        .map(|l| {
            json!({
                "name": l.name, "label": l.label, "definition": l.definition,
                "part": format!("{:?}", l.part),
                "plane": { "point_mm": l.plane.point_mm, "normal": l.plane.normal },
            })
        })
        .collect();
    let missing: Vec<_> = landmarks
        .missing
        .iter()
        .map(|m| json!({ "name": m.name, "why": m.why }))
        .collect();
    let points: serde_json::Map<String, Value> = landmarks
        .points
        .iter()
        .map(|(name, p)| (name.clone(), json!(p)))
        .collect();
    let file = json!({
        "unit": "mm", "landmarks": found, "missing": missing, "points": points,
        "stature_mm": landmarks.stature_mm,
    });
    serde_json::to_string_pretty(&file).expect("bug: landmarks JSON cannot hold")
}
