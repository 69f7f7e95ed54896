//! How the body moved against the disk between two photos: six numbers a photo.
//!
//! A body that sways moves, nearly as a whole, about its ankles. Each photo's motion is what
//! carries the surface onto that photo: brightness of the photo against the mean of the other photos'
//! wherever the surface carries texture, and the silhouette's contour everywhere.

use crate::evidence::contours::Pull;
use crate::motion::normal_equations::PointShift;
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};
use rayon::prelude::*;
use shape::{Camera, Mesh, Pose};

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

/// Where a photo's motion is pulled: normal equations of six numbers, turn first, then shift.
#[derive(Debug, Clone, Copy)]
pub struct NormalEquations {
    matrix: Matrix6<f64>,
    vector: Vector6<f64>,
}

impl NormalEquations {
    /// No equations.
    pub const NONE: NormalEquations = NormalEquations {
        matrix: Matrix6::from_array_storage(nalgebra::ArrayStorage([[0.0; 6]; 6])),
        vector: Vector6::from_array_storage(nalgebra::ArrayStorage([[0.0; 6]; 1])),
    };

    /// A point that should move by `gap` along `direction`, so stiffly.
    fn add(
        &mut self,
        prior: &MotionPrior,
        x: &Point3<f64>,
        direction: &Vector3<f64>,
        gap: f64,
        stiffness: f64,
    ) {
        let turn = (x - prior.pivot).cross(direction);
        let row = Vector6::new(
            turn.x,
            turn.y,
            turn.z,
            direction.x,
            direction.y,
            direction.z,
        );
        self.matrix += row * row.transpose() * stiffness;
        self.vector += row * (gap * stiffness);
    }

    /// The motion that gives in to the equation, limited by the prior; `now` is the motion so far.
    pub fn solve(&self, prior: &MotionPrior, now: &Vector6<f64>) -> Vector6<f64> {
        let (turn, shift) = (prior.turn.powi(-2), prior.shift_mm.powi(-2));
        let prior = Vector6::new(turn, turn, turn, shift, shift, shift);
        let matrix = self.matrix + Matrix6::from_diagonal(&prior);
        let vector = self.vector - prior.component_mul(now);
        matrix
            .cholesky()
            .map_or_else(Vector6::zeros, |c| c.solve(&vector))
    }
}

/// What brightness gives for each of `pictures` photos' motion, from the equations at each vertex.
pub fn equations_of_brightness(
    pictures: usize,
    shifts: &[Vec<PointShift>],
    prior: &MotionPrior,
) -> Vec<NormalEquations> {
    let chunks: Vec<Vec<NormalEquations>> = shifts
        .par_chunks(512)
        .map(|shifts| {
            let mut equations = vec![NormalEquations::NONE; pictures];
            for t in shifts.iter().flatten() {
                let equation = &mut equations[t.picture as usize];
                equation.add(prior, &t.x, &t.direction, t.gap, t.stiffness);
            }
            equations
        })
        .collect();
    let mut sum = vec![NormalEquations::NONE; pictures];
    for equations in chunks {
        for (s, t) in sum.iter_mut().zip(equations) {
            s.matrix += t.matrix;
            s.vector += t.vector;
        }
    }
    sum
}

/// What the contours give for each photo's motion, added to `equations`.
pub fn add_equations_of_contours(
    equations: &mut [NormalEquations],
    mesh: &Mesh,
    normals: &[Vector3<f64>],
    pulls: &[Pull],
    prior: &MotionPrior,
) {
    let stiffness = prior.contour_weight / (prior.footprint * prior.footprint);
    for p in pulls {
        let n = normals[p.vertex as usize];
        // The whole surface moving by s along the normal changes the gap by slope * s.
        let equation = &mut equations[p.picture as usize];
        equation.add(
            prior,
            &mesh.point(p.vertex),
            &(n * -p.slope),
            p.gap,
            p.weight * stiffness,
        );
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

/// Takes from all motions what is none of the body's: a common turn and shift of all photos in
/// the world, and one in the cameras' own axes. The latter moves the camera against the disk (its
/// approach is a change of scale), and that is the calibration's to find.
pub fn without_gauge(motions: &mut [Vector6<f64>], centres: &[Point3<f64>]) {
    let axes: Vec<_> = centres
        .iter()
        .map(|c| {
            let radial = Vector3::new(c.x, c.y, 0.0)
                .try_normalize(0.0)
                .unwrap_or(Vector3::x());
            Matrix3::from_columns(&[radial, Vector3::z().cross(&radial), Vector3::z()])
        })
        .collect();
    let parts = |m: &Vector6<f64>| -> [Vector3<f64>; 2] {
        [
            m.fixed_rows::<3>(0).into_owned(),
            m.fixed_rows::<3>(3).into_owned(),
        ]
    };
    let count = motions.len().max(1) as f64;
    // The two kinds overlap where cameras are not all around: a few turns solve both.
    for _ in 0..10 {
        let mean = motions.iter().fold(Vector6::zeros(), |s, m| s + m) / count;
        motions.iter_mut().for_each(|m| *m -= mean);
        let mut own = [Vector3::zeros(); 2];
        for (m, a) in motions.iter().zip(&axes) {
            let part = parts(m);
            (0..2).for_each(|k| own[k] += a.transpose() * part[k] / count);
        }
        for (m, a) in motions.iter_mut().zip(&axes) {
            let mut turn = m.fixed_rows_mut::<3>(0);
            turn -= a * own[0];
            let mut shift = m.fixed_rows_mut::<3>(3);
            shift -= a * own[1];
        }
    }
}
