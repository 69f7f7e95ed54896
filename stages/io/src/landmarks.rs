//! Landmarks as JSON.

use crate::girths::{Written, missed};
use serde_json::{Map, Value, json};
use shape::{Landmark, Landmarks, Unit};

/// Landmarks: planes, points, what is missing. Lengths are millimetres; where nothing of known length was
/// given they are relative as in `girths.json`, and keys end in `rel`.
pub fn landmarks_to_json(landmarks: &Landmarks) -> String {
    let to = Written::of(landmarks.unit);
    let (unit, suffix) = match landmarks.unit {
        Unit::Metric => ("mm", "mm"),
        Unit::Relative => (to.unit, "rel"),
    };
    let key = |what: &str| format!("{what}_{suffix}");
    let length = |mm: f64| match landmarks.unit {
        Unit::Metric => mm,
        Unit::Relative => to.length(mm),
    };
    let some = |mm: Option<f64>| json!(mm.map(length));
    let one = |l: &Landmark| {
        json!({
            "name": l.name, "label": l.label, "definition": l.definition,
            "part": format!("{:?}", l.part),
            "plane": { (key("point")): l.plane.point_mm.map(length), "normal": l.plane.normal },
            "sigma": {
                (key("level")): some(l.sigma.level_mm),
                "tilt_deg": l.sigma.tilt_rad.map(f64::to_degrees),
                (key("repeat")): some(l.sigma.repeat_mm),
            },
        })
    };
    let found: Vec<_> = landmarks.found.iter().map(one).collect();
    let missing: Vec<_> = landmarks.missing.iter().map(missed).collect();
    // A direction is no length.
    let place = |name: &str, at: &[f64; 3]| match name {
        "front" => json!(at),
        _ => json!(at.map(length)),
    };
    let points: Map<String, Value> = landmarks
        .points
        .iter()
        .map(|(name, p)| (name.clone(), place(name, p)))
        .collect();
    let file = json!({
        "unit": unit, "landmarks": found, "missing": missing, "points": points,
        (key("stature")): some(landmarks.stature_mm),
        (key("stature_sigma")): some(landmarks.stature_sigma_mm),
        (key("ground")): some(landmarks.ground_mm),
    });
    serde_json::to_string_pretty(&file).expect("bug: landmarks JSON cannot hold")
}
