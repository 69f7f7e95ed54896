//! A camera's pose: relative to another one (from what both see), and from known points.

use crate::two_view::descent::descend;
use crate::two_view::epipolar::motion_through;
use crate::two_view::five_point::Both;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use shape::triangulate;
use shape::{Camera, Intrinsics, Pose};

/// Least share of known points that a pose must explain. By hand: not on record.
const LEAST_SHARE: f64 = 0.3;

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
    best.filter(|(count, _)| *count >= 12).map(|(_, pose)| pose)
}

/// The pose from which known points are seen where they were seen: from an affine camera of four
/// points (most agree of many samples), then all, by their pixels. `None` where too few agree.
pub(crate) fn resected(
    lens: &Intrinsics,
    nearby: &[Pose],
    known: &[(Point3<f64>, [f64; 2])],
    near_px: f64,
) -> Option<Pose> {
    let off = |pose: &Pose, (point, px): &(Point3<f64>, [f64; 2])| {
        let camera = Camera {
            lens: *lens,
            pose: *pose,
        };
        let at = camera.project(point);
        at.map_or(1e4, |at| libm::hypot(at.x - px[0], at.y - px[1]))
    };
    let agree = |pose: &Pose, most: f64| known.iter().filter(|k| off(pose, k) < most).count();
    let mut starts: Vec<(usize, Pose)> = nearby.iter().map(|p| (agree(p, 60.0), *p)).collect();
    let mut dice = 0x2545_F491_4F6C_DD1D_u64;
    let mut draw = || {
        dice = dice
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((dice >> 33) as usize) % known.len()
    };
    for _ in 0..800 {
        let sample = [draw(), draw(), draw(), draw()].map(|i| &known[i]);
        if let Some(pose) = affine(lens, &sample) {
            starts.push((agree(&pose, 30.0), pose));
        }
    }
    starts.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    starts
        .into_iter()
        .take(5)
        .map(|(_, start)| refined(lens, &start, known))
        .map(|pose| (agree(&pose, near_px), pose))
        .max_by_key(|(count, _)| *count)
        .filter(|(count, _)| *count >= 12 && *count as f64 >= LEAST_SHARE * known.len() as f64)
        .map(|(_, pose)| pose)
}

/// The pose of an affine camera through four points: axes made orthogonal, depth from their size
/// (DeMenthon and Davis 1995).
fn affine(lens: &Intrinsics, sample: &[&(Point3<f64>, [f64; 2]); 4]) -> Option<Pose> {
    let from = sample[0].0;
    let p = |i: usize| lens.undistort(sample[i].1.into());
    let rows = [1, 2, 3].map(|i| (sample[i].0 - from).transpose());
    let inverse = Matrix3::from_rows(&rows).try_inverse()?;
    let q = [1, 2, 3].map(|i| p(i) - p(0));
    let a = inverse * Vector3::new(q[0].x, q[1].x, q[2].x);
    let b = inverse * Vector3::new(q[0].y, q[1].y, q[2].y);
    let size = (a.norm() * b.norm()).sqrt();
    let ratio = a.norm() / b.norm();
    if !(0.6..1.7).contains(&ratio) || a.normalize().dot(&b.normalize()).abs() > 0.5 {
        return None;
    }
    let (x, y) = (a.normalize(), b.normalize());
    let (sum, difference) = ((x + y).normalize(), (x - y).normalize());
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let (x, y) = ((sum + difference) * half, (sum - difference) * half);
    let z = x.cross(&y);
    let rotation = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
    let depth = 1.0 / size;
    let at = Vector3::new(p(0).x, p(0).y, 1.0) * depth;
    Some(Pose {
        rotation: Rotation3::from_matrix_unchecked(rotation),
        translation: at - rotation * from.coords,
    })
}

/// Robust least squares over the six numbers of a pose.
fn refined(lens: &Intrinsics, start: &Pose, known: &[(Point3<f64>, [f64; 2])]) -> Pose {
    let size = start.translation.norm().max(1e-9);
    let moved = |x: &[f64]| Pose {
        rotation: Rotation3::new(Vector3::new(x[0], x[1], x[2])) * start.rotation,
        translation: start.translation + Vector3::new(x[3], x[4], x[5]) * size,
    };
    let residuals = |x: &[f64]| -> Vec<f64> {
        let camera = Camera {
            lens: *lens,
            pose: moved(x),
        };
        let off = |(point, px): &(Point3<f64>, [f64; 2])| match camera.project(point) {
            Some(at) => [at.x - px[0], at.y - px[1]],
            None => [1e4, 1e4],
        };
        known.iter().flat_map(off).collect()
    };
    moved(&descend(&[0.0; 6], residuals, 4.0, 40))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_found_among_points_a_third_of_which_are_wrong() {
        let lens = Intrinsics::simple(640, 480, 1500.0);
        let truth = Pose {
            rotation: Rotation3::from_euler_angles(2.9, 0.4, 1.2),
            translation: Vector3::new(10.0, -20.0, 900.0),
        };
        let camera = Camera { lens, pose: truth };
        let mut dice = proof::Dice(3);
        let mut known = Vec::new();
        for i in 0..90 {
            let point = Point3::new(
                dice.within(-100.0, 100.0),
                dice.within(-100.0, 100.0),
                dice.within(-100.0, 100.0),
            );
            let at = camera.project(&point).unwrap();
            let wrong = if i % 3 == 0 { 80.0 } else { 0.2 };
            known.push((
                point,
                [at.x + wrong * dice.normal(), at.y + wrong * dice.normal()],
            ));
        }
        let found = resected(&lens, &[], &known, 3.0).unwrap();
        assert!(found.rotation.angle_to(&truth.rotation) < 2e-3);
        assert!((found.centre() - truth.centre()).norm() < 5.0);
    }

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
