//! Tracks as points in the world: triangulation from known cameras.

use nalgebra::Point3;
use shape::{Camera, Intrinsics, PhotoId, Pose, Tracks, triangulate};

/// A triangulated track: cameras by their place in the list, pixels.
pub(crate) struct Seen {
    pub(crate) point: Point3<f64>,
    pub(crate) observations: Vec<(usize, [f64; 2])>,
    pub(crate) rms_px: f64,
}

/// The tracks whose points project within `most_px` of where they were seen.
pub(crate) fn triangulated(
    lens: &Intrinsics,
    poses: &[Pose],
    ids: &[PhotoId],
    tracks: &Tracks,
    most_px: f64,
) -> Vec<Seen> {
    let cameras: Vec<Camera> = poses
        .iter()
        .map(|pose| Camera {
            lens: *lens,
            pose: *pose,
        })
        .collect();
    let one = |track: &Vec<shape::Observation>| {
        let place = |s: &shape::Observation| {
            let camera = ids.iter().position(|id| *id == s.photo)?;
            Some((camera, s.at_px.map(f64::from)))
        };
        let observations: Vec<(usize, [f64; 2])> = track.iter().filter_map(place).collect();
        let (point, rms_px) = triangulate(&cameras, &observations)?;
        (rms_px < most_px).then_some(Seen {
            point,
            observations,
            rms_px,
        })
    };
    tracks.points.iter().filter_map(one).collect()
}

/// Median of the tracks' residuals. \[px\]
pub(crate) fn median_residual(seen: &[Seen]) -> f64 {
    shape::upper_median(seen.iter().map(|s| s.rms_px)).unwrap_or(f64::MAX)
}
