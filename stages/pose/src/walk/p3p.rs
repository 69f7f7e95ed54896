//! A camera against three known points (Grunert 1841; the quartic as Haralick, Lee, Ottenberg and
//! Nölle 1994 give it).

use crate::two_view::five_point::roots;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::Pose;

/// The poses, at most four, from which three points are seen along three rays of unit length.
pub(crate) fn three_points(points: &[Point3<f64>; 3], rays: &[Vector3<f64>; 3]) -> Vec<Pose> {
    let side = |i: usize, j: usize| (points[i] - points[j]).norm_squared();
    let (a2, b2, c2) = (side(1, 2), side(0, 2), side(0, 1));
    let cos = |i: usize, j: usize| rays[i].dot(&rays[j]);
    let (alpha, beta, gamma) = (cos(1, 2), cos(0, 2), cos(0, 1));
    if [a2, b2, c2].iter().any(|d| *d < 1e-18) {
        return vec![];
    }
    let (q, ac) = ((a2 - c2) / b2, (a2 + c2) / b2);
    let (cb, ab) = (c2 / b2, a2 / b2);
    let polynomial = [
        (1.0 + q).powi(2) - 4.0 * ab * gamma * gamma,
        4.0 * (-q * (1.0 + q) * beta + 2.0 * ab * gamma * gamma * beta
            - (1.0 - ac) * alpha * gamma),
        2.0 * (q * q - 1.0 + 2.0 * q * q * beta * beta + 2.0 * (1.0 - cb) * alpha * alpha
            - 4.0 * ac * alpha * beta * gamma
            + 2.0 * (1.0 - ab) * gamma * gamma),
        4.0 * (q * (1.0 - q) * beta - (1.0 - ac) * alpha * gamma + 2.0 * cb * alpha * alpha * beta),
        (q - 1.0).powi(2) - 4.0 * cb * alpha * alpha,
    ];
    let pose = |v: f64| {
        let under = 2.0 * (gamma - v * alpha);
        let u = ((q - 1.0) * v * v - 2.0 * q * beta * v + 1.0 + q) / under;
        let first = (b2 / (1.0 + v * v - 2.0 * v * beta)).sqrt();
        let lengths = [first, u * first, v * first];
        let fits = lengths.iter().all(|s| s.is_finite() && *s > 0.0);
        fits.then(|| aligned(points, &[0, 1, 2].map(|i| rays[i] * lengths[i])))?
    };
    roots(&polynomial).into_iter().filter_map(pose).collect()
}

/// The motion that takes three points to three more.
fn aligned(from: &[Point3<f64>; 3], to: &[Vector3<f64>; 3]) -> Option<Pose> {
    let frame = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| {
        let x = (b - a).try_normalize(1e-15)?;
        let z = x.cross(&(c - a)).try_normalize(1e-15)?;
        Some(Matrix3::from_columns(&[x, z.cross(&x), z]))
    };
    let [a, b, c] = from.map(|p| p.coords);
    let rotation = frame(to[0], to[1], to[2])? * frame(a, b, c)?.transpose();
    Some(Pose {
        rotation: Rotation3::from_matrix_unchecked(rotation),
        translation: to[0] - rotation * a,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_true_pose_is_among_the_solutions() {
        let mut dice = proof::Dice(21);
        for trial in 0..100 {
            let mut some = || Vector3::new(dice.normal(), dice.normal(), dice.normal());
            let truth = Pose {
                rotation: Rotation3::new(some()),
                translation: Vector3::new(0.3, -0.2, 6.0),
            };
            let points = [0, 1, 2].map(|_| Point3::from(some()));
            let rays = points.map(|p| truth.apply(&p).normalize());
            let found = three_points(&points, &rays);
            assert!(found.len() <= 4);
            let off = |p: &Pose| {
                (p.rotation.matrix() - truth.rotation.matrix()).norm()
                    + (p.translation - truth.translation).norm()
            };
            let best = found.iter().map(off).fold(f64::MAX, f64::min);
            assert!(best < 1e-4, "trial {trial}: {best} of {}", found.len());
        }
    }

    #[test]
    fn points_on_one_place_have_no_pose_and_no_panic() {
        let points = [Point3::new(1.0, 2.0, 3.0); 3];
        let rays = [Vector3::z(); 3];
        assert!(three_points(&points, &rays).is_empty());
    }
}
