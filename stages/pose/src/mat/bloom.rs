//! Adjusting cameras to square tags whose sides all are a little too far out or in.
//!
//! Ink spreads, bright paper blooms, and nobody knows the camera's tone curve: the four sides of a
//! black square are seen shifted outward by one and the same part of a pixel. Left alone, that
//! shift bends the lens (k1, k2) and through it the focal length. Here it is an unknown of each tag.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::{Fit, Settings, adjusted, fit};
use crate::adjust::damped::weight;
use crate::adjust::rim::straightened;
use crate::adjust::scene::{PointObservation, Scene, scatter_px};
use nalgebra::{Matrix2, Vector2};

/// Most rounds of cameras, then shifts (structural: it converges sooner).
const ROUNDS: usize = 8;
/// Shifts that change less have converged (structural: a thousandth of what corners scatter by). \[px\]
const CONVERGED_PX: f64 = 1e-3;

/// How the corners of a quadrangle move when each side moves outward by one pixel.
pub fn outward(corners: &[[f64; 2]; 4]) -> [Vector2<f64>; 4] {
    let at = corners.map(Vector2::from);
    let middle = (at[0] + at[1] + at[2] + at[3]) / 4.0;
    let normal = |i: usize| {
        let along = at[(i + 1) % 4] - at[i];
        let normal = Vector2::new(along.y, -along.x).normalize();
        normal * (at[i] - middle).dot(&normal).signum()
    };
    [0, 1, 2, 3].map(|i| {
        let (n, m) = (normal((i + 3) % 4), normal(i));
        let sides = Matrix2::new(n.x, n.y, m.x, m.y);
        let back = sides.try_inverse().unwrap_or_else(Matrix2::zeros);
        back * Vector2::new(1.0, 1.0)
    })
}

/// Adjusts to observations that are tags' corners, four a tag. Each tag's shift has mean zero and
/// standard deviation `bloom_px`; it is taken out of the observations. Their standard deviation
/// afterwards is what they scatter by, at least what it was.
pub(crate) fn adjust_tags(
    scene: &mut Scene,
    observations: &mut [PointObservation],
    beliefs: &Beliefs,
    settings: &Settings,
    bloom_px: f64,
) -> Fit {
    let seen: Vec<[f64; 2]> = observations.iter().map(|s| s.at_px).collect();
    adjusted(scene, observations, beliefs, settings, None);
    let mut last = vec![0.0; seen.len() / 4];
    let rounds = bloom_px > 0.0 || scene.rim.is_some();
    for _ in 0..if rounds { ROUNDS } else { 0 } {
        let mut change = 0.0f64;
        for ((tag, seen), last) in observations
            .chunks_exact_mut(4)
            .zip(seen.chunks_exact(4))
            .zip(&mut last)
        {
            let seen = &straight_corners(scene, &tag[0], seen);
            let now = shift(scene, tag, seen, settings.loss, bloom_px);
            change = change.max((now - *last).abs());
            *last = now;
            let out = outward(&[seen[0], seen[1], seen[2], seen[3]]);
            for ((observation, seen), out) in tag.iter_mut().zip(seen).zip(out) {
                observation.at_px = [seen[0] - now * out.x, seen[1] - now * out.y];
            }
        }
        adjusted(scene, observations, beliefs, settings, None);
        if change < CONVERGED_PX {
            break;
        }
    }
    // On the disk and on its rim, corners scatter by what they scatter.
    let on_disk = scene.rim.as_ref().map_or(usize::MAX, |rim| rim.first);
    let split = observations.partition_point(|s| s.point < on_disk);
    let (mat, rim) = observations.split_at_mut(split);
    let mut more = false;
    for part in [mat, rim] {
        let scatter = scatter_px(scene, part);
        if part.first().is_some_and(|s| s.sigma_px < scatter) {
            part.iter_mut().for_each(|s| s.sigma_px = scatter);
            more = true;
        }
    }
    if more {
        adjusted(scene, observations, beliefs, settings, None);
    }
    fit(scene, observations, beliefs, settings)
}

/// A tag's corners where they would be seen if its sides were straight: those of a tag on the rim
/// are arcs.
fn straight_corners(scene: &Scene, first: &PointObservation, seen: &[[f64; 2]]) -> [[f64; 2]; 4] {
    let corners = [seen[0], seen[1], seen[2], seen[3]];
    let off_px = scene.rim.as_ref().and_then(|rim| {
        let at = first.point.checked_sub(rim.first)?;
        straightened(&scene.camera(first.camera), rim, at / 4)
    });
    match off_px {
        None => corners,
        Some(off) => [0, 1, 2, 3].map(|i| (Vector2::from(corners[i]) - off[i]).into()),
    }
}

/// The shift of one tag that fits best where its corners project. \[px\]
fn shift(
    scene: &Scene,
    tag: &[PointObservation],
    seen: &[[f64; 2]],
    loss: f64,
    bloom_px: f64,
) -> f64 {
    let out = outward(&[seen[0], seen[1], seen[2], seen[3]]);
    let sigma = tag[0].sigma_px;
    let (mut top, mut bottom) = (0.0, (sigma / bloom_px).powi(2));
    for ((observation, seen), out) in tag.iter().zip(seen).zip(out) {
        let camera = scene.camera(observation.camera);
        let Some(at) = camera.project(&scene.points[observation.point]) else {
            continue;
        };
        let off = (Vector2::from(observation.at_px) - at.coords) / sigma;
        let weight = weight(off.norm_squared(), loss * loss);
        top += weight * out.dot(&(Vector2::from(*seen) - at.coords));
        bottom += weight * out.norm_squared();
    }
    top / bottom
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::prior::lens_prior;
    use crate::mat::corners::mat_corners;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Camera, Intrinsics, Mat, PhotoId, Pose};

    /// The sides of a moved quadrangle are one pixel further out.
    #[test]
    fn sides_move_by_a_pixel() {
        let corners = [[10.0, 12.0], [60.0, 20.0], [52.0, 70.0], [4.0, 40.0]];
        let out = outward(&corners);
        for i in 0..4 {
            let j = (i + 1) % 4;
            let (a, b) = (Vector2::from(corners[i]), Vector2::from(corners[j]));
            let normal = Vector2::new((b - a).y, -(b - a).x).normalize();
            for k in [i, j] {
                proof::near(out[k].dot(&normal).abs(), 1.0, 1e-12);
                let middle = Vector2::new(31.5, 35.5);
                assert!(out[k].dot(&(a - middle)) > 0.0 || k != i);
            }
        }
    }

    #[test]
    fn cameras_are_found_although_all_tags_look_too_large() {
        let mat = Mat {
            tag_mm: 60.0,
            first_id: 0,
            count: 12,
            ring_mm: 187.0,
        };
        let lens = Intrinsics::simple(1600, 2400, 3350.0);
        let truth: Vec<Pose> = (0..9)
            .map(|i| Pose {
                rotation: Rotation3::from_euler_angles(1.85, 0.01, 0.0)
                    * Rotation3::from_euler_angles(0.0, 0.0, 0.7 * f64::from(i)),
                translation: Vector3::new(5.0, 340.0, 1770.0),
            })
            .collect();
        let shots = (0..).map(PhotoId).zip(truth.iter().copied());
        let mut scene = Scene::of_one_lens(lens, shots);
        let mut observations = vec![];
        for (camera, pose) in truth.iter().enumerate() {
            for id in 0..mat.count {
                let points = mat_corners(&mat, id).unwrap();
                let eye = Camera { lens, pose: *pose };
                let px: [[f64; 2]; 4] = points.map(|p| eye.project(&p).unwrap().into());
                // Nearer tags bloom more, as they are brighter.
                let bloom = -0.1 + 0.15 * (px[0][1] - 1700.0) / 300.0;
                for ((point, px), out) in points.iter().zip(px).zip(outward(&px)) {
                    observations.push(PointObservation {
                        camera,
                        point: scene.points.len(),
                        at_px: [px[0] + bloom * out.x, px[1] + bloom * out.y],
                        sigma_px: 0.02,
                    });
                    scene.points.push(*point);
                }
            }
        }
        scene.known = scene.points.len();
        let params = crate::CalibrateParams {
            focal_sigma: 0.0005,
            ..crate::CalibrateParams::default()
        };
        let beliefs = Beliefs::of_lens(lens_prior(&lens, params.focal_sigma, &params));
        let settings = crate::calibration::prior::settings(&params);
        let off = |bloom_px: f64| {
            let (mut scene, mut observations) = (scene.clone(), observations.clone());
            adjust_tags(&mut scene, &mut observations, &beliefs, &settings, bloom_px);
            let off = |(a, b): (&Camera, &Pose)| (a.centre() - b.centre()).norm();
            let worst = scene
                .cameras()
                .iter()
                .zip(&truth)
                .map(off)
                .fold(0.0, f64::max);
            (worst, scene.lenses[0].radial[0].abs())
        };
        let (plain, modelled) = (off(0.0), off(0.3));
        assert!(modelled.0 < 0.1 && modelled.1 < 1e-3, "{modelled:?}");
        assert!(plain.0 > 5.0 * modelled.0, "{plain:?} {modelled:?}");
    }
}
