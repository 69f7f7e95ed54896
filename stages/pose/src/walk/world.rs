//! The frame of a walk: the origin where all cameras look, z up.

use crate::walk::floor::floor;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::{Camera, Cameras, upper_median};

/// Where cameras look, and what is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct World {
    /// The point nearest to what all cameras look at.
    pub origin: Point3<f64>,
    /// Up, unit.
    pub up: Vector3<f64>,
    /// Whether a floor was found.
    pub floor: Option<f64>,
    /// Mean distance of cameras from the line through the origin that goes up.
    pub radius: f64,
}

/// How strongly the photos' own upright counts against their horizontals: it decides only where horizontals leave it
/// open. By hand: looked at one capture, halved and doubled: no more than chance (docs/lab/numbers.md).
const OWN_WEIGHT: f64 = 0.01;
/// Axes whose spread is to this share along one direction point one way. By hand: looked at one capture, halved and
/// doubled: nothing changes, for its photos are upright (docs/lab/numbers.md).
const ONE_WAY_SHARE: f64 = 0.9;
/// Rounds of reweighting (structural: a search's end).
const ROUNDS: usize = 10;

/// The frame of cameras whose photos are upright, and of points around them. None for cameras that
/// all look in one direction.
pub fn world(cameras: &[Camera], points: &[Point3<f64>]) -> Option<World> {
    let origin = fixation(cameras)?;
    let tilted = upward(cameras)?;
    let far: Vec<f64> = cameras
        .iter()
        .map(|c| (c.centre() - origin).norm())
        .collect();
    let floor = floor(points, &origin, &tilted, upper_median(&far).unwrap_or(0.0));
    let up = floor.map_or(tilted, |f| f.0);
    let out = |c: &Camera| {
        let d = c.centre() - origin;
        (d - up * up.dot(&d)).norm()
    };
    let radius = cameras.iter().map(out).sum::<f64>() / cameras.len() as f64;
    let floor = floor.map(|(up, on)| (on - origin).dot(&up));
    (radius > 0.0).then_some(World {
        origin,
        up,
        floor,
        radius,
    })
}

/// The point nearest to all axes of view: argmin Σ w ‖(I − ddᵀ)(x − c)‖², those that look elsewhere
/// weighing less.
fn fixation(cameras: &[Camera]) -> Option<Point3<f64>> {
    let axis = |c: &Camera| {
        let d = c.pose.rotation.inverse() * Vector3::z();
        (Matrix3::identity() - d * d.transpose(), c.centre().coords)
    };
    let all: Vec<(Matrix3<f64>, Vector3<f64>)> = cameras.iter().map(axis).collect();
    let mut weights = vec![1.0; all.len()];
    let mut at = Vector3::zeros();
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for ((across, centre), w) in all.iter().zip(&weights) {
            normal += across * *w;
            right += across * centre * *w;
        }
        let least = normal.symmetric_eigenvalues().min();
        if least < 1e-6 * normal.trace() {
            return None;
        }
        at = normal.try_inverse()? * right;
        let off: Vec<f64> = all.iter().map(|(m, c)| (m * (at - c)).norm()).collect();
        let usual = upper_median(&off).unwrap_or(0.0).max(1e-12);
        weights = off
            .iter()
            .map(|o| 1.0 / (1.0 + (o / usual / 2.0).powi(2)))
            .collect();
    }
    Some(at.into())
}

/// Axes of the cameras in the world.
fn axes(cameras: &[Camera], axis: Vector3<f64>) -> Vec<Vector3<f64>> {
    let of = |c: &Camera| c.pose.rotation.inverse() * axis;
    cameras.iter().map(of).collect()
}

/// Whether photos are on their side: their x axes all point one way, and their y axes do not.
pub(crate) fn on_side(cameras: &[Camera]) -> bool {
    let one_way = |axis: Vector3<f64>| {
        let spread: Matrix3<f64> = axes(cameras, axis).iter().map(|a| a * a.transpose()).sum();
        spread.symmetric_eigenvalues().max() > ONE_WAY_SHARE * cameras.len() as f64
    };
    one_way(Vector3::x()) && !one_way(Vector3::y())
}

/// What is level in photos is level in the world: up is across most of the photos' x axes. Of photos
/// that are on their side it is across the y axes, and cameras look down rather than up.
fn upward(cameras: &[Camera]) -> Option<Vector3<f64>> {
    let mean = |all: &[Vector3<f64>]| all.iter().sum::<Vector3<f64>>().try_normalize(1e-6);
    let (level, own) = match on_side(cameras) {
        false => (
            axes(cameras, Vector3::x()),
            mean(&axes(cameras, -Vector3::y()))?,
        ),
        true => {
            let up = mean(&axes(cameras, Vector3::x()))?;
            let ahead: f64 = axes(cameras, Vector3::z()).iter().map(|z| z.dot(&up)).sum();
            (
                axes(cameras, Vector3::y()),
                if ahead > 0.0 { -up } else { up },
            )
        }
    };
    let mut weights = vec![1.0; level.len()];
    let mut up = own;
    for _ in 0..ROUNDS {
        let mut normal = Matrix3::zeros();
        for (x, w) in level.iter().zip(&weights) {
            normal += x * x.transpose() * *w;
        }
        let own_weight = OWN_WEIGHT * weights.iter().sum::<f64>();
        normal += Matrix3::identity() * own_weight;
        up = (normal.try_inverse()? * own * own_weight).try_normalize(1e-12)?;
        let off: Vec<f64> = level.iter().map(|x| x.dot(&up).abs()).collect();
        let usual = upper_median(&off).unwrap_or(0.0).max(0.01);
        let weight = |o: &f64| 1.0 / (1.0 + (o / usual / 2.0).powi(2));
        weights = off.iter().map(weight).collect();
    }
    Some(up)
}

/// The turn to the frame: z up, the first camera looks along +y.
pub(crate) fn turn(world: &World, first: &Camera) -> Rotation3<f64> {
    let z = world.up;
    let inward = world.origin - first.centre();
    let y = (inward - z * z.dot(&inward))
        .try_normalize(1e-9)
        .unwrap_or_else(|| {
            Rotation3::rotation_between(&Vector3::z(), &z)
                .map_or(Vector3::y(), |r| r * Vector3::y())
        });
    let rows = [y.cross(&z).transpose(), y.transpose(), z.transpose()];
    Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows))
}

/// Leaves points out that are further from the axis than the cameras: the background.
pub(crate) fn nearby(cameras: &mut Cameras, radius: f64) {
    cameras
        .points
        .retain(|p| libm::hypot(f64::from(p[0]), f64::from(p[1])) < radius);
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Intrinsics, Pose};

    /// Cameras about a point, that look at it from different heights and distances, rolled a little.
    fn around(origin: &Point3<f64>, tilt: &Rotation3<f64>) -> Vec<Camera> {
        let mut dice = proof::Dice(5);
        (0..20)
            .map(|k| {
                let angle = f64::from(k) * 0.31;
                let far = dice.within(2.0, 3.0);
                let from = Vector3::new(
                    far * libm::cos(angle),
                    far * libm::sin(angle),
                    dice.within(-0.5, 0.8),
                );
                let forward = -from.normalize();
                let right = forward.cross(&Vector3::z()).normalize();
                let rows = [right, forward.cross(&right), forward].map(|r| r.transpose());
                let rotation = Rotation3::from_euler_angles(0.0, 0.0, 0.03 * dice.normal())
                    * Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows))
                    * tilt.inverse();
                let centre = origin + tilt * from;
                Camera {
                    lens: Intrinsics::simple(600, 800, 700.0),
                    pose: Pose {
                        rotation,
                        translation: -(rotation * centre.coords),
                    },
                }
            })
            .collect()
    }

    #[test]
    fn up_and_middle_are_found_and_a_floor_makes_up_exact() {
        let tilt = Rotation3::from_euler_angles(0.7, -0.4, 0.2);
        let origin = Point3::new(4.0, -2.0, 7.0);
        let cameras = around(&origin, &tilt);
        let found = world(&cameras, &[]).unwrap();
        assert!((found.origin - origin).norm() < 1e-6);
        assert!(found.up.angle(&(tilt * Vector3::z())) < 0.02);
        assert_eq!(found.floor, None);
        let mut dice = proof::Dice(6);
        let mut points = Vec::new();
        for k in 0..600 {
            let mut x = || dice.within(-1.2, 1.2);
            let z = if k % 3 == 0 { -0.9 } else { 0.6 * x() };
            points.push(origin + tilt * Vector3::new(x(), x(), z));
        }
        let found = world(&cameras, &points).unwrap();
        proof::near(found.floor.unwrap(), -0.9, 1e-3);
        assert!(found.up.angle(&(tilt * Vector3::z())) < 1e-3);
    }

    #[test]
    fn photos_on_their_side_are_recognised() {
        let origin = Point3::new(4.0, -2.0, 7.0);
        let mut cameras = around(&origin, &Rotation3::identity());
        assert!(!on_side(&cameras));
        let quarter = Rotation3::from_euler_angles(0.0, 0.0, -std::f64::consts::FRAC_PI_2);
        for camera in &mut cameras {
            camera.pose.rotation = quarter * camera.pose.rotation;
            camera.pose.translation = quarter * camera.pose.translation;
        }
        assert!(on_side(&cameras));
        let found = world(&cameras, &[]).unwrap();
        assert!(found.up.angle(&Vector3::z()) < 0.05, "{}", found.up);
    }

    #[test]
    fn cameras_that_look_one_way_have_no_middle() {
        let mut cameras = around(&Point3::origin(), &Rotation3::identity());
        let first = cameras[0].pose.rotation;
        cameras.iter_mut().for_each(|c| c.pose.rotation = first);
        assert_eq!(world(&cameras, &[]), None);
    }
}
