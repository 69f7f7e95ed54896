//! The normal equations of an adjustment with its points eliminated (the Schur complement; Triggs
//! et al. 1999, §6.1).

use crate::adjust::lens::LENS;
use crate::adjust::residual::Derivatives;
use crate::adjust::scene::{PointObservation, Scene, look};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, SMatrix, Vector3};

type LensBlock = SMatrix<f64, LENS, 3>;
type CameraBlock = SMatrix<f64, 6, 3>;

/// A point that was eliminated: what its own step follows from.
struct Eliminated {
    inverse: Matrix3<f64>,
    right: Vector3<f64>,
    lens: LensBlock,
    cameras: Vec<(usize, CameraBlock)>,
}

/// The reduced system. Unknowns: the lens, then six a camera (rotation, translation), then what is
/// open of tags on a rim.
pub(crate) struct Reduced {
    /// Symmetric, both halves filled.
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) right: DVector<f64>,
    points: Vec<Eliminated>,
}

/// Builds the reduced system from the observations of each point; `loss` is Cauchy's c, `damping`
/// that of the points' own blocks.
pub(crate) fn reduce(
    scene: &Scene,
    by_point: &[Vec<PointObservation>],
    loss: f64,
    damping: f64,
) -> Reduced {
    let poses = LENS + 6 * scene.poses.len();
    let n = poses + scene.rim.as_ref().map_or(0, |rim| rim.unknowns());
    let mut system = Reduced {
        matrix: DMatrix::zeros(n, n),
        right: DVector::zeros(n),
        points: Vec::with_capacity(scene.points.len() - scene.known),
    };
    let c2 = loss * loss;
    for (p, observations) in by_point.iter().enumerate() {
        let (mut v, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let mut lens = LensBlock::zeros();
        let mut cameras = Vec::with_capacity(observations.len());
        let open = scene.rim.as_ref().and_then(|rim| {
            let corner = p.checked_sub(rim.first).filter(|_| p < scene.known)?;
            Some(rim.by_open(corner))
        });
        for observation in observations {
            let Some(d) = look(scene, observation) else {
                continue;
            };
            let weight = 1.0 / (1.0 + d.residual.norm_squared() / c2);
            let by_lens = d.by_unknown.fixed_columns::<LENS>(0);
            let by_pose = d.by_unknown.fixed_columns::<6>(LENS);
            let at = LENS + 6 * observation.camera;
            let add = |m: &mut DMatrix<f64>, row: usize, block: SMatrix<f64, 6, LENS>| {
                let mut view = m.fixed_view_mut::<6, LENS>(row, 0);
                view += block;
            };
            let mut top = system.matrix.fixed_view_mut::<LENS, LENS>(0, 0);
            top += by_lens.transpose() * by_lens * weight;
            let mut own = system.matrix.fixed_view_mut::<6, 6>(at, at);
            own += by_pose.transpose() * by_pose * weight;
            add(
                &mut system.matrix,
                at,
                by_pose.transpose() * by_lens * weight,
            );
            let mut r = system.right.fixed_rows_mut::<LENS>(0);
            r -= by_lens.transpose() * d.residual * weight;
            let mut r = system.right.fixed_rows_mut::<6>(at);
            r -= by_pose.transpose() * d.residual * weight;
            if let Some((which, by_open)) = &open {
                add_open(&mut system, poses, at, which, &d, by_open, weight);
            }
            if p >= scene.known {
                v += d.by_point.transpose() * d.by_point * weight;
                right -= d.by_point.transpose() * d.residual * weight;
                lens += by_lens.transpose() * d.by_point * weight;
                cameras.push((
                    observation.camera,
                    by_pose.transpose() * d.by_point * weight,
                ));
            }
        }
        if p >= scene.known {
            (0..3).for_each(|i| v[(i, i)] = v[(i, i)] * (1.0 + damping) + 1e-15);
            let point = Eliminated {
                inverse: v.try_inverse().unwrap_or_default(),
                right,
                lens,
                cameras,
            };
            point.eliminate(&mut system.matrix, &mut system.right);
            system.points.push(point);
        }
    }
    for i in 0..n {
        for j in 0..i {
            system.matrix[(j, i)] = system.matrix[(i, j)];
        }
    }
    system
}

/// Adds what an observation tells of a rim's open numbers, in the lower half.
fn add_open(
    system: &mut Reduced,
    from: usize,
    camera: usize,
    which: &[usize],
    d: &Derivatives,
    by_open: &Matrix3xX<f64>,
    weight: f64,
) {
    let by = d.by_point * by_open * weight;
    for (a, row) in which.iter().enumerate() {
        let (row, by) = (from + row, by.column(a));
        system.right[row] -= by.dot(&d.residual);
        for (i, column) in (0..LENS).chain(camera..camera + 6).enumerate() {
            system.matrix[(row, column)] += by.dot(&d.by_unknown.column(i));
        }
        for (b, column) in which.iter().enumerate().filter(|(_, c)| from + **c <= row) {
            let other = d.by_point * by_open.column(b);
            system.matrix[(row, from + column)] += by.dot(&other);
        }
    }
}

impl Eliminated {
    /// Subtracts W V⁻¹ Wᵀ and W V⁻¹ g, in the lower half.
    fn eliminate(&self, matrix: &mut DMatrix<f64>, right: &mut DVector<f64>) {
        let solved = self.inverse * self.right;
        let lens = self.lens * self.inverse;
        let mut top = matrix.fixed_view_mut::<LENS, LENS>(0, 0);
        top -= lens * self.lens.transpose();
        let mut r = right.fixed_rows_mut::<LENS>(0);
        r -= self.lens * solved;
        for (a, wa) in &self.cameras {
            let at = LENS + 6 * a;
            let wv = wa * self.inverse;
            let mut side = matrix.fixed_view_mut::<6, LENS>(at, 0);
            side -= wv * self.lens.transpose();
            let mut r = right.fixed_rows_mut::<6>(at);
            r -= wa * solved;
            for (b, wb) in self.cameras.iter().filter(|(b, _)| b <= a) {
                let mut block = matrix.fixed_view_mut::<6, 6>(at, LENS + 6 * b);
                block -= wv * wb.transpose();
            }
        }
    }
}

impl Reduced {
    /// The step of each free point that follows from a step of the reduced unknowns.
    pub(crate) fn point_steps(&self, step: &DVector<f64>) -> Vec<Vector3<f64>> {
        let one = |point: &Eliminated| {
            let mut right = point.right - point.lens.transpose() * step.fixed_rows::<LENS>(0);
            for (camera, w) in &point.cameras {
                right -= w.transpose() * step.fixed_rows::<6>(LENS + 6 * camera);
            }
            point.inverse * right
        };
        self.points.iter().map(one).collect()
    }
}
