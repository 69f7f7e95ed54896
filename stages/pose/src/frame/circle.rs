//! The turntable frame from cameras alone: the circle through their centres.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::{Camera, Cameras, Pose};

/// Size of a ring while its millimetres are unknown: the cameras' mean distance from the axis (structural: a unit). \[mm\]
pub(crate) const RING_MM: f64 = 1000.0;

/// A circle in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its centre. \[mm\]
    pub centre: Point3<f64>,
    /// Its axis, unit.
    pub axis: Vector3<f64>,
    /// Its radius. \[mm\]
    pub radius: f64,
    /// Root mean square of the points' distance from it. \[mm\]
    pub rms: f64,
}

/// The circle through points: the plane by total least squares, then Kåsa's circle in it. `None`
/// for fewer than three points or points on a line.
pub fn circle(points: &[Point3<f64>]) -> Option<Circle> {
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let mean = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count;
    let spread: Matrix3<f64> = points
        .iter()
        .map(|p| (p.coords - mean) * (p.coords - mean).transpose())
        .sum();
    let eigen = spread.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    if eigen.eigenvalues[order[1]] < 1e-9 * eigen.eigenvalues[order[2]] {
        return None;
    }
    let axis: Vector3<f64> = eigen.eigenvectors.column(order[0]).into();
    let (u, v): (Vector3<f64>, Vector3<f64>) = (
        eigen.eigenvectors.column(order[1]).into(),
        eigen.eigenvectors.column(order[2]).into(),
    );
    // 2 a x + 2 b y + c = x² + y²
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for p in points {
        let d = p.coords - mean;
        let (x, y) = (d.dot(&u), d.dot(&v));
        let row = Vector3::new(2.0 * x, 2.0 * y, 1.0);
        matrix += row * row.transpose();
        right += row * (x * x + y * y);
    }
    let abc = matrix.try_inverse()? * right;
    let radius = (abc.z + abc.x * abc.x + abc.y * abc.y).sqrt();
    let centre = Point3::from(mean + u * abc.x + v * abc.y);
    let off = |p: &Point3<f64>| {
        let d = p - centre;
        let up = d.dot(&axis);
        up * up + ((d - axis * up).norm() - radius).powi(2)
    };
    let rms = (points.iter().map(off).sum::<f64>() / count).sqrt();
    Some(Circle {
        centre,
        axis,
        radius,
        rms,
    })
}

/// The circle of cameras' centres, its axis up in the photos.
pub fn camera_circle(cameras: &Cameras) -> Option<Circle> {
    let centres: Vec<Point3<f64>> = cameras.views.values().map(|v| v.camera.centre()).collect();
    let mut found = circle(&centres)?;
    let up: f64 = cameras
        .views
        .values()
        .map(|v| -(v.camera.pose.rotation * found.axis).y)
        .sum();
    if up < 0.0 {
        found.axis = -found.axis;
    }
    Some(found)
}

/// Cameras and points in another world, `x' = size · turn · (x - origin)`.
pub fn moved(cameras: &Cameras, turn: &Rotation3<f64>, origin: &Point3<f64>, size: f64) -> Cameras {
    let mut moved = cameras.clone();
    moved.views = cameras.views.map(|_, view| {
        let pose = &view.camera.pose;
        let mut view = view.clone();
        let rotation = pose.rotation * turn.inverse();
        view.camera = Camera {
            lens: view.camera.lens,
            pose: Pose {
                rotation,
                translation: pose.apply(origin) * size,
            },
        };
        view.sigma_mm = view.sigma_mm.map(|mm| mm * size);
        view
    });
    for point in &mut moved.points {
        let p = Point3::from(point.map(f64::from));
        *point = (turn * (p - origin) * size).map(|x| x as f32).into();
    }
    moved.ground_mm *= size;
    moved.disk_radius_mm = cameras.disk_radius_mm.map(|r| r * size);
    moved
}

/// Cameras with the circle's axis as z, its centre above the origin and the ring's radius as given.
/// The first camera looks along +y. The origin is where the axis comes nearest to the middle of
/// what is seen. As they were where their centres are on no circle.
pub(crate) fn in_ring_frame(cameras: &Cameras, radius_mm: f64) -> Cameras {
    let Some(circle) = camera_circle(cameras) else {
        return cameras.clone();
    };
    let Some(first) = cameras.views.values().next() else {
        return cameras.clone();
    };
    let z = circle.axis;
    let inward = circle.centre - first.camera.centre();
    let y = (inward - z * z.dot(&inward)).normalize();
    let rows = Matrix3::from_rows(&[y.cross(&z).transpose(), y.transpose(), z.transpose()]);
    let turn = Rotation3::from_matrix_unchecked(rows);
    moved(cameras, &turn, &circle.centre, radius_mm / circle.radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_through_points_of_a_tilted_arc_is_found() {
        let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
        let centre = Point3::new(300.0, -80.0, 1200.0);
        let at = |k: i32| {
            let (sin, cos) = libm::sincos(f64::from(k) * 0.21);
            centre + turn * Vector3::new(900.0 * cos, 900.0 * sin, 0.0)
        };
        let found = circle(&(0..9).map(at).collect::<Vec<_>>()).unwrap();
        assert!((found.centre - centre).norm() < 1e-6);
        assert!((found.axis.dot(&(turn * Vector3::z())).abs() - 1.0).abs() < 1e-12);
        proof::near(found.radius, 900.0, 1e-6);
        assert!(found.rms < 1e-6);
    }

    #[test]
    fn points_on_a_line_have_no_circle() {
        let line: Vec<_> = (0..5)
            .map(|i| Point3::new(f64::from(i), 0.0, 0.0))
            .collect();
        assert_eq!(circle(&line), None);
    }
}
