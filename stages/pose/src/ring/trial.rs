//! A candidate turn, tried on features: how much of them it explains.

use crate::adjust::bundle::adjust;
use crate::adjust::residual::MEDIAN_SIGMAS;
use crate::adjust::ring::Ring;
use crate::adjust::scene::{Beliefs, PointObservation, Scene};
use crate::calibration::params::CalibrateParams;
use crate::calibration::prior::{lens_prior, settings};
use crate::frame::circle::RING_MM;
use crate::ring::start::{Start, on_axis};
use crate::two_view::triangulate::{Seen, triangulated};
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

/// A scene's points and observations from triangulated tracks.
pub(crate) fn filled(scene: &mut Scene, seen: &[Seen], sigma_px: f64) -> Vec<PointObservation> {
    scene.points = seen.iter().map(|s| s.point).collect();
    let observation = |(point, seen): (usize, &Seen)| -> Vec<PointObservation> {
        let one = |(camera, at_px): &(usize, [f64; 2])| PointObservation {
            camera: *camera,
            point,
            at_px: *at_px,
            sigma_px,
        };
        seen.observations.iter().map(one).collect()
    };
    seen.iter().enumerate().flat_map(observation).collect()
}

/// A candidate after a short adjustment: how much it explains, and its scene.
pub(crate) fn tried_out(
    lens: &Intrinsics,
    start: &Start,
    ids: &[PhotoId],
    tracks: &Tracks,
    p: &CalibrateParams,
) -> (f64, Scene) {
    let ring = ring_of(start);
    let mut scene = Scene {
        lens: Intrinsics {
            focal: [start.focal_px; 2],
            ..*lens
        },
        poses: ring.poses(),
        ring: Some(ring),
        points: vec![],
        known: 0,
        rim: None,
    };
    let mut beliefs = Beliefs {
        lens: lens_prior(lens, p.focal_sigma, p),
        steps: None,
        rim: None,
    };
    beliefs.lens.mean[0] = start.focal_px;
    let short = crate::adjust::scene::Settings {
        steps: 15,
        ..settings(p)
    };
    for most in [40.0, 20.0] {
        let seen = triangulated(&scene.lens, &scene.poses, ids, tracks, most);
        let observations = filled(&mut scene, &seen, spread_px(&seen).max(p.feature_px));
        adjust(&mut scene, &observations, &beliefs, &short);
    }
    let seen = triangulated(&scene.lens, &scene.poses, ids, tracks, 20.0);
    let score = seen.iter().map(|s| 1.0 / (1.0 + s.rms_px * s.rms_px)).sum();
    (score, scene)
}

/// Standard deviation of the observations about their points, by the median. \[px\]
pub(crate) fn spread_px(seen: &[Seen]) -> f64 {
    crate::two_view::triangulate::median_residual(seen).min(100.0) / MEDIAN_SIGMAS
}
