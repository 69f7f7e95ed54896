//! The pose of a camera that sees a known plane (Zhang 2000, §3.1): homography, then decomposition.

use nalgebra::{DMatrix, Matrix3, Rotation3, Vector2, Vector3};
use shape::{Intrinsics, Pose};

/// The homography from a plane to a picture by the direct linear transformation: at least four places on
/// the plane and in the picture, the latter of the order of 1.
pub(crate) fn homography(pairs: &[([f64; 2], [f64; 2])]) -> Option<Matrix3<f64>> {
    if pairs.len() < 4 {
        return None;
    }
    let spread = pairs
        .iter()
        .map(|(p, _)| libm::hypot(p[0], p[1]))
        .fold(1e-9, f64::max);
    let mut a = DMatrix::zeros((2 * pairs.len()).max(9), 9);
    for (i, (plane, seen)) in pairs.iter().enumerate() {
        let p = Vector2::from(*seen);
        let x = [plane[0] / spread, plane[1] / spread, 1.0];
        for k in 0..3 {
            a[(2 * i, k)] = x[k];
            a[(2 * i, 6 + k)] = -p.x * x[k];
            a[(2 * i + 1, 3 + k)] = x[k];
            a[(2 * i + 1, 6 + k)] = -p.y * x[k];
        }
    }
    let svd = a.svd(false, true);
    let v_t = svd.v_t?;
    let least = svd.singular_values.imin();
    let h = Matrix3::from_row_slice(v_t.row(least).transpose().as_slice());
    let unscale = Matrix3::from_diagonal(&Vector3::new(1.0 / spread, 1.0 / spread, 1.0));
    Some(h * unscale)
}

/// camera_from_world from at least four points of the plane z = 0 \[mm\] and their pixels.
pub fn planar_pose(lens: &Intrinsics, pairs: &[([f64; 2], [f64; 2])]) -> Option<Pose> {
    let seen = |px: &[f64; 2]| {
        let p = lens.undistort((*px).into());
        [p.x, p.y]
    };
    let rays: Vec<_> = pairs.iter().map(|(plane, px)| (*plane, seen(px))).collect();
    let mut h = homography(&rays)?;
    // The plane is before the camera.
    let centre = pairs
        .iter()
        .map(|(p, _)| Vector2::from(*p))
        .sum::<Vector2<f64>>()
        / pairs.len() as f64;
    if (h * Vector3::new(centre.x, centre.y, 1.0)).z < 0.0 {
        h = -h;
    }
    let (h1, h2, h3): (Vector3<f64>, Vector3<f64>, Vector3<f64>) =
        (h.column(0).into(), h.column(1).into(), h.column(2).into());
    let scale = 2.0 / (h1.norm() + h2.norm());
    if !scale.is_finite() {
        return None;
    }
    let rough = Matrix3::from_columns(&[h1 * scale, h2 * scale, (h1 * scale).cross(&(h2 * scale))]);
    let svd = rough.svd(true, true);
    let rotation = svd.u? * svd.v_t?;
    if rotation.determinant() < 0.0 {
        return None;
    }
    Some(Pose {
        rotation: Rotation3::from_matrix_unchecked(rotation),
        translation: h3 * scale,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use shape::Camera;

    #[test]
    fn a_known_camera_is_found_from_a_plane() {
        let lens = Intrinsics::simple(1600, 2400, 3300.0);
        let rotation = Rotation3::from_euler_angles(1.9, 0.1, 0.4);
        let pose = Pose {
            rotation,
            translation: Vector3::new(20.0, 300.0, 1700.0),
        };
        let camera = Camera { lens, pose };
        let place = |i: usize| {
            [
                f64::from(i as u32 % 4) * 60.0 - 90.0,
                f64::from(i as u32 / 4) * 70.0 - 100.0,
            ]
        };
        let pair = |p: [f64; 2]| {
            let px = camera.project(&Point3::new(p[0], p[1], 0.0)).unwrap();
            (p, [px.x, px.y])
        };
        let pairs: Vec<_> = (0..16).map(|i| pair(place(i))).collect();
        let found = planar_pose(&lens, &pairs).unwrap();
        assert!((found.translation - pose.translation).norm() < 1e-6);
        assert!((found.rotation.matrix() - pose.rotation.matrix()).amax() < 1e-9);
    }
}
