//! Cameras without a mat: a turn about an unknown axis from features alone, then one adjustment.

use crate::adjust::belief::{Beliefs, Steps};
use crate::adjust::bundle::{Fit, Settings, adjust, adjusted};
use crate::adjust::scene::{PointObservation, Scene, median_px};
use crate::calibration::found::Found;
use crate::calibration::params::{CalibrateParams, Motion};
use crate::calibration::prior::{focals, knows_focal, lens_belief};
use crate::ring::any_order;
use crate::ring::cameras::to_cameras;
use crate::ring::error::TracksError;
use crate::ring::pairs::{chosen, pairs};
use crate::ring::places::{Gain, out_of_place, placed};
use crate::ring::stabiliser::{brought, given_back};
use crate::ring::start::{Known, Pair, starts};
use crate::ring::trial::tried_out;
use crate::ring::trusted::Trusted;
use shape::{ByPhoto, Intrinsics, PhotoId, Photos, Placed, Tracks};
use stage::message;

stage::messages! {
    SWAYED = "warn-swayed": "the subject moved against the disk (free cameras would follow it): lens and steps are mostly those of EXIF and capture.toml, and the standard deviations of the cameras are unknown";
}

/// Photos are taken for shifted where features are nearer by this factor once that is taken out. By hand: looked at two
/// captures: halved, centres −7.59 mm for one; doubled, nothing changes (docs/lab/numbers.md).
const STEADIER_FACTOR: f64 = 0.95;

/// A turn that explains a few features, before all of them are adjusted.
struct Beginning {
    scene: Scene,
    /// Each photo's place in the turn, in steps.
    places: Vec<i32>,
}

/// Calibrates from features that move with the disk.
pub(crate) fn calibrate(
    photos: &Photos,
    lens: &Intrinsics,
    tracks: &Tracks,
    steady: Option<&ByPhoto<Placed>>,
    p: &CalibrateParams,
) -> Result<Found, TracksError> {
    if p.motion == Motion::Any {
        return to_cameras(photos, &any_order::solved(photos, lens, tracks, p)?, p);
    }
    let ids: Vec<PhotoId> = photos.iter().map(|(id, _)| id).collect();
    let Beginning { scene, places } = beginning(photos, lens, &ids, tracks, p)?;
    let beliefs = beliefs(lens, photos, &scene, &places, p);
    let lying = Trusted::begun(&scene, tracks, &beliefs, p);
    let brought = steady.map(|places| {
        let tracks = brought(tracks, photos, places);
        Trusted::begun(&scene, &tracks, &beliefs, p)
    });
    let (mut trusted, steady) = match brought {
        Some(brought) if brought.median_px() < STEADIER_FACTOR * lying.median_px() => {
            (brought, steady)
        }
        _ => (lying, None),
    };
    let free = match p.motion {
        Motion::Auto => photos.rig.step.is_none(),
        Motion::Ring => false,
        Motion::Free | Motion::Any => true,
    };
    let swaying = !free && sways(&trusted, &beliefs, p);
    if swaying {
        trusted.fit = adjusted_as_one(&mut trusted, &beliefs);
    }
    if free {
        trusted.scene.ring = None;
        (0..3).for_each(|_| trusted.again(&beliefs, p));
    }
    let solved = trusted.solved(beliefs.lenses[0]);
    if solved.share < 0.2 {
        return Err(TracksError::Unexplained {
            share: solved.share * 100.0,
        });
    }
    let mut found = to_cameras(photos, &solved, p)?;
    if let Some(steady) = steady {
        given_back(&mut found.cameras, steady);
    }
    let names: Vec<&str> = photos.photos.iter().map(|p| p.name.as_str()).collect();
    let step_deg = photos.rig.step.map_or(0.0, f64::abs).to_degrees();
    found
        .warnings
        .extend(out_of_place(&names, &places, step_deg));
    if swaying {
        found.warnings.push(message!(SWAYED));
    }
    Ok(found)
}

/// The turn from which the adjustment begins; an error where too few neighbours share features.
fn beginning(
    photos: &Photos,
    lens: &Intrinsics,
    ids: &[PhotoId],
    tracks: &Tracks,
    p: &CalibrateParams,
) -> Result<Beginning, TracksError> {
    let count = ids.len();
    let shared = pairs(tracks, count, lens.centre, p.far_px());
    let neighbours = shared.iter().filter(|p| p.to == p.from + 1).count();
    let apart = TracksError::Apart {
        pairs: neighbours,
        of: count.saturating_sub(1),
    };
    if count < 3 || neighbours + 1 < count.div_ceil(2) {
        return Err(apart);
    }
    let known = Known {
        photos: count,
        focals_px: focals(photos, lens),
        free_focal: !knows_focal(&photos.rig),
        step: photos.rig.step.map(f64::abs),
    };
    best_turn(lens, &shared, &known, ids, tracks, p).ok_or(apart)
}

/// Adjusts cameras of a subject that sways against the disk.
///
/// Sway is alike in all features of a photo, so that all of them together know no better than one: as sure as they seem,
/// they would bend lens (3 % of focal length at 12 mm of sway) and steps. So their variance is as many times larger.
fn adjusted_as_one(trusted: &mut Trusted, beliefs: &Beliefs) -> Fit {
    let shots = trusted.scene.shots.len();
    let times = (trusted.observations.len() as f64 / shots.max(1) as f64).sqrt();
    let unsure = |o: &PointObservation| PointObservation {
        sigma_px: times * o.sigma_px,
        ..*o
    };
    let observations: Vec<PointObservation> = trusted.observations.iter().map(unsure).collect();
    // What is far off is so by what features scatter by.
    let how = Settings {
        loss: trusted.how.loss / times,
        ..trusted.how
    };
    // Nothing shows how far sway moved cameras.
    Fit {
        lens_sigmas: vec![beliefs.lenses[0].sigma],
        sigma_mm: vec![None; shots],
        ..adjust(&mut trusted.scene, &observations, beliefs, &how)
    }
}

/// Of all turns that pairs of photos suggest, the one that explains most of a few features.
fn best_turn(
    lens: &Intrinsics,
    shared: &[Pair],
    known: &Known,
    ids: &[PhotoId],
    tracks: &Tracks,
    p: &CalibrateParams,
) -> Option<Beginning> {
    let few = chosen(tracks, 500);
    let mut best: Option<(f64, Beginning)> = None;
    for start in &starts(shared, known) {
        let (start, places) = match known.step {
            Some(_) => placed(shared, start, Gain::of(p)),
            None => (start.clone(), (0..known.photos as i32).collect()),
        };
        let (score, scene) = tried_out(lens, &start, ids, &few, p);
        if best.as_ref().is_none_or(|(most, _)| score > *most) {
            best = Some((score, Beginning { scene, places }));
        }
    }
    best.map(|(_, beginning)| beginning)
}

/// Whether the subject sways: a rigid one is seen as well from a ring as from free cameras.
fn sways(trusted: &Trusted, beliefs: &Beliefs, p: &CalibrateParams) -> bool {
    let mut loose = trusted.scene.clone();
    loose.ring = None;
    adjusted(
        &mut loose,
        &trusted.observations,
        beliefs,
        &trusted.how,
        None,
    );
    trusted.median_px() > p.sway_ratio * median_px(&loose, &trusted.observations)
}

/// What is believed of lens and ring once the direction of the turn and the photos' places are known.
fn beliefs(
    lens: &Intrinsics,
    photos: &Photos,
    scene: &Scene,
    places: &[i32],
    p: &CalibrateParams,
) -> Beliefs {
    let sign = scene.ring.as_ref().and_then(|r| r.angles.last().copied());
    let sign = sign.unwrap_or(1.0).signum();
    Beliefs {
        lenses: vec![lens_belief(lens, &photos.rig, p)],
        steps: photos.rig.step.map(|step| Steps {
            turns: places
                .windows(2)
                .map(|w| f64::from(w[1] - w[0]) * step.abs() * sign)
                .collect(),
            sigma: p.step_sigma_deg.to_radians(),
        }),
        ..Beliefs::default()
    }
}
