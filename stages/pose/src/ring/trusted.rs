//! A turn adjusted to all features, in rounds: which of them fit, what they scatter by, then one adjustment.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::{Fit, Settings, adjust};
use crate::adjust::lens::LensPrior;
use crate::adjust::scene::{PointObservation, Scene, median_px};
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::settings;
use crate::ring::cameras::Solved;
use crate::ring::pairs::chosen;
use crate::ring::trial::spread_px;
use crate::two_view::triangulate::triangulated;
use shape::Tracks;

/// The loss is for features that scatter as they are believed to; no less of it is left for surer ones. By hand: looked
/// at two captures, halved and doubled: nothing changes, for features scatter more (docs/lab/numbers.md).
const LEAST_LOSS_SHARE: f64 = 0.05;

/// A scene that holds on to features.
pub(crate) struct Trusted {
    /// The features that are looked at.
    many: Tracks,
    pub(crate) scene: Scene,
    /// Those that fit.
    pub(crate) observations: Vec<PointObservation>,
    pub(crate) fit: Fit,
    /// Standard deviation of the features, at least the one believed. \[px\]
    sigma_px: f64,
    /// How they are adjusted.
    pub(crate) how: Settings,
}

impl Trusted {
    /// Three rounds from a scene that explains a few features.
    pub(crate) fn begun(
        scene: &Scene,
        tracks: &Tracks,
        beliefs: &Beliefs,
        p: &CalibrateParams,
    ) -> Trusted {
        let many = chosen(tracks, p.most_tracks as usize);
        let mut scene = scene.clone();
        let (seen, sigma_px, how) = fitting(&mut scene, &many, 16.0, p);
        let mut trusted = Trusted {
            fit: adjust(&mut scene, &seen, beliefs, &how),
            observations: seen,
            many,
            scene,
            sigma_px,
            how,
        };
        (0..2).for_each(|_| trusted.again(beliefs, p));
        trusted
    }

    /// Features anew, then one adjustment.
    pub(crate) fn again(&mut self, beliefs: &Beliefs, p: &CalibrateParams) {
        let most_px = 8.0 * self.sigma_px;
        (self.observations, self.sigma_px, self.how) =
            fitting(&mut self.scene, &self.many, most_px, p);
        self.fit = adjust(&mut self.scene, &self.observations, beliefs, &self.how);
    }

    /// What follows: how much of the features it explains, and by what lens it was believed.
    pub(crate) fn solved(self, prior: LensPrior) -> Solved {
        let of = self.many.points.len().max(1);
        Solved {
            share: self.scene.points.len() as f64 / of as f64,
            scene: self.scene,
            observations: self.observations,
            fit: self.fit,
            prior,
        }
    }

    /// Median distance of features from where they should be. \[px\]
    pub(crate) fn median_px(&self) -> f64 {
        median_px(&self.scene, &self.observations)
    }
}

/// The features that are within `most_px` of where they should, what they scatter by, and how they are adjusted: what
/// is far off loses weight by what features scatter by, be that less than is believed of them.
fn fitting(
    scene: &mut Scene,
    tracks: &Tracks,
    most_px: f64,
    p: &CalibrateParams,
) -> (Vec<PointObservation>, f64, Settings) {
    let seen = triangulated(scene, tracks, most_px);
    let spread = spread_px(&seen);
    let sigma_px = spread.max(p.feature_px);
    let how = Settings {
        loss: p.loss * (spread / sigma_px).max(LEAST_LOSS_SHARE),
        ..settings(p)
    };
    let observations = scene.filled(seen.iter().map(|s| &s.spot), sigma_px);
    (observations, sigma_px, how)
}
