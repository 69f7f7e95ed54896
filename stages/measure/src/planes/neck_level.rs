//! How high the girth of a neck is taken: just under the larynx, as head, throat and shoulders tell it.
//!
//! Of the way from the notch between the collar bones to the angle of throat and floor of the mouth, the
//! thyroid cartilage ends at two thirds: hyoid bone at the third cervical vertebra, lower edge of the thyroid
//! cartilage at the fifth, notch at the second thoracic disc. The angle shows. The notch is told from how far
//! down the neck is a tube, fitted on made bodies (`models/fit_neck.py`, `models/tables/neck.csv`).

use crate::features::neck::NeckFeatures;

/// Offset of the notch: always, and for each unit of `low`; shares of the diameter.
const NOTCH: (f64, f64) = (-0.115, 2.229);
/// Standard deviation that leaves (families held out), as a share of the diameter.
const NOTCH_SD: f64 = 0.114;
/// Of the way from notch to angle, where the thyroid cartilage ends, and its standard deviation.
const LARYNX: (f64, f64) = (2.0 / 3.0, 0.08);
/// Standard deviation of the angle's own place, as a share of the diameter.
const ANGLE_SD: f64 = 0.05;
/// Notch and angle are at least so far apart, as a share of the diameter: a chin on the chest.
const APART: f64 = 0.1;
/// Standard deviation of the tilt about the body's left-right line, against the line of made bodies'
/// joints. \[rad\]
const TILT_SD: f64 = 0.08;

/// Where the girth is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeckLevel {
    /// Offset along the axis from the tightest section, in front, as a share of the diameter.
    pub share: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Standard deviation of the tilt. \[rad\]
    pub tilt: f64,
}

/// Tells the level.
pub fn neck_level(f: &NeckFeatures) -> NeckLevel {
    let d = f.diameter_mm();
    level(f.tube.ends.1 / d, f.throat.angle.0 / d)
}

/// From where the tube ends below and where the angle is; shares of the diameter.
fn level(low: f64, angle: f64) -> NeckLevel {
    let notch = (NOTCH.0 + NOTCH.1 * low).min(angle - APART);
    let (share, share_sd) = LARYNX;
    let parts = [
        (1.0 - share) * NOTCH_SD,
        share * ANGLE_SD,
        share_sd * (angle - notch),
    ];
    NeckLevel {
        share: notch + share * (angle - notch),
        sigma: parts.iter().map(|p| p * p).sum::<f64>().sqrt(),
        tilt: TILT_SD,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_larynx_lies_between_notch_and_angle_and_a_long_throat_is_less_sure() {
        let (long, short) = (level(-0.4, 0.3), level(-0.08, 0.04));
        assert!((-0.25..0.0).contains(&long.share), "{long:?}");
        assert!(
            short.share.abs() < 0.1 && short.sigma < long.sigma,
            "{short:?}"
        );
        // A chin on the chest, below where the neck is tightest.
        let chest = level(-0.05, -0.3);
        assert!(chest.share < -0.3, "{chest:?}");
    }
}
