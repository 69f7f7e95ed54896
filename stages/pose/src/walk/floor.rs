//! The floor that a subject is on: a nearly level plane under which there is next to nothing.

use crate::frame::placed_tag::LEVEL_RAD;
use crate::two_view::epipolar::draws;
use nalgebra::{Matrix3, Point3, Vector3};

/// How thick a floor is, as a share of the cameras' distance. By hand: looked at one capture, halved and doubled:
/// nothing changes, for no floor is found (docs/lab/numbers.md).
const THICK_SHARE: f64 = 0.01;
/// Least share of the points near the subject that are on the floor, and of those under it at most. By hand: looked at
/// one capture, halved and doubled: nothing changes, for no floor is found (docs/lab/numbers.md).
const SHARES: [f64; 2] = [0.08, 0.03];
/// Fewest points of a floor. By hand: looked at one capture, halved and doubled: nothing changes, for no floor is found
/// (docs/lab/numbers.md).
const LEAST_POINTS: usize = 50;

/// The lowest plane that is nearly level and holds many points within `reach` of the origin, as its
/// normal and a point on it.
pub(crate) fn floor(
    points: &[Point3<f64>],
    origin: &Point3<f64>,
    up: &Vector3<f64>,
    reach: f64,
) -> Option<(Vector3<f64>, Point3<f64>)> {
    let near: Vec<Point3<f64>> = points
        .iter()
        .filter(|p| (**p - origin).norm() < reach)
        .copied()
        .collect();
    if near.len() < 4 * LEAST_POINTS {
        return None;
    }
    let thick = THICK_SHARE * reach;
    let height = |p: &Point3<f64>, normal: &Vector3<f64>| (p - origin).dot(normal);
    let mut place = draws(1, near.len());
    let mut draw = || near[place()];
    let mut best: Option<(usize, Vector3<f64>, f64)> = None;
    for _ in 0..4000 {
        let (a, b, c) = (draw(), draw(), draw());
        let Some(mut normal) = (b - a).cross(&(c - a)).try_normalize(1e-12) else {
            continue;
        };
        normal *= normal.dot(up).signum();
        let at = height(&a, &normal);
        if normal.angle(up) > LEVEL_RAD || at > 0.0 {
            continue;
        }
        let on = near
            .iter()
            .filter(|p| (height(p, &normal) - at).abs() < thick);
        let count = on.count();
        if best.is_none_or(|(most, ..)| count > most) {
            best = Some((count, normal, at));
        }
    }
    let (_, mut normal, mut at) = best?;
    for _ in 0..5 {
        let on = |p: &&Point3<f64>| (height(p, &normal) - at).abs() < thick;
        let on: Vec<Vector3<f64>> = near.iter().filter(on).map(|p| p.coords).collect();
        let mean = on.iter().sum::<Vector3<f64>>() / on.len().max(1) as f64;
        let spread: Matrix3<f64> = on.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
        let eigen = spread.symmetric_eigen();
        let least: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
        normal = least * least.dot(up).signum();
        at = height(&mean.into(), &normal);
    }
    let on = near
        .iter()
        .filter(|p| (height(p, &normal) - at).abs() < thick)
        .count();
    let under = near
        .iter()
        .filter(|p| height(p, &normal) < at - 2.0 * thick)
        .count();
    let share = |count: usize| count as f64 / near.len() as f64;
    let holds = on >= LEAST_POINTS && share(on) >= SHARES[0] && share(under) <= SHARES[1];
    (holds && normal.angle(up) <= LEVEL_RAD).then(|| (normal, origin + normal * at))
}
