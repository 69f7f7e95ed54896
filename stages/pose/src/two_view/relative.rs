//! A camera's pose relative to another one, from what both see.

use crate::two_view::epipolar::motion_through;
use crate::two_view::five_point::Both;
use nalgebra::{Matrix3, Rotation3, Vector3};
use shape::triangulate;
use shape::{Camera, Intrinsics, Pose};

/// A camera whose frame is the world's.
pub(crate) fn at_origin() -> Pose {
    Pose {
        rotation: Rotation3::identity(),
        translation: Vector3::zeros(),
    }
}

/// The pose of the second camera while the first is at the origin, a unit away: the essential
/// matrix, and of its four poses the one before which most points are (Hartley and Zisserman 2004,
/// §9.6).
pub(crate) fn two_views(lens: &Intrinsics, both: &[Both]) -> Option<Pose> {
    let f = motion_through(lens, both, 2.0, 2000, 1)?;
    let k = lens.matrix();
    let svd = (k.transpose() * f * k).svd(true, true);
    let (mut u, mut vt) = (svd.u?, svd.v_t?);
    if u.determinant() < 0.0 {
        u = -u;
    }
    if vt.determinant() < 0.0 {
        vt = -vt;
    }
    let w = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let mut best: Option<(usize, Pose)> = None;
    for rotation in [u * w * vt, u * w.transpose() * vt] {
        for sign in [1.0, -1.0] {
            let pose = Pose {
                rotation: Rotation3::from_matrix_unchecked(rotation),
                translation: u.column(2) * sign * 1000.0,
            };
            let cameras = [at_origin(), pose].map(|pose| Camera { lens: *lens, pose });
            let fits = |b: &&Both| {
                let found = triangulate(&cameras, &[(0, b[0]), (1, b[1])]);
                found.is_some_and(|(_, rms)| rms < 4.0)
            };
            let count = both.iter().filter(fits).count();
            if best.as_ref().is_none_or(|(most, _)| count > *most) {
                best = Some((count, pose));
            }
        }
    }
    best.map(|(_, pose)| pose)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn two_photos_tell_where_the_second_was_taken_from() {
        let lens = Intrinsics::simple(640, 480, 1500.0);
        let turn = Rotation3::from_euler_angles(0.0, 0.4, 0.0);
        let first = Vector3::new(0.0, 0.0, 900.0);
        let second = Pose {
            rotation: turn,
            translation: first - turn * first,
        };
        let eyes = [at_origin(), second].map(|pose| Camera { lens, pose });
        let mut dice = proof::Dice(8);
        let both: Vec<Both> = (0..80)
            .map(|_| {
                let mut x = || dice.within(-90.0, 90.0);
                let point = Point3::from(Vector3::new(x(), x(), x()) + first);
                [0, 1].map(|i| eyes[i].project(&point).unwrap().into())
            })
            .collect();
        let found = two_views(&lens, &both).unwrap();
        let (turned, aside) = (
            (found.rotation.matrix() - turn.matrix()).norm(),
            found.translation.angle(&second.translation),
        );
        assert!(turned < 1e-3 && aside < 1e-3, "{turned} {aside}");
    }
}
