//! Cameras of photos in any order: grown as those of a walk, one photo more at a time, then adjusted to all features.

use crate::adjust::belief::Beliefs;
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::{focals, lens_belief};
use crate::ring::cameras::Solved;
use crate::ring::error::TracksError;
use crate::ring::trusted::Trusted;
use crate::walk::groups::Groups;
use crate::walk::grow::grown;
use crate::walk::rules::Growth;
use crate::walk::seen::Seen;
use crate::walk::stage::{WalkParams, growth};
use shape::{Intrinsics, Photos, Tracks};

/// Cameras of all photos that hold on to the rest, from the focal length that explains most.
pub(crate) fn solved(
    photos: &Photos,
    lens: &Intrinsics,
    tracks: &Tracks,
    p: &CalibrateParams,
) -> Result<Solved, TracksError> {
    let believed = lens_belief(lens, &photos.rig, p);
    let count = photos.photos.len();
    let groups = Groups {
        of: vec![0; count],
        lenses: vec![*lens],
        priors: vec![believed],
        factors: focals(photos, lens)
            .iter()
            .map(|f| f / lens.focal[0])
            .collect(),
    };
    // What is seen and believed is a turn's, the rest as of a walk.
    let walk = WalkParams {
        near_px: 2.0 * p.most_px,
        feature_px: p.feature_px,
        loss: p.loss,
        grow_tracks: p.most_tracks,
        ..WalkParams::default()
    };
    let rules = Growth {
        spread: false,
        ..growth(&walk, photos, &groups)
    };
    let seen = Seen::new(tracks, count, |_, at| at);
    let grown = grown(&seen, &groups, &rules).ok_or(TracksError::NoBeginning)?;
    let mut scene = grown.with_points(0, p.feature_px).0;
    // By photo, as everybody expects; focusing is within what features scatter.
    scene.shots.sort_by_key(|s| s.photo);
    scene.shots.iter_mut().for_each(|s| s.zoom = 0.0);
    let beliefs = Beliefs::of_lens(believed);
    Ok(Trusted::begun(&scene, tracks, &beliefs, p).solved(believed))
}
