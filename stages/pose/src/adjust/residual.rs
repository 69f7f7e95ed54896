//! How far a point is seen from where it projects, and the derivatives of that.

use crate::adjust::lens::LENS;
use nalgebra::{Matrix2, Matrix2x3, Point3, SMatrix, Vector2};
use shape::Camera;

/// Median length of residuals that are normal in two dimensions, in their standard deviations along one: √(2 ln 2) (derived).
pub(crate) const MEDIAN_SIGMAS: f64 = 1.18;

/// Unknowns of a pose: rotation, translation (structural: 3 + 3).
pub(crate) const POSE: usize = 6;
/// Unknowns of a shot: rotation, translation, zoom (structural: 3 + 3 + 1).
pub(crate) const SHOT: usize = POSE + 1;

/// A residual and its derivatives, in standard deviations.
pub(crate) struct Derivatives {
    /// Projection minus observation.
    pub(crate) residual: Vector2<f64>,
    /// By the lens: f, cx, cy, k1, k2.
    pub(crate) by_lens: SMatrix<f64, 2, LENS>,
    /// By the shot: rotation ω with R ← exp(ω) R, translation, zoom.
    pub(crate) by_shot: SMatrix<f64, 2, SHOT>,
    /// By the point. \[1/mm\]
    pub(crate) by_point: Matrix2x3<f64>,
}

/// Residual and derivatives of one observation; the camera's focal length is `zoom` longer than its lens', as a share.
/// `None` for a point behind the camera.
///
/// ```text
/// x = R X + t,  p = (x, y)/z,  r² = p·p,  u = c + (1 + zoom) f (1 + k1 r² + k2 r⁴) p
/// ```
pub(crate) fn derivatives(
    camera: &Camera,
    zoom: f64,
    point: &Point3<f64>,
    at_px: [f64; 2],
    sigma_px: f64,
) -> Option<Derivatives> {
    let (lens, pose) = (&camera.lens, &camera.pose);
    let turned = pose.rotation * point.coords;
    let x = turned + pose.translation;
    if x.z <= 1e-6 {
        return None;
    }
    let p = Vector2::new(x.x, x.y) / x.z;
    let (r2, [k1, k2], f) = (p.norm_squared(), lens.radial, lens.focal[0]);
    let gain = 1.0 + r2 * (k1 + r2 * k2);
    let u = lens.distort(p);
    let by_p = (Matrix2::identity() * gain + p * p.transpose() * (2.0 * (k1 + 2.0 * k2 * r2))) * f;
    let by_x = by_p * Matrix2x3::new(1.0, 0.0, -p.x, 0.0, 1.0, -p.y) / x.z;
    let by_focal = p * gain / sigma_px;
    let mut by_lens = SMatrix::<f64, 2, LENS>::zeros();
    by_lens[(0, 1)] = 1.0;
    by_lens[(1, 2)] = 1.0;
    by_lens.set_column(3, &(p * (f * r2)));
    by_lens.set_column(4, &(p * (f * r2 * r2)));
    by_lens /= sigma_px;
    by_lens.set_column(0, &(by_focal * (1.0 + zoom)));
    let mut by_shot = SMatrix::<f64, 2, SHOT>::zeros();
    by_shot
        .fixed_columns_mut::<3>(0)
        .copy_from(&(by_x * -turned.cross_matrix()));
    by_shot.fixed_columns_mut::<3>(3).copy_from(&by_x);
    by_shot /= sigma_px;
    by_shot.set_column(POSE, &(by_focal * (f / (1.0 + zoom))));
    Some(Derivatives {
        residual: (u.coords - Vector2::from(at_px)) / sigma_px,
        by_lens,
        by_shot,
        by_point: by_x * pose.rotation.matrix() / sigma_px,
    })
}

/// Distance of an observation from where its point projects; none behind the camera. \[px\]
pub(crate) fn off_px(camera: &Camera, at: &Point3<f64>, [x, y]: [f64; 2]) -> Option<f64> {
    let px = camera.project(at)?;
    Some(libm::hypot(px.x - x, px.y - y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::damped::pose_moved;
    use crate::adjust::lens::{lens_values, lens_with};
    use nalgebra::{Rotation3, SVector, Vector3};
    use shape::{Intrinsics, Pose};

    #[test]
    fn the_derivatives_are_those_of_the_residual() {
        let mut lens = Intrinsics::simple(1600, 2400, 3300.0);
        lens.radial = [-0.1, 0.03];
        let rotation = Rotation3::from_euler_angles(1.3, 0.2, -0.4);
        let pose = Pose {
            rotation,
            translation: Vector3::new(30.0, 500.0, 1800.0),
        };
        let point = Point3::new(120.0, -60.0, 400.0);
        // Unknowns scaled so that one step suits all: lens, shot with its zoom, point.
        let scale = [
            1e3, 1e3, 1e3, 1.0, 1.0, 1.0, 1.0, 1.0, 1e3, 1e3, 1e3, 1.0, 1e3, 1e3, 1e3,
        ];
        proof::jacobian(SVector::<f64, 15>::zeros(), 1e-6, |step| {
            let s: Vec<f64> = step.iter().zip(scale).map(|(s, k)| s * k).collect();
            let mut values = lens_values(&lens);
            (0..5).for_each(|i| values[i] += s[i]);
            let zoom = 0.02 + s[11];
            values[0] *= 1.0 + zoom;
            let camera = Camera {
                lens: lens_with(&lens, values),
                pose: pose_moved(&pose, &s[5..]),
            };
            let point = point + Vector3::new(s[12], s[13], s[14]);
            let d = derivatives(&camera, zoom, &point, [700.0, 1300.0], 0.5).unwrap();
            let mut all = SMatrix::<f64, 2, 15>::zeros();
            all.fixed_columns_mut::<5>(0).copy_from(&d.by_lens);
            all.fixed_columns_mut::<7>(5).copy_from(&d.by_shot);
            all.fixed_columns_mut::<3>(12).copy_from(&d.by_point);
            (0..15).for_each(|i| all.column_mut(i).scale_mut(scale[i]));
            (d.residual, all)
        });
    }
}
