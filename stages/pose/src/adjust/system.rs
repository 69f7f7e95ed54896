//! The normal equations of an adjustment with what is believed and what is fixed, and the
//! standard deviations from their inverse.

use crate::adjust::damped::{FIXED, System, centre_by_pose, centre_sigma, farthest};
use crate::adjust::lens::{LENS, lens_values};
use crate::adjust::normal::{Block, Normal, Point};
use crate::adjust::ring::Ring;
use crate::adjust::scene::{Beliefs, PointObservation, Scene, look};
use nalgebra::{DMatrix, DVector, Vector3};
use shape::Pose;

/// What a step of a scene needs beside its own unknowns: lens and poses, or lens and ring.
pub(crate) struct Rest {
    /// Derivative of lens and poses by the unknowns, where those are not the poses.
    pub(crate) tangent: Option<DMatrix<f64>>,
    pub(crate) reduced: Normal,
}

/// The system of the lens, six unknowns a camera (rotation, translation) and the open numbers of tags
/// on a rim, from the observations of each point; `loss` is Cauchy's c.
fn reduce(scene: &Scene, by_point: &[Vec<PointObservation>], loss: f64, damping: f64) -> Normal {
    let poses = LENS + 6 * scene.poses.len();
    let mut normal = Normal::new(poses + scene.rim.as_ref().map_or(0, |rim| rim.unknowns()));
    for (p, observations) in by_point.iter().enumerate() {
        let open = scene.rim.as_ref().and_then(|rim| {
            let corner = p.checked_sub(rim.first).filter(|_| p < scene.known)?;
            Some(rim.by_open(corner))
        });
        let mut free = (p >= scene.known).then(Point::default);
        for observation in observations {
            let Some(d) = look(scene, observation) else {
                continue;
            };
            let by_lens = d.by_unknown.fixed_columns::<LENS>(0).into_owned();
            let by_pose = d.by_unknown.fixed_columns::<6>(LENS).into_owned();
            let mut blocks = vec![
                Block::new(0, &by_lens),
                Block::new(LENS + 6 * observation.camera, &by_pose),
            ];
            if let Some((which, by_open)) = &open {
                let by = d.by_point * by_open;
                let one =
                    |(k, i): (usize, &usize)| Block::new(poses + i, &by.column(k).into_owned());
                blocks.extend(which.iter().enumerate().map(one));
            }
            let point = free.as_mut().map(|point| (point, &d.by_point));
            normal.observe(&d.residual, &blocks, point, loss * loss);
        }
        if let Some(point) = free {
            normal.eliminate(point, damping);
        }
    }
    normal.complete()
}

/// Builds it.
pub(crate) fn system(
    scene: &Scene,
    by_point: &[Vec<PointObservation>],
    beliefs: &Beliefs,
    loss: f64,
    damping: f64,
) -> System<Rest> {
    let reduced = reduce(scene, by_point, loss, damping);
    let tangent = scene.ring.as_ref().map(Ring::tangent);
    let (mut matrix, mut right) = match &tangent {
        Some(j) => (
            j.transpose() * &reduced.matrix * j,
            j.transpose() * &reduced.right,
        ),
        None => (reduced.matrix.clone(), reduced.right.clone()),
    };
    let (values, prior) = (lens_values(&scene.lens), &beliefs.lens);
    for i in 0..LENS {
        let weight = 1.0 / (prior.sigma[i] * prior.sigma[i]);
        matrix[(i, i)] += weight;
        right[i] -= weight * (values[i] - prior.mean[i]);
    }
    if let (Some(ring), Some(steps)) = (&scene.ring, &beliefs.steps) {
        let weight = 1.0 / (steps.sigma * steps.sigma);
        for (k, (a, turn)) in ring.angles.windows(2).zip(&steps.turns).enumerate() {
            let (i, j) = (LENS + 6 + k, LENS + 7 + k);
            let off = weight * (a[1] - a[0] - turn);
            matrix[(i, i)] += weight;
            matrix[(j, j)] += weight;
            matrix[(i, j)] -= weight;
            matrix[(j, i)] -= weight;
            right[i] += off;
            right[j] -= off;
        }
    }
    if let (Some(rim), Some(belief)) = (&scene.rim, &beliefs.rim) {
        let from = LENS + 6 * scene.poses.len();
        for (i, (value, sigma)) in rim.beliefs(belief).enumerate() {
            matrix[(from + i, from + i)] += 1.0 / (sigma * sigma);
            right[from + i] -= value / (sigma * sigma);
        }
    }
    for (direction, size) in freedoms(scene) {
        let d = DVector::from_vec(direction);
        matrix += &d * d.transpose() * (FIXED / (size * size));
    }
    System {
        matrix,
        right,
        rest: Rest { tangent, reduced },
    }
}

/// Directions of a step that change nothing that is seen, with the size of a unit each: none where
/// points are known.
fn freedoms(scene: &Scene) -> Vec<(Vec<f64>, f64)> {
    if scene.known > 0 {
        return vec![];
    }
    if let Some(ring) = &scene.ring {
        return ring.freedoms();
    }
    let n = LENS + 6 * scene.poses.len();
    // The first camera stays, and so does its distance to the farthest.
    let Some((last, along, size)) = farthest(&scene.poses) else {
        return vec![];
    };
    let mut fixed: Vec<_> = (0..6)
        .map(|i| {
            let mut d = vec![0.0; n];
            d[LENS + i] = 1.0;
            (d, if i < 3 { 1.0 } else { size })
        })
        .collect();
    let mut d = vec![0.0; n];
    (0..3).for_each(|i| d[LENS + 6 * last + 3 + i] = along[i]);
    fixed.push((d, size));
    fixed
}

/// Standard deviations from the inverse of the undamped system.
pub(crate) struct Spread {
    /// Of each camera's centre, a coordinate's root mean square. \[mm\]
    pub(crate) centres_mm: Vec<f64>,
    /// Of the lens' unknowns.
    pub(crate) lens: [f64; LENS],
    /// Of the cameras' mean distance from their middle, as a share of it.
    pub(crate) size: f64,
}

/// Those of a scene that is adjusted.
pub(crate) fn spread(
    scene: &Scene,
    by_point: &[Vec<PointObservation>],
    beliefs: &Beliefs,
    loss: f64,
) -> Spread {
    let system = system(scene, by_point, beliefs, loss, 1e-9);
    let Some(covariance) = system.matrix.cholesky().map(|c| c.inverse()) else {
        return Spread {
            centres_mm: vec![f64::INFINITY; scene.poses.len()],
            lens: [f64::INFINITY; LENS],
            size: f64::INFINITY,
        };
    };
    let covariance = match &system.rest.tangent {
        Some(j) => j * covariance * j.transpose(),
        None => covariance,
    };
    let centre = |(c, pose): (usize, &Pose)| {
        let block = covariance.fixed_view::<6, 6>(LENS + 6 * c, LENS + 6 * c);
        centre_sigma(pose, &block.into_owned())
    };
    let centres_mm = scene.poses.iter().enumerate().map(centre).collect();
    let mut lens = [0.0; LENS];
    (0..LENS).for_each(|i| lens[i] = covariance[(i, i)].max(0.0).sqrt());
    let middle = scene
        .poses
        .iter()
        .map(|p| p.centre().coords)
        .sum::<Vector3<f64>>()
        / scene.poses.len().max(1) as f64;
    let (mut by_all, mut total) = (DVector::zeros(covariance.nrows()), 0.0);
    for (c, pose) in scene.poses.iter().enumerate() {
        let out = pose.centre().coords - middle;
        total += out.norm();
        let row = centre_by_pose(pose).transpose() * out.try_normalize(1e-12).unwrap_or_default();
        by_all.fixed_rows_mut::<6>(LENS + 6 * c).copy_from(&row);
    }
    let size = by_all.dot(&(&covariance * &by_all)).max(0.0).sqrt() / total.max(1e-12);
    Spread {
        centres_mm,
        lens,
        size,
    }
}
