//! How high a neck's girth is taken: where the thyroid cartilage ends, between the notch of the breastbone and the
//! angle of throat and floor of the mouth.
//!
//! By vertebral levels the hyoid bone is at the third cervical vertebra, the lower edge of the thyroid cartilage at
//! the fifth, the notch at the second thoracic disc (Gray's Anatomy): two thirds of the way. On made bodies the larynx
//! is carried at 0.66 to 0.72 of it; a test holds both numbers against `models/tables/neck.csv`. The angle shows; the
//! notch is estimated by the law of [`Place::Notch`](super::law::Place::Notch), to which the survey's people were driven.

use super::law::LawEstimate;

/// Of the way from notch to angle, where the thyroid cartilage ends, and its standard deviation: a test holds both against
/// `models/tables/neck.csv`.
pub(crate) const SHARE: (f64, f64) = (2.0 / 3.0, 0.08);
/// Standard deviation of the angle's own place, as a share of the neck's diameter. By hand: looked at two and a half
/// rows of the outline that it is read on. Between two captures of made bodies it scatters by less.
const ANGLE_SD: f64 = 0.05;
/// Notch and angle are at least so far apart, as a share of the diameter: a chin on the chest. By hand: looked at three
/// scans, at 0.7 and 1.4 of it: no tape changes.
const LEAST_APART: f64 = 0.1;

/// Offset of the larynx along the neck's axis from its tightest section, as shares of the diameter, from the notch and
/// the angle; sigma and repeat with it.
pub(crate) fn larynx(notch: LawEstimate, angle: f64) -> LawEstimate {
    let low = notch.value.min(angle - LEAST_APART);
    let (share, share_sd) = SHARE;
    let parts = [
        (1.0 - share) * notch.sigma,
        share * ANGLE_SD,
        share_sd * (angle - low),
    ];
    LawEstimate {
        value: low + share * (angle - low),
        sigma: parts.iter().map(|p| p * p).sum::<f64>().sqrt(),
        repeat: notch
            .repeat
            .map(|r| libm::hypot((1.0 - share) * r, share * ANGLE_SD)),
        inside: notch.inside,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::fitted;
    use crate::model::table::Table;

    fn notch(value: f64) -> LawEstimate {
        LawEstimate {
            value,
            sigma: 0.1,
            repeat: None,
            inside: true,
        }
    }

    #[test]
    fn the_larynx_is_between_notch_and_angle_and_a_long_throat_is_less_sure() {
        let (long, short) = (larynx(notch(-1.0), 0.3), larynx(notch(-0.3), 0.04));
        proof::near(long.value, 0.3 - 1.3 / 3.0, 1e-9);
        assert!(short.sigma < long.sigma, "{short:?}");
        // A chin on the chest, below where the neck is tightest.
        assert!(larynx(notch(-0.2), -0.3).value < -0.3);
    }

    #[test]
    fn share_and_scatter_are_those_of_made_bodies() {
        let table = Table::checked_in("neck.csv");
        let column = |name: &str| table.optional(name).unwrap();
        let (notch, larynx, angle) = (column("notch"), column("larynx"), column("f.angle"));
        let (family, refused) = (table.text("family").unwrap(), column("refused"));
        let mut shares: Vec<f64> = (0..table.len())
            .filter(|i| fitted(family[*i]) && refused[*i] == Some(0.0))
            .filter_map(|i| Some((larynx[i]? - notch[i]?) / (angle[i]? - notch[i]?)))
            .collect();
        shares.sort_by(f64::total_cmp);
        let at = |q: f64| shares[((shares.len() - 1) as f64 * q) as usize];
        assert!(shares.len() > 700);
        proof::near(at(0.5), SHARE.0, 0.02);
        proof::near((at(0.9) - at(0.1)) / 2.563, SHARE.1, 0.015);
    }
}
