//! What is believed of the lens, from EXIF, capture.toml and params, and how adjustments go.

use crate::adjust::bundle::Settings;
use crate::adjust::lens::{LensPrior, lens_values};
use crate::calibration::params::CalibrateParams;
use shape::{Intrinsics, Photos, Rig, film_to_px};

/// Whether a focal length is known, be it EXIF's or a calibration's.
pub(crate) fn knows_focal(rig: &Rig) -> bool {
    rig.focal_35mm.is_some() || rig.focal_px.is_some()
}

/// How many times more pixels the photos have along a side than what bounds in pixels are for.
pub(crate) fn enlargement(photos: &Photos) -> f64 {
    let longest = photos.photos.iter().map(|p| p.width.max(p.height)).max();
    (f64::from(longest.unwrap_or(0)) / 2400.0).max(1.0)
}

/// The lens that capture.toml gives, or EXIF. Without a focal length, that of a usual lens: the
/// photo's longer side times 1.2.
pub(crate) fn first_lens(photos: &Photos) -> Intrinsics {
    let first = &photos.photos[0];
    let longer = f64::from(first.width.max(first.height));
    let on_film = |mm| film_to_px(mm, first.width, first.height);
    let focal = photos.rig.focal_35mm.map_or(1.2 * longer, on_film);
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

/// Standard deviation of a number that was rounded to a whole one: 1/√12 (derived).
const ROUNDED: f64 = 0.289;
/// A photo longer than this many times its width was cropped, or is a frame of a video (structural: any bound between
/// 3:2, the longest sensor, and 16:9 parts them alike).
const CROPPED_RATIO: f64 = 1.6;
/// Some cameras keep the focal length of the whole sensor for a crop (16:9 of 4:3: 8.2 % less than the crop's own),
/// some do not. Standard deviation, as a share (derived: even odds of both, half of what they differ by).
const CROP_SIGMA: f64 = 0.041;

/// How sure the focal length is before anything is seen, as a share of it. EXIF rounds to whole
/// millimetres, and a crop may keep the number of the whole sensor.
pub(crate) fn focal_sigma(rig: &Rig, lens: &Intrinsics, p: &CalibrateParams) -> f64 {
    let Some(mm) = rig.focal_35mm else {
        return if rig.focal_px.is_some() {
            p.focal_sigma
        } else {
            0.5
        };
    };
    let rounded = if mm.fract() == 0.0 { ROUNDED / mm } else { 0.0 };
    let (width, height) = (f64::from(lens.width), f64::from(lens.height));
    let long = width.max(height) / width.min(height).max(1.0);
    let crop = if long > CROPPED_RATIO {
        CROP_SIGMA
    } else {
        0.0
    };
    libm::hypot(libm::hypot(p.focal_sigma, rounded), crop)
}

/// The first radial coefficient that moves a corner of the photo by a share of its way from the middle.
pub(crate) fn radial_of(corner_share: f64, lens: &Intrinsics) -> f64 {
    let half = [lens.width, lens.height].map(|side| f64::from(side) / 2.0);
    let corner = libm::hypot(half[0], half[1]) / lens.focal[0];
    corner_share / (corner * corner)
}

/// The belief about the lens: `focal_sigma` is a share of its focal length.
pub(crate) fn lens_prior(lens: &Intrinsics, focal_sigma: f64, p: &CalibrateParams) -> LensPrior {
    let longer = f64::from(lens.width.max(lens.height));
    let c = p.centre_sigma * longer;
    let radial = radial_of(p.corner_sigma, lens);
    LensPrior {
        mean: lens_values(lens),
        sigma: [focal_sigma * lens.focal[0], c, c, radial, radial / 2.0],
    }
}

/// What is believed of a lens before anything is seen: by EXIF, by capture.toml, by params.
pub(crate) fn lens_belief(lens: &Intrinsics, rig: &Rig, p: &CalibrateParams) -> LensPrior {
    as_given(lens_prior(lens, focal_sigma(rig, lens, p), p), rig, p)
}

/// The belief where capture.toml gives the lens.
fn as_given(mut prior: LensPrior, rig: &Rig, p: &CalibrateParams) -> LensPrior {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sigma(focal_35mm: Option<f64>, width: u32, height: u32) -> f64 {
        let rig = Rig {
            focal_35mm,
            ..Rig::default()
        };
        let lens = Intrinsics::simple(width, height, 1000.0);
        focal_sigma(&rig, &lens, &CalibrateParams::default())
    }

    #[test]
    fn a_whole_number_is_rounded_and_a_crop_may_keep_the_sensors() {
        assert_eq!(sigma(Some(26.5), 3000, 4000), 0.01);
        let rounded = sigma(Some(26.0), 3000, 4000);
        assert!((rounded - 0.01494).abs() < 1e-4, "{rounded}");
        assert!(sigma(Some(26.5), 1080, 1920) > 0.04);
        assert_eq!(sigma(None, 3000, 4000), 0.5);
    }
}
