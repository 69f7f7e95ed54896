//! One more photo among known points: three points at a time, and all that agree where more do than
//! before (LO-RANSAC; Chum, Matas and Kittler 2003).

use crate::adjust::damped::{pose_moved, weight};
use crate::adjust::residual::{POSE, derivatives, off_px};
use crate::two_view::epipolar::draws;
use crate::walk::p3p::three_points;
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use shape::{Camera, Intrinsics, Pose};

/// A known point, and where the photo shows it. \[px\]
pub(crate) type Known = (Point3<f64>, [f64; 2]);

/// A pose, and how many points agree.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) pose: Pose,
    pub(crate) agree: usize,
}

/// How samples are drawn.
#[derive(Clone, Copy)]
pub(crate) struct Samples {
    /// A point agrees within. \[px\]
    pub(crate) near_px: f64,
    /// Most samples.
    pub(crate) rounds: usize,
    /// Seed.
    pub(crate) seed: u64,
}

/// The pose with which most points agree.
pub(crate) fn registered(lens: &Intrinsics, known: &[Known], samples: &Samples) -> Option<Placed> {
    if known.len() < 4 {
        return None;
    }
    let ray = |px: [f64; 2]| {
        let p = lens.undistort(px.into());
        Vector3::new(p.x, p.y, 1.0).normalize()
    };
    let rays: Vec<Vector3<f64>> = known.iter().map(|(_, px)| ray(*px)).collect();
    let mut draw = draws(samples.seed, known.len());
    let count = |pose: &Pose, most: f64| agreeing(lens, pose, known, most).count();
    let mut best: Option<Placed> = None;
    let (mut need, mut done) = (samples.rounds, 0);
    while done < need.min(samples.rounds) {
        done += 1;
        let at = [draw(), draw(), draw()];
        let poses = three_points(&at.map(|i| known[i].0), &at.map(|i| rays[i]));
        for pose in poses {
            let agree = count(&pose, samples.near_px);
            if agree <= best.map_or(3, |b| b.agree) {
                continue;
            }
            let mut found = Placed { pose, agree };
            for widen in [2.0, 1.0, 1.0] {
                let inside: Vec<Known> =
                    agreeing(lens, &found.pose, known, widen * samples.near_px).collect();
                let pose = polished(lens, &found.pose, &inside, samples.near_px / 2.0);
                let agree = count(&pose, samples.near_px);
                if agree >= found.agree {
                    found = Placed { pose, agree };
                }
            }
            best = Some(found);
            let share = (found.agree as f64 / known.len() as f64).powi(3);
            let misses = libm::log(1.0 - share.clamp(1e-9, 0.999_999));
            need = (libm::log(1e-4f64) / misses).ceil().max(30.0) as usize;
        }
    }
    best
}

/// The points that agree with a pose.
fn agreeing<'a>(
    lens: &Intrinsics,
    pose: &Pose,
    known: &'a [Known],
    most_px: f64,
) -> impl Iterator<Item = Known> + 'a {
    let camera = Camera {
        lens: *lens,
        pose: *pose,
    };
    let near = move |k: &&Known| off_px(&camera, &k.0, k.1).is_some_and(|off| off < most_px);
    known.iter().filter(near).copied()
}

/// Gauss–Newton on the pixels, with Cauchy's weights.
fn polished(lens: &Intrinsics, start: &Pose, known: &[Known], loss_px: f64) -> Pose {
    let mut pose = *start;
    for _ in 0..6 {
        let camera = Camera { lens: *lens, pose };
        let (mut h, mut g) = (Matrix6::zeros(), Vector6::zeros());
        for (point, px) in known {
            let Some(d) = derivatives(&camera, 0.0, point, *px, loss_px) else {
                continue;
            };
            let weight = weight(d.residual.norm_squared(), 1.0);
            let j = d.by_shot.fixed_columns::<POSE>(0);
            h += j.transpose() * j * weight;
            g -= j.transpose() * d.residual * weight;
        }
        let Some(step) = h.cholesky().map(|c| c.solve(&g)) else {
            break;
        };
        pose = pose_moved(&pose, step.as_slice());
    }
    pose
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn a_wide_camera_is_found_though_half_of_the_points_are_wrong() {
        let lens = Intrinsics::simple(1200, 1600, 1100.0);
        let truth = Pose {
            rotation: Rotation3::from_euler_angles(2.9, 0.4, 1.2),
            translation: Vector3::new(0.1, -0.2, 2.0),
        };
        let camera = Camera { lens, pose: truth };
        let mut dice = proof::Dice(3);
        let mut known: Vec<Known> = Vec::new();
        while known.len() < 200 {
            let mut x = || dice.within(-3.0, 3.0);
            let point = Point3::new(x(), x(), x());
            let Some(at) = camera.project(&point).filter(|at| camera.holds(*at)) else {
                continue;
            };
            let wrong = if known.len().is_multiple_of(2) {
                200.0
            } else {
                0.4
            };
            known.push((
                point,
                [at.x + wrong * dice.normal(), at.y + wrong * dice.normal()],
            ));
        }
        let samples = Samples {
            near_px: 3.0,
            rounds: 1000,
            seed: 1,
        };
        let found = registered(&lens, &known, &samples).unwrap();
        assert!(found.agree >= 95, "{}", found.agree);
        assert!(found.pose.rotation.angle_to(&truth.rotation) < 1e-3);
        assert!((found.pose.centre() - truth.centre()).norm() < 3e-3);
    }
}
