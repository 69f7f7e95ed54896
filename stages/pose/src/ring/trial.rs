//! A candidate turn, tried on features: how much of them it explains.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::{Settings, adjusted};
use crate::adjust::residual::MEDIAN_SIGMAS;
use crate::adjust::ring::Ring;
use crate::adjust::scene::Scene;
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::{lens_prior, settings};
use crate::frame::circle::RING_MM;
use crate::ring::start::{Start, on_axis};
use crate::two_view::triangulate::{Seen, median_residual, triangulated};
use nalgebra::{Matrix3, Rotation3, Vector3};
use shape::{Intrinsics, PhotoId, Tracks};

/// The ring of a start: camera zero looks along +y.
fn ring_of(start: &Start) -> Ring {
    let z = start.axis;
    let y = (Vector3::z() - z * z.z).normalize();
    Ring {
        turn: Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[y.cross(&z), y, z])),
        offset: on_axis(&start.axis, start.beside) * RING_MM,
        angles: start.angles.clone(),
    }
}

/// A candidate after a short adjustment: how much it explains, and its scene.
pub(crate) fn tried_out(
    believed: &Intrinsics,
    start: &Start,
    ids: &[PhotoId],
    tracks: &Tracks,
    p: &CalibrateParams,
) -> (f64, Scene) {
    let ring = ring_of(start);
    let lens = Intrinsics {
        focal: [start.focal_px; 2],
        ..*believed
    };
    let mut scene = Scene::of_one_lens(lens, ids.iter().copied().zip(ring.poses()));
    scene.ring = Some(ring);
    let mut beliefs = Beliefs::of_lens(lens_prior(believed, p.focal_sigma, p));
    beliefs.lenses[0].mean[0] = start.focal_px;
    let short = Settings {
        steps: 15,
        ..settings(p)
    };
    for most in [40.0, 20.0] {
        let seen = triangulated(&scene, tracks, most);
        let spots = seen.iter().map(|s| &s.spot);
        let observations = scene.filled(spots, spread_px(&seen).max(p.feature_px));
        adjusted(&mut scene, &observations, &beliefs, &short, None);
    }
    let seen = triangulated(&scene, tracks, 20.0);
    let score = seen.iter().map(|s| 1.0 / (1.0 + s.rms_px * s.rms_px)).sum();
    (score, scene)
}

/// Standard deviation of the observations about their points, by the median. \[px\]
pub(crate) fn spread_px(seen: &[Seen]) -> f64 {
    median_residual(seen).min(100.0) / MEDIAN_SIGMAS
}
