//! Levels of girths that no single mark shows: from the marks and the outline around them.
//!
//! Ribs, hip bones, nipples and joints lie under the skin, so a surface can only estimate their
//! levels. Each level here is a straight combination of marks and reaches of the outline, fitted
//! (robustly) on 460 made bodies (arms: on 260) from infants to the old, thin to heavy, with
//! arms 22° to 40° from the body. The scatter is what those bodies left over, as a share of stature;
//! intervals are made of it.

use crate::features::marks::Marks;
use crate::features::neck::Throat;

/// The spread of arms where none stands clear: some thirty degrees.
const USUAL_SPREAD: f64 = 0.6;
/// Spreads of the arms of bodies that levels were fitted on: where the shoulders' outline means the same.
const FITTED_SPREADS: std::ops::RangeInclusive<f64> = 0.35..=0.95;
/// The lowest that a bust lies, as a share of the way from hip to neck: what comes forward below is the belly.
const LOWEST_BUST: f64 = 0.45;

/// Nipples (ISO 8559-1 bust level): at the bust's apex where the outline comes to a point near their
/// usual level. Height above the ground. \[mm\]
pub(crate) fn chest(m: &Marks, stature: f64) -> f64 {
    let (trunk, back) = (m.reach.trunk(0.4667), m.reach.back(0.4));
    let blades = m.reach.back(0.9333);
    let usual = match m.bust > m.hip + LOWEST_BUST * (m.neck - m.hip) {
        true => {
            0.105 * stature + 0.158 * m.hip + 0.234 * m.shoulder + 0.202 * m.girth + 0.500 * m.bust
                - 0.304 * m.reach.front(0.1)
                - 0.216 * trunk
                + 0.484 * back
                - 0.347 * blades
        }
        // A belly that reaches before the bust hides it.
        false => {
            0.162 * stature + 0.412 * m.hip + 0.416 * m.shoulder + 0.196 * m.girth - 0.206 * trunk
                + 0.742 * back
                - 0.701 * blades
        }
    };
    match m.apex {
        Some((z, sharp)) if (z - usual).abs() < 0.03 * stature => usual + sharp * (z - usual),
        _ => usual,
    }
}

/// Amid the lowest rib and the hip bone (ISO 8559-1 waist level). Height above the ground. \[mm\]
pub(crate) fn waist(m: &Marks, stature: f64) -> f64 {
    if m.spread.is_some_and(|s| FITTED_SPREADS.contains(&s)) {
        let r = &m.reach;
        // Shoulders, from armpit to neck, tell how long the trunk is above the waist.
        let shoulders = 0.436 * r.full(0.7333) - 0.560 * r.full(0.8) + 0.360 * r.full(1.0);
        let lower_back = 0.269 * r.back(0.4) - 0.470 * r.back(0.2);
        let upper_back = 0.223 * r.back(0.5667) - 0.410 * r.back(0.8) + 0.320 * r.back(1.0);
        -0.106 * stature + 0.490 * m.hip + 0.578 * m.shoulder - 0.162 * m.girth
            + shoulders
            + lower_back
            + upper_back
    } else {
        0.001 * stature + 0.382 * m.hip + 0.218 * m.hollow + 0.339 * m.neck - 0.101 * m.girth
    }
}

/// Where the middle line of the arm's flesh meets the plane amid the joints of shoulder and elbow.
/// Height above the ground. \[mm\]
pub(crate) fn upper_arm(m: &Marks, stature: f64) -> f64 {
    let spread = m.spread.unwrap_or(USUAL_SPREAD);
    (0.037 * spread - 0.075) * stature + 0.949 * m.shoulder - 0.052 * m.girth
}

/// How far the line from the neck's lower joint to its upper leans forward: farther where the head is
/// carried farther before the shoulders. \[rad\]
pub(crate) fn neck_lean(t: &Throat, stature: f64) -> f64 {
    (797.9 * t.ahead / stature - 25.01 * t.ahead / t.head + 2.99).to_radians()
}

/// Standard deviation of a girth's level, as a share of stature.
pub(crate) fn scatter(name: &str) -> f64 {
    match name.split('_').next().unwrap_or(name) {
        "WC" => 0.0040,
        "CC" => 0.0042,
        "NC" => 0.0017,
        "AC" => 0.0072,
        "HC" => 0.0027,
        // Found as extremes: the girth hardly changes with the level.
        _ => 0.0030,
    }
}
