//! How the body moved against the disk between two photos: six numbers a photo.
//!
//! A body that sways moves, nearly as a whole, about its ankles. Each photo's motion is what
//! carries the surface onto that photo: brightness of the photo against the mean of the other photos'
//! wherever the surface carries texture, and the silhouette's contour everywhere.

use crate::evidence::contours::Pull;
use crate::motion::gauge::Gauge;
use crate::motion::normal_equations::{PointShift, VertexShifts};
use nalgebra::{DMatrix, DVector, Point3, Rotation3, Vector3, Vector6};
use rayon::prelude::*;
use shape::{Camera, Mesh, Pose};

/// Parts in which equations are summed. (structural)
const CHUNKS: usize = 16;

/// How strictly motions are limited.
#[derive(Debug, Clone, Copy)]
pub struct MotionPrior {
    /// Standard deviation of the shift expected beforehand. \[mm\]
    pub shift_mm: f64,
    /// Standard deviation of the turn expected beforehand. \[rad\]
    pub turn: f64,
    /// What the body turns about. \[mm\]
    pub pivot: Point3<f64>,
    /// How many points of a contour weigh as much as one that is known to a pixel.
    pub contour_weight: f64,
    /// What a pixel covers on the surface. \[mm\]
    pub footprint: f64,
}

/// Where the motions of all photos are pulled, together: normal equations of six numbers a photo, turn first, then shift.
///
/// Each photo is compared with the mean of the rest, which move as well: where photo `i` should move by `gap` along
/// `row`, it is `stiffness · row · (m_i − Σ_j share_j m_j) = stiffness · gap` to first order. Moved one by one, each
/// to where the rest were, photos close in on a common place slowly; solved together, at once (Newton).
#[derive(Debug, Clone)]
pub struct NormalEquations {
    matrix: DMatrix<f64>,
    vector: DVector<f64>,
}

impl NormalEquations {
    /// No equations for so many photos.
    pub fn none(photos: usize) -> Self {
        NormalEquations {
            matrix: DMatrix::zeros(6 * photos, 6 * photos),
            vector: DVector::zeros(6 * photos),
        }
    }

    /// A point that photo `i` should move by `gap` along `direction`, so stiffly, against the rest by their weights.
    fn add(&mut self, prior: &MotionPrior, point: &PointShift, against: &[(u16, f64)]) {
        let (direction, i) = (&point.direction, point.picture);
        let turn = (point.x - prior.pivot).cross(direction);
        let row = Vector6::new(
            turn.x,
            turn.y,
            turn.z,
            direction.x,
            direction.y,
            direction.z,
        );
        let square = row * row.transpose() * point.stiffness;
        let mut block = |j: u16, share: f64| {
            let mut block = self
                .matrix
                .fixed_view_mut::<6, 6>(6 * i as usize, 6 * j as usize);
            block += square * share;
        };
        block(i, 1.0);
        let rest = || against.iter().filter(|(j, _)| *j != i);
        let weight: f64 = rest().map(|(_, w)| w).sum();
        rest().for_each(|(j, w)| block(*j, -w / weight));
        let mut vector = self.vector.fixed_rows_mut::<6>(6 * i as usize);
        vector += row * (point.gap * point.stiffness);
    }

    /// By how much motions change to give in to the equations, limited by the prior; `now` are the motions so far.
    pub fn solve(
        mut self,
        prior: &MotionPrior,
        gauge: &Gauge,
        now: &[Vector6<f64>],
    ) -> Vec<Vector6<f64>> {
        if now.is_empty() {
            return vec![];
        }
        let (turn, shift) = (prior.turn.powi(-2), prior.shift_mm.powi(-2));
        for (k, now) in now.iter().flatten().enumerate() {
            let prior = if k % 6 < 3 { turn } else { shift };
            self.matrix[(k, k)] += prior;
            self.vector[k] -= prior * now;
        }
        // Lagrange: no step along what is none of the body's.
        let (n, k) = gauge.columns().shape();
        let mut matrix = self.matrix.resize(n + k, n + k, 0.0);
        matrix.view_mut((0, n), (n, k)).copy_from(gauge.columns());
        matrix
            .view_mut((n, 0), (k, n))
            .copy_from(&gauge.columns().transpose());
        let steps = matrix
            .lu()
            .solve(&self.vector.resize_vertically(n + k, 0.0));
        let step = |i| {
            steps
                .as_ref()
                .map_or_else(Vector6::zeros, |s| s.fixed_rows::<6>(6 * i).into())
        };
        (0..now.len()).map(step).collect()
    }
}

/// What brightness gives for the motions of `pictures` photos, from the equations at each vertex.
pub fn equations_of_brightness(
    pictures: usize,
    vertices: &[VertexShifts],
    prior: &MotionPrior,
) -> NormalEquations {
    // So many sums are in memory at once, whatever threads there are: each is a matrix of all photos.
    let chunk = vertices.len().div_ceil(CHUNKS).max(1);
    let chunks: Vec<NormalEquations> = vertices
        .par_chunks(chunk)
        .map(|vertices| {
            let mut equations = NormalEquations::none(pictures);
            for v in vertices {
                v.shifts
                    .iter()
                    .for_each(|s| equations.add(prior, s, &v.seen));
            }
            equations
        })
        .collect();
    let mut sum = NormalEquations::none(pictures);
    for equations in chunks {
        sum.matrix += equations.matrix;
        sum.vector += equations.vector;
    }
    sum
}

/// What the contours give for each photo's motion, added to `equations`.
pub fn add_equations_of_contours(
    equations: &mut NormalEquations,
    mesh: &Mesh,
    normals: &[Vector3<f64>],
    pulls: &[Pull],
    prior: &MotionPrior,
) {
    let stiffness = prior.contour_weight / (prior.footprint * prior.footprint);
    for p in pulls {
        // The whole surface moving by s along the normal changes the gap by slope * s.
        let point = PointShift {
            picture: p.picture,
            x: mesh.point(p.vertex),
            direction: normals[p.vertex as usize] * -p.slope,
            gap: p.gap,
            stiffness: p.weight * stiffness,
        };
        equations.add(prior, &point, &[]);
    }
}

/// A motion as a map of points: turned about the pivot, then shifted.
pub fn moved(camera: &Camera, motion: &Vector6<f64>, pivot: &Point3<f64>) -> Camera {
    let turn = Rotation3::new(motion.fixed_rows::<3>(0).into_owned());
    let shift = motion.fixed_rows::<3>(3).into_owned();
    // x_camera = R (turn (x − pivot) + pivot + shift) + t
    let rotation = camera.pose.rotation * turn;
    let carried = pivot.coords - turn * pivot.coords + shift;
    let translation = camera.pose.rotation * carried + camera.pose.translation;
    Camera {
        lens: camera.lens,
        pose: Pose {
            rotation,
            translation,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::gauge::ring;

    const PRIOR: MotionPrior = MotionPrior {
        shift_mm: 1e6,
        turn: 1e6,
        pivot: Point3::new(0.0, 0.0, 0.0),
        contour_weight: 0.05,
        footprint: 1.0,
    };

    /// Numbers in -1..=1 that seem to be without order.
    fn number(k: usize) -> f64 {
        libm::sin(k as f64 * 12.9898 + 1.0)
    }

    #[test]
    fn photos_compared_with_each_other_rest_after_one_step() {
        let centres = ring(12);
        let gauge = Gauge::new(&centres);
        let mut all = DVector::from_fn(72, |k, _| number(k) * if k % 6 < 3 { 0.003 } else { 4.0 });
        all -= gauge.columns() * (gauge.columns().transpose() * &all);
        let moved: Vec<Vector6<f64>> = (0..12)
            .map(|i| all.fixed_rows::<6>(6 * i).into_owned())
            .collect();
        let vertices: Vec<VertexShifts> =
            (0..400).map(|v| seen_vertex(v, &centres, &moved)).collect();
        let equations = equations_of_brightness(12, &vertices, &PRIOR);
        let found = equations.solve(&PRIOR, &gauge, &[Vector6::zeros(); 12]);
        for (found, moved) in found.iter().zip(&moved) {
            assert!((found - moved).norm() < 1e-6, "{found} {moved}");
        }
    }

    #[test]
    fn without_photos_nothing_moves() {
        let equations = equations_of_brightness(0, &[], &PRIOR);
        assert!(equations.solve(&PRIOR, &Gauge::new(&[]), &[]).is_empty());
    }

    /// A point of a cylinder that photos on its side of the ring see, where motions carried it.
    fn seen_vertex(v: usize, centres: &[Point3<f64>], moved: &[Vector6<f64>]) -> VertexShifts {
        let (sin, cos) = libm::sincos(v as f64);
        let x = Point3::new(150.0 * cos, 150.0 * sin, 900.0 + 800.0 * number(v));
        let facing = |c: &Point3<f64>| (c.x * cos + c.y * sin) / 3000.0;
        let seen: Vec<(u16, f64)> = (0..centres.len())
            .filter(|i| facing(&centres[*i]) > 0.3)
            .map(|i| (i as u16, facing(&centres[i])))
            .collect();
        let shift = |i: u16| {
            let (turn, shift) = (
                moved[i as usize].fixed_rows::<3>(0),
                moved[i as usize].fixed_rows::<3>(3),
            );
            turn.cross(&x.coords) + shift
        };
        let mut shifts = vec![];
        for (i, _) in &seen {
            let beside = || seen.iter().filter(|(j, _)| j != i);
            let weight: f64 = beside().map(|(_, w)| w).sum();
            let rest = beside().fold(Vector3::zeros(), |s, (j, w)| s + shift(*j) * (w / weight));
            let side = Vector3::z().cross(&(centres[*i as usize] - x)).normalize();
            for direction in [side, Vector3::z()] {
                let gap = direction.dot(&(shift(*i) - rest));
                shifts.push(PointShift {
                    picture: *i,
                    x,
                    direction,
                    gap,
                    stiffness: 1.0 + number(v).abs(),
                });
            }
        }
        VertexShifts { shifts, seen }
    }
}
