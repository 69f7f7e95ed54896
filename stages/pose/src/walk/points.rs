//! Tracks as points of a scene: those of their observations that agree.

use crate::adjust::residual::off_px;
use crate::adjust::scene::{Scene, Spot};
use crate::walk::seen::Seen;
use rayon::prelude::*;
use shape::triangulate;
use shape::{Camera, PhotoId};

/// Most pairs of observations of which a point is tried (structural: the width of a search).
const TRIES: usize = 15;

/// Which shot a photo is, by photo.
pub(crate) fn places(scene: &Scene, photos: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; photos];
    for (s, shot) in scene.shots.iter().enumerate() {
        places[shot.photo.0 as usize] = Some(s);
    }
    places
}

/// The points of some tracks, by track, as the shots there are see them.
pub(crate) fn spots(
    scene: &Scene,
    seen: &Seen,
    which: &[usize],
    near_px: f64,
) -> Vec<Option<Spot>> {
    let cameras = scene.cameras();
    let places = places(scene, seen.by_photo.len());
    let one = |t: &usize| {
        let place = |(photo, px): &(PhotoId, [f64; 2])| Some((places[photo.0 as usize]?, *px));
        let observations: Vec<(usize, [f64; 2])> =
            seen.tracks[*t].iter().filter_map(place).collect();
        spot(&cameras, &observations, near_px)
    };
    which.par_iter().map(one).collect()
}

/// The point with which most observations agree, at least two and at least half.
fn spot(cameras: &[Camera], observations: &[(usize, [f64; 2])], near_px: f64) -> Option<Spot> {
    let near = |at: &nalgebra::Point3<f64>, (c, px): &(usize, [f64; 2])| {
        off_px(&cameras[*c], at, *px).is_some_and(|off| off < near_px)
    };
    let inside = |at: &nalgebra::Point3<f64>| -> Vec<(usize, [f64; 2])> {
        observations
            .iter()
            .filter(|s| near(at, s))
            .copied()
            .collect()
    };
    if observations.len() < 2 {
        return None;
    }
    if let Some((at, _)) = triangulate(cameras, observations)
        && observations.iter().all(|s| near(&at, s))
    {
        return Some(Spot {
            at,
            observations: observations.to_vec(),
        });
    }
    let n = observations.len();
    if n == 2 {
        return None;
    }
    let pairs: Vec<(usize, usize)> = (0..n)
        .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
        .collect();
    let stride = pairs.len().div_ceil(TRIES);
    let mut best: Vec<(usize, [f64; 2])> = Vec::new();
    for (i, j) in pairs.into_iter().step_by(stride) {
        if let Some((at, _)) = triangulate(cameras, &[observations[i], observations[j]]) {
            let agree = inside(&at);
            if agree.len() > best.len() {
                best = agree;
            }
        }
    }
    if best.len() < 2 || 2 * best.len() < n {
        return None;
    }
    let (at, _) = triangulate(cameras, &best)?;
    let agree = inside(&at);
    (agree.len() >= 2 && 2 * agree.len() >= n).then_some(Spot {
        at,
        observations: agree,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3, Vector3};
    use shape::{Intrinsics, Pose};

    #[test]
    fn a_wrong_sighting_is_left_out_and_two_that_contradict_are_no_point() {
        let lens = Intrinsics::simple(1200, 1600, 1100.0);
        let camera = |k: i32| Camera {
            lens,
            pose: Pose {
                rotation: Rotation3::from_euler_angles(0.0, 0.2 * f64::from(k), 0.0),
                translation: Vector3::new(0.0, 0.0, 3.0),
            },
        };
        let cameras: Vec<Camera> = (0..5).map(camera).collect();
        let point = Point3::new(0.2, 0.3, -0.1);
        let mut observations: Vec<(usize, [f64; 2])> = cameras
            .iter()
            .enumerate()
            .map(|(c, camera)| (c, camera.project(&point).unwrap().into()))
            .collect();
        observations[3].1[1] += 60.0;
        let found = spot(&cameras, &observations, 3.0).unwrap();
        assert_eq!(
            found.observations.iter().map(|s| s.0).collect::<Vec<_>>(),
            [0, 1, 2, 4]
        );
        assert!((found.at - point).norm() < 1e-9);
        assert_eq!(
            spot(&cameras, &[observations[0], observations[3]], 3.0),
            None
        );
    }
}
