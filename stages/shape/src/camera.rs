//! A pinhole camera with two radial coefficients, and its pose.

use nalgebra::{Matrix2x3, Matrix3, Point2, Point3, Rotation3, UnitVector3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// What the lens and the sensor do: `u = c + f (1 + k1 r² + k2 r⁴) (x/z, y/z)`, `r² = (x²+y²)/z²`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Intrinsics {
    /// Width of the photo. \[px\]
    pub width: u32,
    /// Height of the photo. \[px\]
    pub height: u32,
    /// Focal length along x and y. \[px\]
    pub focal: [f64; 2],
    /// Principal point. \[px\]
    pub centre: [f64; 2],
    /// Radial distortion k1, k2.
    pub radial: [f64; 2],
}

/// The pose of a camera: `x_in_camera = rotation * x_in_world + translation`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Rotation of camera_from_world.
    pub rotation: Rotation3<f64>,
    /// Translation of camera_from_world. \[mm\]
    pub translation: Vector3<f64>,
}

/// Lens, sensor and place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Lens and sensor.
    pub lens: Intrinsics,
    /// camera_from_world.
    pub pose: Pose,
}

impl Pose {
    /// The camera's centre in the world. \[mm\]
    pub fn centre(&self) -> Point3<f64> {
        Point3::from(-(self.rotation.inverse() * self.translation))
    }

    /// From the world to the camera.
    #[inline]
    pub fn apply(&self, x_in_world: &Point3<f64>) -> Vector3<f64> {
        self.rotation * x_in_world.coords + self.translation
    }
}

impl Intrinsics {
    /// A distortion-free lens with its principal point in the middle of the photo.
    pub fn simple(width: u32, height: u32, focal_px: f64) -> Self {
        let centre = [
            (f64::from(width) - 1.0) / 2.0,
            (f64::from(height) - 1.0) / 2.0,
        ];
        Intrinsics {
            width,
            height,
            focal: [focal_px; 2],
            centre,
            radial: [0.0; 2],
        }
    }

    /// The pixel of a direction in the camera's frame. [`None`] behind the camera.
    #[inline]
    pub fn project(&self, x_in_camera: &Vector3<f64>) -> Option<Point2<f64>> {
        if x_in_camera.z <= 0.0 {
            return None;
        }
        Some(self.distort(Vector2::new(x_in_camera.x, x_in_camera.y) / x_in_camera.z))
    }

    /// The pixel of a point on the plane z = 1.
    #[inline(always)]
    pub fn distort(&self, p: Vector2<f64>) -> Point2<f64> {
        let r2 = p.norm_squared();
        let q = p * (1.0 + r2 * (self.radial[0] + r2 * self.radial[1]));
        Point2::new(
            self.centre[0] + self.focal[0] * q.x,
            self.centre[1] + self.focal[1] * q.y,
        )
    }

    /// The point on the plane z = 1 that is seen at a pixel: [`distort`](Self::distort) undone
    /// by Newton's method on the radius.
    pub fn undistort(&self, at_px: Point2<f64>) -> Vector2<f64> {
        let q = Vector2::new(
            (at_px.x - self.centre[0]) / self.focal[0],
            (at_px.y - self.centre[1]) / self.focal[1],
        );
        let [k1, k2] = self.radial;
        if k1 == 0.0 && k2 == 0.0 {
            return q;
        }
        let target = q.norm();
        if target == 0.0 {
            return q;
        }
        let mut r = target;
        for _ in 0..20 {
            let r2 = r * r;
            let slope = 1.0 + r2 * (3.0 * k1 + 5.0 * r2 * k2);
            let step = (r * (1.0 + r2 * (k1 + r2 * k2)) - target) / slope.max(0.1);
            r -= step;
            if step.abs() < 1e-14 {
                break;
            }
        }
        q * (r / target)
    }

    /// The same lens on a photo resized by `factor`; pixel centres stay at integers.
    pub fn resized(&self, width: u32, height: u32) -> Self {
        let s = [
            f64::from(width) / f64::from(self.width),
            f64::from(height) / f64::from(self.height),
        ];
        let moved = |c: f64, s: f64| (c + 0.5) * s - 0.5;
        Intrinsics {
            width,
            height,
            focal: [self.focal[0] * s[0], self.focal[1] * s[1]],
            centre: [moved(self.centre[0], s[0]), moved(self.centre[1], s[1])],
            radial: self.radial,
        }
    }

    /// The calibration matrix K.
    pub fn matrix(&self) -> Matrix3<f64> {
        let ([fx, fy], [cx, cy]) = (self.focal, self.centre);
        Matrix3::new(fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0)
    }
}

impl Camera {
    /// A camera at a place that looks at another one, not above or below it; z is up on its photo. \[mm\]
    pub fn looking(lens: Intrinsics, from: Point3<f64>, at: Point3<f64>) -> Camera {
        let ahead = (at - from).normalize();
        let right = ahead.cross(&Vector3::z()).normalize();
        let rows = [right, ahead.cross(&right), ahead].map(|r| r.transpose());
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows));
        let translation = -(rotation * from.coords);
        let pose = Pose {
            rotation,
            translation,
        };
        Camera { lens, pose }
    }

    /// The camera's centre in the world. \[mm\]
    pub fn centre(&self) -> Point3<f64> {
        self.pose.centre()
    }

    /// The pixel of a point. [`None`] behind the camera.
    #[inline]
    pub fn project(&self, x_in_world: &Point3<f64>) -> Option<Point2<f64>> {
        self.lens.project(&self.pose.apply(x_in_world))
    }

    /// The pixel of a point and its distance along the optical axis. \[px, mm\]
    #[inline]
    pub fn project_with_depth(&self, x_in_world: &Point3<f64>) -> Option<(Point2<f64>, f64)> {
        let x = self.pose.apply(x_in_world);
        Some((self.lens.project(&x)?, x.z))
    }

    /// As [`project`](Self::project), with the derivative by the point. \[px/mm\]
    pub fn project_with_jacobian(
        &self,
        x_in_world: &Point3<f64>,
    ) -> Option<(Point2<f64>, Matrix2x3<f64>)> {
        let x = self.pose.apply(x_in_world);
        if x.z <= 0.0 {
            return None;
        }
        let p = Vector2::new(x.x, x.y) / x.z;
        let (r2, [k1, k2]) = (p.norm_squared(), self.lens.radial);
        let gain = 1.0 + r2 * (k1 + r2 * k2);
        let slope = 2.0 * (k1 + 2.0 * k2 * r2);
        // d(gain p)/dp = gain I + slope p pᵀ
        let by_p = nalgebra::Matrix2::identity() * gain + p * p.transpose() * slope;
        let by_x = Matrix2x3::new(1.0, 0.0, -p.x, 0.0, 1.0, -p.y) / x.z;
        let [fx, fy] = self.lens.focal;
        let f = nalgebra::Matrix2::new(fx, 0.0, 0.0, fy);
        Some((
            self.lens.distort(p),
            f * by_p * by_x * self.pose.rotation.matrix(),
        ))
    }

    /// The direction in the world that is seen at a pixel.
    pub fn ray(&self, at_px: Point2<f64>) -> UnitVector3<f64> {
        let p = self.lens.undistort(at_px);
        let d = self.pose.rotation.inverse() * Vector3::new(p.x, p.y, 1.0);
        UnitVector3::new_normalize(d)
    }

    /// The height at which the ray of a pixel passes the axis. \[mm\]
    pub fn height_at_axis(&self, at_px: Point2<f64>) -> f64 {
        let (centre, ray) = (self.centre(), self.ray(at_px));
        let away = libm::hypot(centre.x, centre.y) / libm::hypot(ray.x, ray.y).max(1e-9);
        centre.z + ray.z * away
    }

    /// The same camera for a photo of another size.
    pub fn resized(&self, width: u32, height: u32) -> Self {
        Camera {
            lens: self.lens.resized(width, height),
            pose: self.pose,
        }
    }

    /// Whether a pixel is on the photo.
    #[inline]
    pub fn holds(&self, at_px: Point2<f64>) -> bool {
        let (w, h) = (f64::from(self.lens.width), f64::from(self.lens.height));
        at_px.x >= -0.5 && at_px.y >= -0.5 && at_px.x < w - 0.5 && at_px.y < h - 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let mut lens = Intrinsics::simple(1600, 2400, 3300.0);
        lens.radial = [-0.12, 0.04];
        let rotation = Rotation3::from_euler_angles(1.4, -0.2, 0.7);
        Camera {
            lens,
            pose: Pose {
                rotation,
                translation: Vector3::new(40.0, 700.0, 1700.0),
            },
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_projection() {
        let camera = camera();
        for x in [Vector3::zeros(), Vector3::new(80.0, -300.0, 55.0)] {
            proof::jacobian(x, 1e-4, |x: Vector3<f64>| {
                let (at_px, jacobian) = camera.project_with_jacobian(&x.into()).unwrap();
                (at_px.coords, jacobian)
            });
        }
    }

    #[test]
    fn a_ray_meets_the_point_that_was_projected() {
        let camera = camera();
        let x = Point3::new(120.0, -40.0, 300.0);
        let ray = camera.ray(camera.project(&x).unwrap());
        let to = x - camera.centre();
        assert!((to - *ray * to.dot(&ray)).norm() < 1e-9);
    }

    #[test]
    fn a_resized_camera_sees_the_same() {
        let camera = camera();
        let x = Point3::new(120.0, -40.0, 300.0);
        let (whole, half) = (
            camera.project(&x).unwrap(),
            camera.resized(800, 1200).project(&x).unwrap(),
        );
        assert!(((whole.coords.add_scalar(0.5)) / 2.0 - half.coords.add_scalar(0.5)).norm() < 1e-9);
    }
}
