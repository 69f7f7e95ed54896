//! What is believed of the lens, from EXIF, capture.toml and params, and how adjustments go.

use crate::adjust::lens::{LensPrior, lens_values};
use crate::adjust::scene::Settings;
use crate::calibration::params::CalibrateParams;
use shape::{Intrinsics, Photos, Rig};

/// Whether a focal length is known, be it EXIF's or a calibration's.
pub(crate) fn knows_focal(rig: &Rig) -> bool {
    rig.focal_35mm.is_some() || rig.focal_px.is_some()
}

/// The lens that capture.toml gives, or EXIF: 36 mm of film lie along the photo's longer side.
/// Without a focal length, that of a usual lens: its longer side times 1.2.
pub(crate) fn first_lens(photos: &Photos) -> Intrinsics {
    let first = &photos.photos[0];
    let longer = f64::from(first.width.max(first.height));
    let focal = photos
        .rig
        .focal_35mm
        .map_or(1.2 * longer, |mm| mm / 36.0 * longer);
    let focal = photos.rig.focal_px.unwrap_or(focal);
    let simple = Intrinsics::simple(first.width, first.height, focal);
    Intrinsics {
        centre: photos.rig.centre_px.unwrap_or(simple.centre),
        ..simple
    }
}

/// The focal lengths to try. \[px\]
pub(crate) fn focals(photos: &Photos, lens: &Intrinsics) -> Vec<f64> {
    let longer = f64::from(lens.width.max(lens.height));
    if knows_focal(&photos.rig) {
        return vec![lens.focal[0]];
    }
    [0.8, 1.1, 1.5, 2.1, 3.0].map(|k| k * longer).into()
}

/// The belief about the lens, around what EXIF says.
pub(crate) fn lens_prior(lens: &Intrinsics, known_focal: bool, p: &CalibrateParams) -> LensPrior {
    let longer = f64::from(lens.width.max(lens.height));
    let focal_sigma = if known_focal { p.focal_sigma } else { 0.5 };
    let c = p.centre_sigma * longer;
    LensPrior {
        mean: lens_values(lens),
        sigma: [
            focal_sigma * lens.focal[0],
            c,
            c,
            p.radial_sigma,
            p.radial_sigma / 2.0,
        ],
    }
}

/// The belief where capture.toml gives the lens.
pub(crate) fn as_given(mut prior: LensPrior, rig: &Rig, p: &CalibrateParams) -> LensPrior {
    if rig.focal_px.is_some() {
        prior.sigma[0] = p.given_focal * prior.mean[0];
    }
    if rig.centre_px.is_some() {
        prior.sigma[1] = p.given_centre_px;
        prior.sigma[2] = p.given_centre_px;
    }
    prior
}

/// How the adjustments go.
pub(crate) fn settings(p: &CalibrateParams) -> Settings {
    Settings {
        loss: p.loss,
        steps: p.steps as usize,
        gain: 1e-7,
    }
}
