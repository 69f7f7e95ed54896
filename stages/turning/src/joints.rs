//! A motion from joints: a body whose joints keep their places in it, turned step by step before a standing camera.

use crate::scene::{Motion, PER_STEP, Step, seen};
use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};
use shape::Found;

/// Where a joint is seen on the plane z = 1, by joint and photo.
pub type Sights = Vec<Vec<Option<Vector2<f64>>>>;

/// How far the body is expected beside its axis: somebody who turns on the spot wanders by some centimetres. One
/// standard deviation, as a share of the distance to the camera (50 mm of 2.5 m). By hand: not on record.
const WANDER_SIGMA: f64 = 0.02;

/// How far the trunk leans, one standard deviation, derived of [`WANDER_SIGMA`]: soles, 0.4 of the distance below the camera, are
/// off by a fifth of it. \[rad\]
const LEAN: f64 = WANDER_SIGMA / 2.0;

/// How far one step of the turn differs from the next, one standard deviation: 17°. By hand: looked at steps of 15 ±
/// 8°. \[rad\]
const UNEVEN_SIGMA: f64 = 0.3;

/// Places of shoulders and hips in [`Found::JOINTS`], structural.
pub(crate) const TRUNK: [usize; 4] = [11, 12, 23, 24];
/// The trunk from hips to shoulders as a share of stature (ANSUR II: acromial less trochanterion height 0.29).
pub(crate) const TRUNK_SHARE: f64 = 0.29;

/// The joints of a body, how surely each is seen, and its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Articulated {
    /// Where each joint is in the body. \[distance to the axis\]
    pub places: Vec<Vector3<f64>>,
    /// Standard deviation of each one's sights, on the plane z = 1.
    pub sigmas: Vec<f64>,
    /// How the body moved.
    pub motion: Motion,
}

/// Normal equations over steps, pitch and joints, in this order.
pub struct Equations {
    /// AᵀA.
    pub matrix: DMatrix<f64>,
    /// -Aᵀr.
    pub vector: DVector<f64>,
}

impl Equations {
    /// None yet, over so many unknowns.
    pub fn none(unknowns: usize) -> Equations {
        Equations {
            matrix: DMatrix::zeros(unknowns, unknowns),
            vector: DVector::zeros(unknowns),
        }
    }

    /// A residual with its slopes by unknown, so strongly.
    pub fn add(&mut self, slopes: &[(usize, f64)], residual: f64, weight: f64) {
        for (i, a) in slopes {
            self.vector[*i] -= weight * a * residual;
            for (j, b) in slopes {
                self.matrix[(*i, *j)] += weight * a * b;
            }
        }
    }

    /// The step that these equations ask for, damped.
    pub fn solved(mut self, damping: f64) -> Option<DVector<f64>> {
        for i in 0..self.vector.len() {
            let stiff = self.matrix[(i, i)];
            self.matrix[(i, i)] += damping * stiff + 1e-12;
        }
        self.matrix.cholesky().map(|c| c.solve(&self.vector))
    }
}

impl Articulated {
    /// Joints placed by sights, for a motion that is known roughly.
    pub fn placed(sights: &Sights, motion: Motion) -> Articulated {
        let place = |of: &Vec<Option<Vector2<f64>>>| {
            let (mut matrix, mut vector) = (Matrix3::zeros(), Vector3::zeros());
            for (step, sight) in motion.steps.iter().zip(of) {
                let Some(sight) = sight else { continue };
                let turn = crate::scene::looking(motion.pitch);
                let pose = step.pose();
                let at = turn * pose.translation;
                let by = turn * pose.rotation.matrix();
                for k in 0..2 {
                    // x − u z = 0 in the camera's frame.
                    let row = (by.row(k) - by.row(2) * sight[k]).transpose();
                    let off = at[k] - sight[k] * at.z;
                    matrix += row * row.transpose();
                    vector -= row * off;
                }
            }
            matrix += Matrix3::identity() * 1e-6;
            matrix
                .cholesky()
                .map_or(Vector3::zeros(), |c| c.solve(&vector))
        };
        let mut all = Articulated {
            places: sights.iter().map(place).collect(),
            sigmas: vec![1.0; sights.len()],
            motion,
        };
        all.weighed(sights);
        all
    }

    /// How many unknowns there are.
    pub fn unknowns(&self) -> usize {
        PER_STEP * self.motion.steps.len() + 1 + 3 * self.places.len()
    }

    /// How far a joint is from where it was seen, on the plane z = 1.
    fn miss(&self, joint: usize, step: &Step, sight: &Vector2<f64>) -> Option<Vector2<f64>> {
        let x = step.to_fixed(&self.places[joint]);
        Some(seen(self.motion.pitch, &x)?.0 - sight)
    }

    /// Estimates how surely each joint is seen, from how it is.
    pub fn weighed(&mut self, sights: &Sights) {
        let spread = |(j, of): (usize, &Vec<Option<Vector2<f64>>>)| {
            let misses = self.motion.steps.iter().zip(of);
            let misses = misses.filter_map(|(step, s)| self.miss(j, step, s.as_ref()?));
            let mut all: Vec<f64> = misses.flat_map(|m| [m.x.abs(), m.y.abs()]).collect();
            (!all.is_empty()).then(|| 1.4826 * median(&mut all))
        };
        let spreads: Vec<Option<f64>> = sights.iter().enumerate().map(spread).collect();
        // None is surer than a third of the middle one: a joint that few photos hold fits by itself.
        let mut known: Vec<f64> = spreads.iter().flatten().copied().collect();
        let least = (median(&mut known) / 3.0).max(1e-5);
        let sigma = |spread: Option<f64>| spread.map_or(1.0, |s| s.max(least));
        self.sigmas = spreads.into_iter().map(sigma).collect();
    }

    /// What the joints ask of all unknowns.
    pub fn equations(&self, sights: &Sights, to: &mut Equations) {
        let photos = self.motion.steps.len();
        for (j, of) in sights.iter().enumerate() {
            let first = PER_STEP * photos + 1 + 3 * j;
            for (i, (step, sight)) in self.motion.steps.iter().zip(of).enumerate() {
                let Some(sight) = sight else { continue };
                let x = step.to_fixed(&self.places[j]);
                let Some((at, by_point, by_pitch)) = seen(self.motion.pitch, &x) else {
                    continue;
                };
                let miss = at - sight;
                let share = miss.norm_squared() / (CAUCHY * self.sigmas[j]).powi(2);
                let weight = 1.0 / (self.sigmas[j].powi(2) * (1.0 + share));
                let by_step = step.slopes(&self.places[j]).map(|s| by_point * s);
                let turned = by_point * step.pose().rotation.matrix();
                for k in 0..2 {
                    let step = by_step.iter().enumerate();
                    let step = step.map(|(n, by)| (PER_STEP * i + n, by[k]));
                    let place = (0..3).map(|e| (first + e, turned[(k, e)]));
                    let slopes: Vec<(usize, f64)> = step
                        .chain([(PER_STEP * photos, by_pitch[k])])
                        .chain(place)
                        .collect();
                    to.add(&slopes, miss[k], weight);
                }
            }
        }
        for (i, three) in self.motion.steps.windows(3).enumerate() {
            let [a, b, c] = [three[0], three[1], three[2]].map(|s| s.azimuth);
            let at = |k: usize| PER_STEP * (i + k);
            let slopes = [(at(0), 1.0), (at(1), -2.0), (at(2), 1.0)];
            to.add(&slopes, a - 2.0 * b + c, UNEVEN_SIGMA.powi(-2));
        }
        for (i, step) in self.motion.steps.iter().enumerate() {
            for k in 0..2 {
                to.add(
                    &[(PER_STEP * i + 1 + k, 1.0)],
                    step.off[k],
                    WANDER_SIGMA.powi(-2),
                );
                to.add(&[(PER_STEP * i + 3 + k, 1.0)], step.lean[k], LEAN.powi(-2));
            }
        }
    }

    /// Goes a step.
    pub fn stepped(&mut self, by: &DVector<f64>) {
        let photos = self.motion.steps.len();
        for (i, step) in self.motion.steps.iter_mut().enumerate() {
            step.stepped(&by.as_slice()[PER_STEP * i..]);
        }
        self.motion.pitch += by[PER_STEP * photos];
        for (j, place) in self.places.iter_mut().enumerate() {
            for k in 0..3 {
                place[k] += by[PER_STEP * photos + 1 + 3 * j + k];
            }
        }
    }

    /// Improves all until it settles.
    pub fn settled(mut self, sights: &Sights) -> Articulated {
        for _ in 0..ROUNDS {
            let mut equations = Equations::none(self.unknowns());
            self.equations(sights, &mut equations);
            let Some(by) = equations.solved(1e-4) else {
                break;
            };
            self.stepped(&by);
            self.weighed(sights);
            if by.amax() < 1e-7 {
                break;
            }
        }
        self
    }
}

/// Left for right, on a photo where the network took one for the other.
pub fn swap(sights: &mut Sights, photo: usize) {
    for (left, name) in Found::JOINTS.iter().enumerate() {
        let other = name.replace("left", "right");
        let other = Found::JOINTS.iter().position(|name| *name == other);
        if let Some(other) = other.filter(|other| *other != left) {
            let seen = sights[left][photo];
            sights[left][photo] = sights[other][photo];
            sights[other][photo] = seen;
        }
    }
}

/// Cauchy's constant, for 95 % efficiency on normal errors (Holland and Welsch 1977).
const CAUCHY: f64 = 2.385;
/// Rounds in which joints settle (structural: a search's end).
const ROUNDS: usize = 60;

/// The number in the middle; 0 of none.
pub fn median(all: &mut [f64]) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
#[path = "joints_tests.rs"]
mod tests;
