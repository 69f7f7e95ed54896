//! What was adjusted without a mat becomes cameras, or a refusal with its reason.

use crate::adjust::bundle::Fit;
use crate::adjust::lens::LensPrior;
use crate::adjust::scene::{PointObservation, Scene};
use crate::calibration::found::Found;
use crate::calibration::params::{CalibrateParams, Motion};
use crate::calibration::prior::{enlargement, knows_focal};
use crate::calibration::trust::{misfits, nudged, views, warnings};
use crate::frame::circle::{RING_MM, camera_circle, in_ring_frame};
use crate::ring::error::TracksError;
use crate::ring::folded::unfolded;
use crate::ring::pairs::LEAST_FEATURES;
use nalgebra::Point3;
use shape::{Cameras, Photos, Scale};
use stage::message;

stage::messages! {
    FEW_HOLD = "warn-few-hold": "only {count} features in common with other photos, so the camera follows from those of the other photos: is the photo in its place in the turning order?";
    FEW_FIT = "warn-few-fit": "only {share:.0 %} of the features fit the cameras: look at the camera ring before you trust it";
    NO_FOCAL = "warn-no-focal": "the focal length is unknown and the photos hardly determine it: give `focal_35mm` in capture.toml";
}

/// An adjusted scene without a scale.
pub(crate) struct Solved {
    /// Its cameras by photo, rising.
    pub(crate) scene: Scene,
    pub(crate) observations: Vec<PointObservation>,
    pub(crate) fit: Fit,
    /// How much of the features it explains.
    pub(crate) share: f64,
    pub(crate) prior: LensPrior,
}

/// The cameras, on a ring about the z axis, and what the user should know of them.
pub(crate) fn to_cameras(
    photos: &Photos,
    solved: &Solved,
    p: &CalibrateParams,
) -> Result<Found, TracksError> {
    let (scene, fit, share) = (&solved.scene, &solved.fit, solved.share);
    let most = p.most_px * enlargement(photos);
    if fit.rms_px > most {
        return Err(TracksError::Loose {
            rms: fit.rms_px,
            most,
        });
    }
    let points = scene
        .points
        .iter()
        .map(|p| p.coords.map(|x| x as f32).into());
    let cameras = Cameras {
        views: views(photos, scene, &solved.observations, fit),
        scale: Scale::Nothing,
        scale_sigma: None,
        disk_radius_mm: None,
        ground_mm: 0.0,
        points: points.collect(),
    };
    let circle = camera_circle(&cameras);
    let off = circle.map_or(f64::INFINITY, |c| c.rms / c.radius);
    let circle = circle.filter(|_| off <= p.off_ring);
    let circle = circle.ok_or(TracksError::NoRing { off: off * 100.0 })?;
    if p.motion == Motion::Any {
        let centres: Vec<Point3<f64>> = scene.shots.iter().map(|s| s.pose.centre()).collect();
        unfolded(&centres, circle.centre, &solved.observations)?;
    }
    seen_by_features(&cameras)?;
    let cameras = in_ring_frame(&cameras, RING_MM);
    let mut turned = scene.clone();
    let placed = turned.shots.iter_mut().zip(cameras.views.values());
    placed.for_each(|(shot, view)| shot.pose = view.camera.pose);
    let mut warnings = warnings(photos, &turned, fit, &solved.prior);
    if p.motion != Motion::Any {
        warnings.extend(nudged(photos, &turned));
    }
    warnings.extend(misfits(&cameras));
    for view in cameras.views.values().filter(|v| v.points < 30) {
        warnings.push(message!(FEW_HOLD, count = view.points).of_what(&view.name));
    }
    if share < 0.5 {
        warnings.push(message!(FEW_FIT, share = share * 100.0));
    }
    if !knows_focal(&photos.rig) && fit.lens_sigmas[0][0] > 0.02 * scene.lenses[0].focal[0] {
        warnings.push(message!(NO_FOCAL));
    }
    Ok(Found {
        cameras,
        used_tracks: scene.points.len(),
        rim_tags: 0,
        fit: fit.clone(),
        warnings,
    })
}

/// An error where more than a quarter of the cameras hold on to fewer than [`LEAST_FEATURES`] features.
fn seen_by_features(cameras: &Cameras) -> Result<(), TracksError> {
    let few = cameras
        .views
        .values()
        .filter(|v| (v.points as usize) < LEAST_FEATURES);
    let adrift: Vec<&str> = few.map(|v| v.name.as_str()).collect();
    let of = cameras.views.values().count();
    if 4 * adrift.len() <= of {
        return Ok(());
    }
    Err(TracksError::Adrift {
        few: adrift.len(),
        of,
        least: LEAST_FEATURES as u32,
        names: adrift[..adrift.len().min(5)].join(", "),
    })
}
