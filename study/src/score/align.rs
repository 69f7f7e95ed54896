//! The motion that carries points onto points in the least-squares sense (Umeyama 1991).

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// `to = scale * rotation * from + translation`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) scale: f64,
    pub(crate) rotation: Rotation3<f64>,
    pub(crate) translation: Vector3<f64>,
}

impl Motion {
    /// No motion.
    pub(crate) fn none() -> Self {
        Motion {
            scale: 1.0,
            rotation: Rotation3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// This motion, and then another.
    pub(crate) fn then(&self, next: &Motion) -> Self {
        Motion {
            scale: self.scale * next.scale,
            rotation: next.rotation * self.rotation,
            translation: next.rotation * self.translation * next.scale + next.translation,
        }
    }

    /// Carries a point.
    pub(crate) fn apply(&self, p: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.rotation * p.coords * self.scale + self.translation)
    }
}

/// The best motion from pairs (from, to), with or without a scale. Needs three pairs.
pub(crate) fn align(pairs: &[(Point3<f64>, Point3<f64>)], with_scale: bool) -> Option<Motion> {
    if pairs.len() < 3 {
        return None;
    }
    let n = pairs.len() as f64;
    let a = pairs.iter().map(|p| p.0.coords).sum::<Vector3<f64>>() / n;
    let b = pairs.iter().map(|p| p.1.coords).sum::<Vector3<f64>>() / n;
    let (mut covariance, mut spread) = (Matrix3::zeros(), 0.0);
    for (from, to) in pairs {
        let (from, to) = (from.coords - a, to.coords - b);
        covariance += to * from.transpose() / n;
        spread += from.norm_squared() / n;
    }
    let svd = covariance.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let sign = (u * v_t).determinant().signum();
    let flip = Vector3::new(1.0, 1.0, sign);
    let rotation = Rotation3::from_matrix_unchecked(u * Matrix3::from_diagonal(&flip) * v_t);
    let scale = if with_scale {
        svd.singular_values.dot(&flip) / spread
    } else {
        1.0
    };
    Some(Motion {
        scale,
        rotation,
        translation: b - rotation * a * scale,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_motion_is_found() {
        let mut dice = proof::Dice(3);
        let rotation = Rotation3::from_euler_angles(0.4, -1.1, 2.0);
        let known = Motion {
            scale: 1.7,
            rotation,
            translation: Vector3::new(5.0, -3.0, 9.0),
        };
        let mut point = || Point3::new(dice.normal(), dice.normal(), dice.normal());
        let pairs: Vec<_> = (0..9)
            .map(|_| point())
            .map(|p| (p, known.apply(&p)))
            .collect();
        let found = align(&pairs, true).unwrap();
        proof::near(found.scale, 1.7, 1e-12);
        assert!(
            pairs
                .iter()
                .all(|(from, to)| (found.apply(from) - to).norm() < 1e-12)
        );
        let twice = found.then(&known);
        let (from, to) = pairs[0];
        assert!((twice.apply(&from) - known.apply(&to)).norm() < 1e-11);
    }
}
