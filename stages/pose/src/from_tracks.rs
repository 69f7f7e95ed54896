//! Cameras without a mat: a turn about an unknown axis from features alone, then one adjustment.

use crate::adjust::adjust;
use crate::any_order::grown;
use crate::calibrate::{CalibrateParams, Motion, knows_focal};
use crate::from_mat::{Found, as_given, lens_prior, settings};
use crate::pairs::{chosen, pairs};
use crate::places::{out_of_place, placed};
use crate::ring_start::{Known, starts};
use crate::scene::{Beliefs, Scene, Steps};
use crate::solved::{Solved, told};
use crate::tracks_in::triangulated;
use crate::trust::median_px;
use crate::turn_trial::{filled, spread_px, tried_out};
use shape::{Intrinsics, PhotoId, Photos, Tracks};

/// Why features give no cameras.
#[derive(Debug, thiserror::Error)]
pub enum TracksError {
    /// Photos have too little in common.
    #[error(
        "the photos share too few features that turn with the disk ({pairs} of {of} neighbouring photos do): put a patterned cloth or a marker mat (`tailor mat`) on the disk, or photograph at smaller steps"
    )]
    Apart {
        /// How many neighbours share enough.
        pairs: usize,
        /// How many neighbours there are.
        of: usize,
    },
    /// What was found explains too little.
    #[error(
        "no turn about one axis explains the features: only {share:.0} % of them fit; did the camera move, are the photos out of order, or does the background fill them? A marker mat (`tailor mat`) on the disk helps"
    )]
    Unexplained {
        /// How much it explains. [%]
        share: f64,
    },
    /// Features that fit no better than by chance.
    #[error(
        "features lie {rms:.1} px from where they should (at most {most:.1} px is to be trusted), so the cameras are not: too little texture, a subject that moved, or photos out of order; put a patterned cloth or a marker mat (`tailor mat`) on the disk"
    )]
    Loose {
        /// Root mean square, outliers left out. \[px\]
        rms: f64,
        /// What is borne. \[px\]
        most: f64,
    },
    /// Photos that hold on to nothing.
    #[error(
        "{few} of {of} photos hold on to fewer than {least} features ({names}), so nothing tells where their cameras stood: are they in turning order, at steps below 30°? A patterned cloth or a marker mat (`tailor mat`) on the disk helps"
    )]
    Adrift {
        /// How many do.
        few: usize,
        /// How many photos there are.
        of: usize,
        /// Features that hold a camera.
        least: u32,
        /// Some of them.
        names: String,
    },
    /// No two photos give a beginning.
    #[error(
        "no two photos have enough in common to begin with: photograph at smaller steps, with more texture, or with a marker mat (`tailor mat`) on the disk"
    )]
    NoBeginning,
    /// Cameras that stand on no ring.
    #[error(
        "the cameras came out {off:.1} % off a ring, so they are not to be trusted: are the photos in turning order and the steps below 25°? `focal_35mm` and `step_deg` in capture.toml or a marker mat (`tailor mat`) on the disk help"
    )]
    NoRing {
        /// Root mean square, of the ring's radius. [%]
        off: f64,
    },
}

/// Calibrates from features that move with the disk.
pub(crate) fn calibrate(
    photos: &Photos,
    lens: &Intrinsics,
    tracks: &Tracks,
    p: &CalibrateParams,
) -> Result<Found, TracksError> {
    if p.motion == Motion::Any {
        return told(photos, &grown(photos, lens, tracks, p)?, p);
    }
    let count = photos.photos.len();
    let ids: Vec<PhotoId> = photos.iter().map(|(id, _)| id).collect();
    let shared = pairs(tracks, count, lens.centre);
    let neighbours = shared.iter().filter(|p| p.to == p.from + 1).count();
    if count < 3 || neighbours + 1 < count.div_ceil(2) {
        return Err(TracksError::Apart {
            pairs: neighbours,
            of: count.saturating_sub(1),
        });
    }
    let known_focal = knows_focal(&photos.rig);
    let known = Known {
        photos: count,
        focals_px: focals(photos, lens),
        free_focal: !known_focal,
        step: photos.rig.step.map(f64::abs),
    };
    let tried = starts(&shared, &known);
    let few = chosen(tracks, 500);
    let mut best: Option<(f64, Scene, Vec<i32>)> = None;
    for start in &tried {
        let (start, places) = match known.step {
            Some(_) => placed(&shared, start),
            None => (start.clone(), (0..count as i32).collect()),
        };
        let (score, scene) = tried_out(lens, &start, &ids, &few, p);
        if best.as_ref().is_none_or(|(most, ..)| score > *most) {
            best = Some((score, scene, places));
        }
    }
    let Some((_, mut scene, places)) = best else {
        return Err(TracksError::Apart {
            pairs: neighbours,
            of: count - 1,
        });
    };
    let many = chosen(tracks, p.most_tracks as usize);
    let mut beliefs = beliefs(lens, photos, &scene, &places, p);
    let mut sigma_px = p.feature_px;
    let mut sights = vec![];
    let mut fit = None;
    for round in 0..3 {
        let most = if round == 0 { 16.0 } else { 8.0 * sigma_px };
        let seen = triangulated(&scene.lens, &scene.poses, &ids, &many, most);
        sigma_px = spread_px(&seen).max(p.feature_px);
        sights = filled(&mut scene, &seen, sigma_px);
        fit = Some(adjust(&mut scene, &sights, &beliefs, &settings(p)));
    }
    let free = match p.motion {
        Motion::Auto => photos.rig.step.is_none(),
        Motion::Ring => false,
        Motion::Free | Motion::Any => true,
    };
    // A rigid subject is seen as well from a ring as from free cameras; one that sways is not.
    let swaying = !free && {
        let mut loose = scene.clone();
        loose.ring = None;
        adjust(&mut loose, &sights, &beliefs, &settings(p));
        median_px(&scene, &sights) > p.sway_ratio * median_px(&loose, &sights)
    };
    if swaying {
        // Sway is alike in all features of a photo, so that many of them know no better than one:
        // they would bend the lens (3 % of focal length at 12 mm of sway) and the steps.
        let believed = beliefs.lens.sigma;
        beliefs.lens.sigma = believed.map(|s| s * 1e-3);
        beliefs.steps.iter_mut().for_each(|s| s.sigma *= 0.01);
        // What is held is no better known for that, and nothing tells how far sway moved cameras.
        fit = Some(crate::adjust::Fit {
            lens_sigma: believed,
            sigma_mm: vec![None; count],
            ..adjust(&mut scene, &sights, &beliefs, &settings(p))
        });
    }
    if free {
        scene.ring = None;
        for _ in 0..3 {
            let seen = triangulated(&scene.lens, &scene.poses, &ids, &many, 8.0 * sigma_px);
            sigma_px = spread_px(&seen).max(p.feature_px);
            sights = filled(&mut scene, &seen, sigma_px);
            fit = Some(adjust(&mut scene, &sights, &beliefs, &settings(p)));
        }
    }
    let fit = fit.expect("bug: no round was adjusted");
    let share = scene.points.len() as f64 / many.points.len().max(1) as f64;
    if share < 0.2 {
        return Err(TracksError::Unexplained {
            share: share * 100.0,
        });
    }
    let mut found = told(
        photos,
        &Solved {
            ids,
            scene,
            sights,
            fit,
            share,
            prior: beliefs.lens,
        },
        p,
    )?;
    let names: Vec<&str> = photos.photos.iter().map(|p| p.name.as_str()).collect();
    let step_deg = known.step.unwrap_or(0.0).to_degrees();
    found
        .warnings
        .extend(out_of_place(&names, &places, step_deg));
    if swaying {
        found.warnings.push(
            "the subject moved against the disk (free cameras would follow it): lens and steps were held at what EXIF and capture.toml say, and how sure the cameras are cannot be told".into(),
        );
    }
    Ok(found)
}

/// The focal lengths to try. \[px\]
pub(crate) fn focals(photos: &Photos, lens: &Intrinsics) -> Vec<f64> {
    let longer = f64::from(lens.width.max(lens.height));
    if knows_focal(&photos.rig) {
        return vec![lens.focal[0]];
    }
    [0.8, 1.1, 1.5, 2.1, 3.0].map(|k| k * longer).into()
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
        lens: as_given(
            lens_prior(lens, knows_focal(&photos.rig), p),
            &photos.rig,
            p,
        ),
        steps: photos.rig.step.map(|step| Steps {
            turns: places
                .windows(2)
                .map(|w| f64::from(w[1] - w[0]) * step.abs() * sign)
                .collect(),
            sigma: p.step_sigma_deg.to_radians(),
        }),
        rim: None,
    }
}
