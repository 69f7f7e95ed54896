//! How high the girth of a neck is taken: at the larynx, as head, throat and shoulders tell it.

use crate::features::neck::NeckFeatures;
use crate::model::larynx::larynx;
use crate::model::law::{Law, Place};

/// Standard deviation of the tilt about the body's left-right line, against the line of made bodies'
/// joints: that of `rig_lean` in `models/tables/neck.csv`. \[rad\]
const TILT_SD: f64 = 0.073;

/// Where the girth is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeckLevel {
    /// Offset along the axis from the tightest section, in front, as a share of the diameter.
    pub share: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Its standard deviation when the same body is captured again.
    pub repeat: Option<f64>,
    /// Standard deviation of the tilt. \[rad\]
    pub tilt: f64,
    /// Whether the neck is like those that the law was fitted on.
    pub inside: bool,
}

/// The level by the law of [`Place::Notch`] and the throat's angle. `None` where a feature is not finite.
pub fn neck_level(f: &NeckFeatures, notch: &Law) -> Option<NeckLevel> {
    let features: Option<Vec<f64>> = Place::Notch.features().iter().map(|n| f.get(n)).collect();
    let reported = larynx(notch.estimate(&features?)?, f.get("angle")?);
    Some(NeckLevel {
        share: reported.value,
        sigma: reported.sigma,
        repeat: reported.repeat,
        tilt: TILT_SD,
        inside: reported.inside,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::fitted;
    use crate::model::table::Table;

    #[test]
    fn the_tilts_deviation_is_that_of_made_bodies() {
        let table = Table::checked_in("neck.csv");
        let lean = table.numbers("f.lean").unwrap();
        let rig = table.optional("rig_lean").unwrap();
        let (family, repeats) = (
            table.text("family").unwrap(),
            table.text("repeats").unwrap(),
        );
        let off: Vec<f64> = (0..table.len())
            .filter(|i| repeats[*i].is_empty() && fitted(family[*i]))
            .filter_map(|i| Some(lean[i] - rig[i]?))
            .collect();
        let square = off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64;
        assert!(off.len() > 700);
        proof::near(TILT_SD, square.sqrt(), 0.003);
    }
}
