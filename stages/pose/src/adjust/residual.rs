//! How far a point is seen from where it projects, and the derivatives of that.

use crate::adjust::lens::LENS;
use nalgebra::{Matrix2, Matrix2x3, Point3, SMatrix, Vector2};
use shape::Camera;

/// Median length of residuals that are normal in two dimensions, in their standard deviations along one: √(2 ln 2) (derived).
pub(crate) const MEDIAN_SIGMAS: f64 = 1.18;

/// A residual and its derivatives, in standard deviations.
pub struct Derivatives {
    /// Projection minus observation.
    pub residual: Vector2<f64>,
    /// By the lens (f, cx, cy, k1, k2), then by the camera: rotation ω with R ← exp(ω) R, translation.
    pub by_unknown: SMatrix<f64, 2, { LENS + 6 }>,
    /// By the point. \[1/mm\]
    pub by_point: Matrix2x3<f64>,
}

/// Residual and derivatives of one observation. `None` for a point behind the camera.
///
/// ```text
/// x = R X + t,  p = (x, y)/z,  r² = p·p,  u = c + f (1 + k1 r² + k2 r⁴) p
/// ```
pub fn derivatives(
    camera: &Camera,
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
    let mut by_unknown = SMatrix::<f64, 2, { LENS + 6 }>::zeros();
    by_unknown.set_column(0, &(p * gain));
    by_unknown[(0, 1)] = 1.0;
    by_unknown[(1, 2)] = 1.0;
    by_unknown.set_column(3, &(p * (f * r2)));
    by_unknown.set_column(4, &(p * (f * r2 * r2)));
    by_unknown
        .fixed_view_mut::<2, 3>(0, 5)
        .copy_from(&(by_x * -turned.cross_matrix()));
    by_unknown.fixed_view_mut::<2, 3>(0, 8).copy_from(&by_x);
    Some(Derivatives {
        residual: (u.coords - Vector2::from(at_px)) / sigma_px,
        by_unknown: by_unknown / sigma_px,
        by_point: by_x * pose.rotation.matrix() / sigma_px,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
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
        // Unknowns scaled so that one step suits all.
        let scale = [
            1e3, 1e3, 1e3, 1.0, 1.0, 1.0, 1.0, 1.0, 1e3, 1e3, 1e3, 1e3, 1e3, 1e3,
        ];
        proof::jacobian(SVector::<f64, 14>::zeros(), 1e-6, |step| {
            let s: Vec<f64> = step.iter().zip(scale).map(|(s, k)| s * k).collect();
            let mut values = lens_values(&lens);
            (0..5).for_each(|i| values[i] += s[i]);
            let turn = Rotation3::new(Vector3::new(s[5], s[6], s[7]));
            let shift = Vector3::new(s[8], s[9], s[10]);
            let pose = Pose {
                rotation: turn * pose.rotation,
                translation: pose.translation + shift,
            };
            let point = point + Vector3::new(s[11], s[12], s[13]);
            let camera = Camera {
                lens: lens_with(&lens, values),
                pose,
            };
            let d = derivatives(&camera, &point, [700.0, 1300.0], 0.5).unwrap();
            let mut all = SMatrix::<f64, 2, 14>::zeros();
            all.fixed_view_mut::<2, 11>(0, 0).copy_from(&d.by_unknown);
            all.fixed_view_mut::<2, 3>(0, 11).copy_from(&d.by_point);
            (0..14).for_each(|i| all.column_mut(i).scale_mut(scale[i]));
            (d.residual, all)
        });
    }
}
