//! Bundle adjustment: cameras, one lens and points that explain what was seen (Triggs, McLauchlan,
//! Hartley and Fitzgibbon 1999).
//!
//! Minimises Σ ρ(‖r‖²/σ²) + priors by Levenberg–Marquardt; points are eliminated by the Schur
//! complement, so that the system solved has 5 + 6 · cameras unknowns. ρ is Cauchy's,
//! ρ(s) = c² ln(1 + s/c²), by reweighting.

use crate::residual::{Derivatives, derivatives};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, SMatrix, Vector3};
use shape::{Camera, Intrinsics, Pose};

/// Unknowns of the lens: focal length, principal point x and y, k1, k2.
pub const LENS: usize = 5;

/// What was seen: a camera, a point, a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Which camera.
    pub camera: usize,
    /// Which point.
    pub point: usize,
    /// Where. [px]
    pub at_px: [f64; 2],
    /// Standard deviation of that. [px]
    pub sigma_px: f64,
}

/// All that is adjusted.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The lens that all cameras share.
    pub lens: Intrinsics,
    /// camera_from_world of each camera.
    pub poses: Vec<Pose>,
    /// Points in the world. [mm]
    pub points: Vec<Point3<f64>>,
    /// Points before this one are known and stay; those from it on are free.
    pub known: usize,
}

/// A belief about the lens: mean and standard deviation of each of its unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensPrior {
    /// Mean.
    pub mean: [f64; LENS],
    /// Standard deviation; infinite for no belief.
    pub sigma: [f64; LENS],
}

/// How to adjust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Residuals beyond this many standard deviations lose weight (Cauchy's c).
    pub loss: f64,
    /// Most steps.
    pub steps: usize,
}

/// What came out beside the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root mean square of the residuals, those beyond three times the loss left out. [px]
    pub rms_px: f64,
    /// The cost before and after each accepted step; never rises.
    pub costs: Vec<f64>,
    /// Standard deviation of each camera's centre. [mm]
    pub sigma_mm: Vec<f64>,
    /// Standard deviation of the lens' unknowns.
    pub lens_sigma: [f64; LENS],
}

/// The lens' unknowns as numbers.
pub(crate) fn lens_values(lens: &Intrinsics) -> [f64; LENS] {
    [
        lens.focal[0],
        lens.centre[0],
        lens.centre[1],
        lens.radial[0],
        lens.radial[1],
    ]
}

/// The lens with other values.
pub(crate) fn lens_with(lens: &Intrinsics, [f, x, y, k1, k2]: [f64; LENS]) -> Intrinsics {
    Intrinsics {
        focal: [f, f],
        centre: [x, y],
        radial: [k1, k2],
        ..*lens
    }
}

/// Residual of a sighting in standard deviations, with derivatives. `None` behind the camera.
fn look(scene: &Scene, sight: &Sight) -> Option<Derivatives> {
    let camera = Camera {
        lens: scene.lens,
        pose: scene.poses[sight.camera],
    };
    derivatives(
        &camera,
        &scene.points[sight.point],
        sight.at_px,
        sight.sigma_px,
    )
}

/// Cost of a point behind a camera, in place of its infinite one.
const BEHIND: f64 = 1e6;

/// The cost that is minimised.
pub fn cost(scene: &Scene, sights: &[Sight], prior: &LensPrior, loss: f64) -> f64 {
    let c2 = loss * loss;
    let seen: f64 = sights
        .iter()
        .map(|sight| match look(scene, sight) {
            Some(d) => c2 * (d.residual.norm_squared() / c2).ln_1p(),
            None => BEHIND,
        })
        .sum();
    let values = lens_values(&scene.lens);
    seen + (0..LENS)
        .map(|i| ((values[i] - prior.mean[i]) / prior.sigma[i]).powi(2))
        .sum::<f64>()
}

/// The normal equations with points eliminated.
struct Reduced {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    /// For each free point: the inverse of its block, its right side, and its coupling to unknowns.
    points: Vec<(Matrix3<f64>, Vector3<f64>, Vec<(usize, SMatrix<f64, 1, 3>)>)>,
}

/// Adjusts a scene in place.
pub fn adjust(scene: &mut Scene, sights: &[Sight], prior: &LensPrior, settings: &Settings) -> Fit {
    let mut by_point: Vec<Vec<Sight>> = vec![Vec::new(); scene.points.len()];
    sights.iter().for_each(|s| by_point[s.point].push(*s));
    let mut now = cost(scene, sights, prior, settings.loss);
    let (mut costs, mut damping) = (vec![now], 1e-4);
    for _ in 0..settings.steps {
        let system = reduce(scene, &by_point, prior, settings.loss, damping);
        let stepped = system.matrix.clone().cholesky().map(|c| {
            let step = c.solve(&system.right);
            moved(scene, &system, &step)
        });
        let next = stepped.map(|s| (cost(&s, sights, prior, settings.loss), s));
        match next {
            Some((better, stepped)) if better < now => {
                let gain = (now - better) / now.max(f64::MIN_POSITIVE);
                (*scene, now) = (stepped, better);
                costs.push(now);
                damping = (damping * 0.2f64).max(1e-12);
                if gain < 1e-9 {
                    break;
                }
            }
            _ => {
                damping *= 8.0;
                if damping > 1e10 {
                    break;
                }
            }
        }
    }
    let (sigma_mm, lens_sigma) = spread(scene, &by_point, prior, settings.loss);
    Fit {
        rms_px: rms(scene, sights, settings.loss),
        costs,
        sigma_mm,
        lens_sigma,
    }
}

fn rms(scene: &Scene, sights: &[Sight], loss: f64) -> f64 {
    let near = sights.iter().filter_map(|s| {
        let r2 = look(scene, s)?.residual.norm_squared();
        (r2.sqrt() < 3.0 * loss).then_some(r2 * s.sigma_px * s.sigma_px)
    });
    let near: Vec<f64> = near.collect();
    (near.iter().sum::<f64>() / near.len().max(1) as f64).sqrt()
}

/// Builds the reduced system. Unknowns: lens, then six a camera (rotation, translation).
fn reduce(
    scene: &Scene,
    by_point: &[Vec<Sight>],
    prior: &LensPrior,
    loss: f64,
    damping: f64,
) -> Reduced {
    let n = LENS + 6 * scene.poses.len();
    let mut matrix = DMatrix::zeros(n, n);
    let mut right = DVector::zeros(n);
    let mut points = Vec::with_capacity(scene.points.len() - scene.known);
    let c2 = loss * loss;
    for (p, sights) in by_point.iter().enumerate() {
        let (mut v, mut g) = (Matrix3::zeros(), Vector3::zeros());
        let mut coupling: Vec<(usize, SMatrix<f64, 1, 3>)> = Vec::new();
        for sight in sights {
            let Some(d) = look(scene, sight) else {
                continue;
            };
            let weight = 1.0 / (1.0 + d.residual.norm_squared() / c2);
            let first = LENS + 6 * sight.camera;
            let column = |i: usize| if i < LENS { i } else { first + i - LENS };
            for i in 0..LENS + 6 {
                let ji = d.by_unknown.column(i);
                right[column(i)] -= weight * ji.dot(&d.residual);
                for j in 0..=i {
                    let product = weight * ji.dot(&d.by_unknown.column(j));
                    matrix[(column(i), column(j))] += product;
                }
            }
            if p >= scene.known {
                v += d.by_point.transpose() * d.by_point * weight;
                g -= d.by_point.transpose() * d.residual * weight;
                for i in 0..LENS + 6 {
                    let row = d.by_unknown.column(i).transpose() * d.by_point * weight;
                    match coupling.iter_mut().find(|(at, _)| *at == column(i)) {
                        Some((_, sum)) => *sum += row,
                        None => coupling.push((column(i), row)),
                    }
                }
            }
        }
        if p < scene.known {
            continue;
        }
        (0..3).for_each(|i| v[(i, i)] = v[(i, i)] * (1.0 + damping) + 1e-12);
        let inverse = v.try_inverse().unwrap_or_default();
        for (i, wi) in &coupling {
            right[*i] -= (wi * (inverse * g))[0];
            let wv = wi * inverse;
            for (j, wj) in coupling.iter().filter(|(j, _)| j <= i) {
                matrix[(*i, *j)] -= (wv * wj.transpose())[0];
            }
        }
        points.push((inverse, g, coupling));
    }
    let values = lens_values(&scene.lens);
    for i in 0..LENS {
        let weight = 1.0 / (prior.sigma[i] * prior.sigma[i]);
        matrix[(i, i)] += weight;
        right[i] -= weight * (values[i] - prior.mean[i]);
    }
    for i in 0..n {
        matrix[(i, i)] = matrix[(i, i)] * (1.0 + damping) + 1e-12;
        for j in 0..i {
            matrix[(j, i)] = matrix[(i, j)];
        }
    }
    Reduced {
        matrix,
        right,
        points,
    }
}

/// The scene after a step of the reduced unknowns, points by back-substitution.
fn moved(scene: &Scene, system: &Reduced, step: &DVector<f64>) -> Scene {
    let mut moved = scene.clone();
    let mut values = lens_values(&scene.lens);
    (0..LENS).for_each(|i| values[i] += step[i]);
    moved.lens = lens_with(&scene.lens, values);
    for (c, pose) in moved.poses.iter_mut().enumerate() {
        let at = LENS + 6 * c;
        let turn = nalgebra::Rotation3::new(Vector3::new(step[at], step[at + 1], step[at + 2]));
        pose.rotation = turn * pose.rotation;
        pose.rotation.renormalize();
        pose.translation += Vector3::new(step[at + 3], step[at + 4], step[at + 5]);
    }
    for ((inverse, g, coupling), point) in
        system.points.iter().zip(&mut moved.points[scene.known..])
    {
        let mut right = *g;
        coupling
            .iter()
            .for_each(|(i, w)| right -= w.transpose() * step[*i]);
        *point += inverse * right;
    }
    moved
}

/// Standard deviations from the inverse of the undamped reduced system.
fn spread(
    scene: &Scene,
    by_point: &[Vec<Sight>],
    prior: &LensPrior,
    loss: f64,
) -> (Vec<f64>, [f64; LENS]) {
    let system = reduce(scene, by_point, prior, loss, 1e-9);
    let Some(covariance) = system.matrix.cholesky().map(|c| c.inverse()) else {
        return (
            vec![f64::INFINITY; scene.poses.len()],
            [f64::INFINITY; LENS],
        );
    };
    let centre = |(c, pose): (usize, &Pose)| {
        // centre = -Rᵀ t, with R ← exp(ω) R and t ← t + τ: d centre = Rᵀ ([ω]× t - τ).
        let cross = pose.translation.cross_matrix();
        let by_pose = {
            let mut j = SMatrix::<f64, 3, 6>::zeros();
            j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-cross);
            j.fixed_view_mut::<3, 3>(0, 3)
                .copy_from(&-Matrix3::identity());
            pose.rotation.matrix().transpose() * j
        };
        let at = LENS + 6 * c;
        let block = covariance.fixed_view::<6, 6>(at, at).into_owned();
        ((by_pose * block * by_pose.transpose()).trace() / 3.0)
            .max(0.0)
            .sqrt()
    };
    let sigma_mm = scene.poses.iter().enumerate().map(centre).collect();
    let mut lens = [0.0; LENS];
    (0..LENS).for_each(|i| lens[i] = covariance[(i, i)].max(0.0).sqrt());
    (sigma_mm, lens)
}
