//! The stage that calibrates the cameras of a turn.

use crate::calibration::found::Found;
use crate::calibration::params::{CalibrateParams, Motion};
use crate::calibration::prior::first_lens;
use crate::calibration::upright::{Posture, posture};
use crate::mat::{self, recognise::recognised, solve::MatError};
use crate::ring;
use crate::ring::error::TracksError;
use shape::{Cameras, Photos, Tags, Tracks};
use stage::{Ctx, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    NO_MAT = "warn-mat": "a mat is given, but none was found in the photos: cameras follow from features alone; is it in view, in good light, and flat?";
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

stage::failures! {
    /// Why there are no cameras.
    pub enum CalibrateError {
        /// Neither a mat nor features.
        Nothing = "fail-no-texture": "no marker tags of a given mat were found, and no features that turn with the disk, so the camera's place is not known: are the photos in turning order, at steps below 30°? A patterned cloth or a marker mat (`tailor mat`) on the disk helps",
        /// Up is down.
        UpsideDown = "fail-upside-down": "the photos are upside down: up from the mat runs to their bottom edge. Turn them by 180°, for instance with `exiftool -n -Orientation=3 DIR/images/*.jpg`, or in a viewer that saves them",
        /// Up is to a side.
        OnTheirSide = "fail-on-side": "the photos are on their side: up from the disk runs to their left or right edge. Turn them by 90°, for instance with `exiftool -n -Orientation=6 DIR/images/*.jpg` (8 for the other way), or in a viewer that saves them",
    }
    passes {
        /// The mat path failed.
        Mat(MatError),
        /// The path without a mat failed.
        Tracks(TracksError),
    }
}

/// `pose.calibrate`: photos, tags, tracks → cameras.
pub struct Calibrate;

impl Stage for Calibrate {
    const NAME: &'static str = "pose.calibrate";
    const VERSION: u32 = 23;
    const ABOUT: &'static str = "Calibrates lens and cameras by bundle adjustment, in the turntable frame where a mat gives it.";
    type Params = CalibrateParams;
    type Input = CalibrateInput;
    type Output = Cameras;
    const METRICS: &'static [&'static str] = &[
        "cameras",
        "reprojection rms",
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
        let known = photos.rig.mat;
        let mat = known.or_else(|| {
            let (tag_mm, disk_mm) = (photos.rig.tag_mm?, photos.rig.disk_diameter_mm);
            recognised(tags?, tag_mm, disk_mm, |w| ctx.warn(w))
        });
        let found = match (mat, tags, tracks) {
            (Some(mat), Some(tags), tracks) => {
                mat::solve::calibrate(photos, &lens, &mat, tags, tracks, p)
                    .map_err(CalibrateError::from)
            }
            (_, _, Some(tracks)) => {
                if photos.rig.tagged() {
                    ctx.warn(message!(NO_MAT));
                }
                // Cameras that are added one at a time do not ask for it.
                let turns = p.motion != Motion::Any;
                let steady = turns.then(|| ring::stabiliser::places(photos)).flatten();
                ctx.check()?;
                ring::solve::calibrate(photos, &lens, tracks, steady.as_ref(), p)
                    .map_err(CalibrateError::from)
            }
            _ => Err(CalibrateError::Nothing),
        };
        let Found {
            cameras,
            fit,
            warnings,
            used_tracks,
            rim_tags,
        } = found?;
        warnings.iter().for_each(|w| ctx.warn(w));
        // Without a mat, up is where the photos have it.
        match posture(&cameras) {
            Posture::UpsideDown => return Err(CalibrateError::UpsideDown.into()),
            Posture::OnTheirSide => return Err(CalibrateError::OnTheirSide.into()),
            Posture::Upright => {}
        }
        ctx.metric("cameras", cameras.views.len() as f64, "");
        ctx.metric("reprojection rms", fit.rms_px, "px");
        let lens = cameras
            .views
            .values()
            .next()
            .map_or(lens, |v| v.camera.lens);
        ctx.metric("focal", lens.focal[0], "px");
        ctx.metric("focal sigma", fit.lens_sigmas[0][0], "px");
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
