//! Levels of girths that no single mark shows: from the marks around them.
//!
//! Ribs, hip bones, nipples and joints lie under the skin, so a surface can only estimate their
//! levels. Each level here is a straight combination of marks, fitted (robustly) on 260 made bodies
//! from infants to the old, thin to heavy, with arms 22° to 40° from the body. The scatter is what
//! those bodies left over, as a share of stature; intervals are made of it.

use crate::landmarks::neck::Throat;
use crate::marks::Marks;

/// Nipples (ISO 8559-1 bust level): at the bust's apex where the outline comes to a point near their
/// usual level. Height above the ground. \[mm\]
pub(crate) fn chest(m: &Marks, stature: f64) -> f64 {
    let usual = 0.132 * stature + 0.589 * m.bust + 0.223 * m.shoulder - 0.106 * m.girth;
    match m.apex {
        Some((z, sharp)) if (z - usual).abs() < 0.03 * stature => usual + sharp * (z - usual),
        _ => usual,
    }
}

/// Amid the lowest rib and the hip bone (ISO 8559-1 waist level). Height above the ground. \[mm\]
pub(crate) fn waist(m: &Marks, stature: f64) -> f64 {
    0.001 * stature + 0.382 * m.hip + 0.218 * m.hollow + 0.339 * m.neck - 0.101 * m.girth
}

/// Where the middle line of the arm's flesh meets the plane amid the joints of shoulder and elbow.
/// Height above the ground. \[mm\]
pub(crate) fn upper_arm(m: &Marks, stature: f64) -> f64 {
    (0.037 * m.spread - 0.075) * stature + 0.949 * m.shoulder - 0.052 * m.girth
}

/// Amid the two joints of the neck: offset along the throat's usual axis. \[mm\]
pub(crate) fn neck(t: &Throat, stature: f64) -> f64 {
    0.713 * t.ears + 0.331 * t.shoulders + 0.264 * t.back - 0.017 * stature
}

/// How far the line between these joints leans forward: farther where the head is carried farther
/// before the shoulders. \[rad\]
pub(crate) fn neck_lean(t: &Throat, stature: f64) -> f64 {
    (652.0 * t.ahead / stature - 1.8).to_radians()
}

/// Standard deviation of a girth's level, as a share of stature.
pub(crate) fn scatter(name: &str) -> f64 {
    match name.split('_').next().unwrap_or(name) {
        "WC" => 0.0070,
        "CC" => 0.0063,
        "NC" => 0.0024,
        "AC" => 0.0066,
        "HC" => 0.0027,
        // Found as extremes: the girth hardly changes with the level.
        _ => 0.0030,
    }
}
