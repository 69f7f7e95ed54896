//! Body features and landmarks as JSON.

use crate::girths::{Written, missed};
use serde_json::{Map, Value, json};
use shape::{BodyFeatures, HipAt, Landmark, Landmarks, Unit};

/// The word of a unit, the end of keys of lengths in it, and what it makes of a length. \[mm\]
fn lengths(unit: Unit) -> (&'static str, &'static str, impl Fn(f64) -> f64) {
    let to = Written::of(unit);
    let (word, end) = match unit {
        Unit::Metric => ("mm", "mm"),
        Unit::Relative => (to.unit, "rel"),
    };
    let length = move |mm: f64| match unit {
        Unit::Metric => mm,
        Unit::Relative => to.length(mm),
    };
    (word, end, length)
}

/// What a surface shows of a body; lengths as those of landmarks.
pub fn body_features_to_json(body: &BodyFeatures) -> String {
    let (unit, end, length) = lengths(body.unit);
    let key = |what: &str| format!("{what}_{end}");
    let some = |mm: Option<f64>| json!(mm.map(&length));
    let hip = body.hip.map(|hip| match hip {
        HipAt::Between(low, high) => json!({ (key("between")): [length(low), length(high)] }),
        HipAt::Hidden(z, sigma) => {
            json!({ (key("hidden")): length(z), (key("sigma")): length(sigma) })
        }
    });
    let file = json!({
        "unit": unit, "refused": body.refused, "whole": body.whole, "carved": body.carved,
        "grounded": body.grounded, (key("ground")): length(body.ground),
        (key("stature")): length(body.stature), (key("stature_sigma")): some(body.stature_sigma),
        "front": body.front, "front_is_sure": body.front_is_sure,
        (key("crotch")): some(body.crotch), (key("legs_join")): some(body.legs_join),
        "hip": hip, (key("neck")): some(body.neck),
    });
    serde_json::to_string_pretty(&file).expect("bug: body features JSON cannot hold")
}

/// Landmarks: planes, points, what is missing. Lengths are millimetres; where nothing of known length was
/// given they are relative as in `girths.json`, and keys end in `rel`.
pub fn landmarks_to_json(landmarks: &Landmarks) -> String {
    let (unit, suffix, length) = lengths(landmarks.unit);
    let key = |what: &str| format!("{what}_{suffix}");
    let some = |mm: Option<f64>| json!(mm.map(&length));
    let one = |l: &Landmark| {
        json!({
            "name": l.name, "label": l.label, "definition": l.definition,
            "part": format!("{:?}", l.part),
            "plane": { (key("point")): l.plane.point_mm.map(&length), "normal": l.plane.normal },
            "sigma": {
                (key("level")): some(l.sigma.level_mm),
                "tilt_deg": l.sigma.tilt_rad.map(f64::to_degrees),
                (key("repeat")): some(l.sigma.repeat_mm),
                (key("hidden")): some(l.sigma.hidden_mm),
            },
        })
    };
    let found: Vec<_> = landmarks.found.iter().map(one).collect();
    let missing: Vec<_> = landmarks.missing.iter().map(missed).collect();
    // A direction is no length.
    let place = |name: &str, at: &[f64; 3]| match name {
        "front" => json!(at),
        _ => json!(at.map(&length)),
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
