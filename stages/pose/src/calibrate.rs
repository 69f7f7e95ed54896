//! The stage that calibrates the cameras of a turn.

use crate::from_mat::{self, MatError};
use crate::from_tracks::{self, TracksError};
use shape::{Cameras, Intrinsics, Photos, Rig, Tags, Tracks};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::choice! {
    /// How cameras without a mat are held together.
    pub enum Motion {
        /// To one ring where the turn's step is known, else free.
        Auto = "auto",
        /// To one ring: a fixed camera, a turning disk.
        Ring = "ring",
        /// Not at all: each camera follows what it sees.
        Free = "free",
        /// Nor are the photos in turning order: from two photos on, one more at a time.
        Any = "any",
    }
}

stage::params! {
    /// What is believed before anything is seen, and how sure sightings are.
    pub struct CalibrateParams {
        /// How sure the focal length of EXIF or capture.toml is, as a share of it.
        #[range(0.0005..=0.5)]
        focal_sigma: f64 = 0.01,
        /// How far the principal point may be from the photo's middle, as a share of its longer side.
        #[range(0.0001..=0.2)]
        centre_sigma: f64 = 0.004,
        /// How sure a focal length in pixels of capture.toml is, as a share of it.
        #[range(0.00001..=0.1)]
        given_focal: f64 = 0.0005,
        /// How sure a principal point of capture.toml is.
        #[range(0.01..=100.0)]
        given_centre_px: f64 = 0.5,
        /// How strong radial distortion may be (k1; k2 half as much).
        #[range(0.0001..=1.0)]
        radial_sigma: f64 = 0.03,
        /// Least standard deviation of a tag's corner; what corners scatter by where that is more.
        #[range(0.01..=5.0)]
        tag_px: f64 = 0.03,
        /// How far the sides of a tag may look too far out or in: ink that spread, paper that bloomed. 0 for not at all.
        #[range(0.0..=5.0)]
        bloom_px: f64 = 0.2,
        /// How far radius and middle of the disk's rim may be from what `[rim]` says.
        #[range(0.001..=50.0)]
        rim_round_mm: f64 = 1.0,
        /// How much taller or less tall than wide a printer may make the tags on the rim, as a share.
        #[range(0.000001..=0.1)]
        rim_stretch: f64 = 0.001,
        /// Standard deviation of a feature.
        #[range(0.05..=5.0)]
        feature_px: f64 = 0.6,
        /// Residuals beyond this many standard deviations lose weight.
        #[range(0.5..=20.0)]
        loss: f64 = 3.0,
        /// Most steps of an adjustment.
        #[range(1..=1000)]
        steps: u32 = 60,
        /// How cameras without a mat are held together.
        motion: Motion = Motion::Auto,
        /// How evenly the disk turns, where its step is known.
        #[range(0.001..=10.0)]
        step_sigma_deg: f64 = 0.1,
        /// A subject sways where features fit one ring worse than free cameras by this factor.
        #[range(1.0..=50.0)]
        sway_ratio: f64 = 1.25,
        /// Free cameras further off a ring than this share of its radius are refused.
        #[range(0.001..=10.0)]
        off_ring: f64 = 0.02,
        /// Without a mat, features that lie further from where they should (root mean square) are
        /// not believed; in proportion more on photos of more than 2400 pixels.
        #[range(0.1..=100.0)]
        most_px: f64 = 2.0,
        /// Most features that are adjusted.
        #[range(100..=100000)]
        most_tracks: u32 = 3000,
    }
}

stage::inputs! {
    /// What was seen.
    pub struct CalibrateInput {
        /// The photos: their size, focal length, and the mat.
        photos: Arc<Photos>,
        /// Marker tags.
        tags: Option<Arc<Tags>>,
        /// Features followed over the photos.
        tracks: Option<Arc<Tracks>>,
    }
}

/// Why there are no cameras.
#[derive(Debug, thiserror::Error)]
pub enum CalibrateError {
    /// Neither tags nor tracks.
    #[error(
        "no marker tags were found, and no features that turn with the disk, so nothing tells where the camera stood: are the photos in turning order, at steps below 30°? A patterned cloth or a marker mat (`tailor mat`) on the disk helps"
    )]
    Nothing,
    /// The mat path failed.
    #[error(transparent)]
    Mat(#[from] MatError),
    /// The path without a mat failed.
    #[error(transparent)]
    Tracks(#[from] TracksError),
}

/// `pose.calibrate`: photos, tags, tracks → cameras.
pub struct Calibrate;

impl Stage for Calibrate {
    const NAME: &'static str = "pose.calibrate";
    const VERSION: u32 = 12;
    const ABOUT: &'static str = "Calibrates lens and cameras by bundle adjustment, in the turntable frame where a mat gives it.";
    type Params = CalibrateParams;
    type Input = CalibrateInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &[
        "cameras",
        "reprojection",
        "focal",
        "focal sigma",
        "scale sigma",
        "rim tags",
        "feature tracks",
    ];

    fn run(p: &CalibrateParams, input: CalibrateInput, ctx: &Ctx<'_>) -> Result<Cameras, Stop> {
        let photos = &input.photos;
        let tags = input
            .tags
            .as_ref()
            .filter(|t| t.views.values().any(|v| !v.is_empty()));
        let lens = first_lens(photos);
        let tracks = input.tracks.as_deref().filter(|t| !t.points.is_empty());
        let found = match (photos.rig.mat, tags, tracks) {
            (Some(mat), Some(tags), tracks) => {
                from_mat::calibrate(photos, &lens, &mat, tags, tracks, p)
                    .map_err(CalibrateError::from)
            }
            (_, _, Some(tracks)) => {
                if photos.rig.mat.is_some() {
                    ctx.warn("capture.toml tells of a mat, but no tag of it was found: cameras follow from features alone");
                }
                from_tracks::calibrate(photos, &lens, tracks, p).map_err(CalibrateError::from)
            }
            _ => Err(CalibrateError::Nothing),
        };
        let from_mat::Found {
            cameras,
            fit,
            warnings,
            used_tracks,
            rim_tags,
        } = found?;
        warnings.iter().for_each(|w| ctx.warn(w));
        ctx.metric("cameras", cameras.views.len() as f64, "");
        ctx.metric("reprojection", fit.rms_px, "px");
        let lens = cameras
            .views
            .values()
            .next()
            .map_or(lens, |v| v.camera.lens);
        ctx.metric("focal", lens.focal[0], "px");
        ctx.metric("focal sigma", fit.lens_sigma[0], "px");
        if let Some(sigma) = cameras.scale_sigma {
            ctx.metric("scale sigma", sigma * 100.0, "%");
        }
        if photos.rig.rim.is_some() {
            ctx.metric("rim tags", rim_tags as f64, "");
        }
        ctx.metric("feature tracks", used_tracks as f64, "");
        Ok(cameras)
    }
}

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
