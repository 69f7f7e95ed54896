//! Tracks as points in the world: triangulation from known cameras.

use crate::adjust::scene::{Scene, Spot};
use shape::{Tracks, triangulate};

/// A triangulated track.
pub(crate) struct Seen {
    pub(crate) spot: Spot,
    pub(crate) rms_px: f64,
}

/// The tracks whose points project within `most_px` of where they were seen.
pub(crate) fn triangulated(scene: &Scene, tracks: &Tracks, most_px: f64) -> Vec<Seen> {
    let cameras = scene.cameras();
    let one = |track: &Vec<shape::Observation>| {
        let place = |s: &shape::Observation| {
            let camera = scene.shots.iter().position(|shot| shot.photo == s.photo)?;
            Some((camera, s.at_px.map(f64::from)))
        };
        let observations: Vec<(usize, [f64; 2])> = track.iter().filter_map(place).collect();
        let (at, rms_px) = triangulate(&cameras, &observations)?;
        (rms_px < most_px).then_some(Seen {
            spot: Spot { at, observations },
            rms_px,
        })
    };
    tracks.points.iter().filter_map(one).collect()
}

/// Median of the tracks' residuals. \[px\]
pub(crate) fn median_residual(seen: &[Seen]) -> f64 {
    shape::upper_median(seen.iter().map(|s| s.rms_px)).unwrap_or(f64::MAX)
}
