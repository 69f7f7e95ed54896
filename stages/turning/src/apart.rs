//! How far a motion is from the true one, whatever frame and unit each has.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3};
use shape::Pose;

/// Root mean squares over the photos, in the truth's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Apart {
    /// About the body's axis. \[rad\]
    pub(crate) azimuth: f64,
    /// Across the picture. \[mm\]
    pub(crate) sideways: f64,
    /// Along the camera's axis. \[mm\]
    pub(crate) depth: f64,
    /// Length of a millimetre as found.
    pub(crate) scale: f64,
}

/// Lays the found frame on the true one; `None` of fewer than three photos.
pub(crate) fn apart(poses: &[(Pose, Pose)]) -> Option<Apart> {
    if poses.len() < 3 {
        return None;
    }
    // found = true · gᵀ, with g from the true body to the found one.
    let sum: Matrix3<f64> = poses
        .iter()
        .map(|(f, t)| f.rotation.matrix().transpose() * t.rotation.matrix())
        .sum();
    let svd = sum.svd(true, true);
    let g = Rotation3::from_matrix_unchecked(svd.u? * svd.v_t?);
    // F (s g x + c) + f = s (T x + t)  →  F c − s t = −f
    let rows = 3 * poses.len();
    let (mut matrix, mut vector) = (DMatrix::zeros(rows, 4), DVector::zeros(rows));
    for (i, (f, t)) in poses.iter().enumerate() {
        matrix
            .fixed_view_mut::<3, 3>(3 * i, 0)
            .copy_from(f.rotation.matrix());
        matrix
            .fixed_view_mut::<3, 1>(3 * i, 3)
            .copy_from(&-t.translation);
        vector.fixed_rows_mut::<3>(3 * i).copy_from(&-f.translation);
    }
    let normal = matrix.transpose() * &matrix;
    let solved = normal.cholesky()?.solve(&(matrix.transpose() * &vector));
    let scale = solved[3];
    let off = (matrix * &solved - vector) / scale;
    let rms = |all: &dyn Fn(usize) -> f64| {
        let square: f64 = (0..poses.len()).map(|i| all(i) * all(i)).sum();
        (square / poses.len() as f64).sqrt()
    };
    let turned = |i: usize| {
        let (f, t) = &poses[i];
        // Of a small turn the sine is the angle.
        let by = (f.rotation * g).inverse() * t.rotation;
        (by[(1, 0)] - by[(0, 1)]) / 2.0
    };
    Some(Apart {
        azimuth: rms(&turned),
        sideways: rms(&|i| off[3 * i]),
        depth: rms(&|i| off[3 * i + 2]),
        scale,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Motion, Step};
    use nalgebra::Vector3;
    use shape::Intrinsics;

    #[test]
    fn another_frame_and_unit_are_no_error_and_an_azimuth_is() {
        let steps = |wrong: f64| {
            let one = |i: usize| Step {
                azimuth: i as f64 * 0.4 + if i == 3 { wrong } else { 0.0 },
                off: [0.01 * (i % 3) as f64, 0.02 * (i % 4) as f64],
                ..Step::default()
            };
            (0..16).map(one).collect()
        };
        let lens = Intrinsics::simple(300, 400, 500.0);
        let poses = |wrong: f64| {
            let motion = Motion {
                pitch: 0.1,
                steps: steps(wrong),
            };
            motion.cameras(lens).map(|c| c.pose).collect::<Vec<_>>()
        };
        let elsewhere = |p: &Pose| {
            let turn = Rotation3::from_euler_angles(0.0, 0.0, 0.7);
            Pose {
                rotation: p.rotation * turn,
                translation: (p.rotation * Vector3::new(0.1, 0.2, -0.3) + p.translation) * 2600.0,
            }
        };
        let against = |wrong: f64| {
            let both = poses(0.0).into_iter().zip(poses(wrong));
            apart(&both.map(|(t, f)| (elsewhere(&f), t)).collect::<Vec<_>>()).unwrap()
        };
        let right = against(0.0);
        assert!(right.azimuth < 1e-9 && right.depth < 1e-9, "{right:?}");
        proof::near(right.scale, 2600.0, 1e-6);
        proof::near(against(0.08).azimuth, 0.08 / 4.0, 0.002);
    }
}
