//! Tracks as points in the world: triangulation from known cameras.

use nalgebra::{Matrix3, Point3, Vector3};
use shape::{Camera, Intrinsics, LEAST_PARALLAX_RAD, PhotoId, Pose, Tracks};

/// A triangulated track: cameras by their place in the list, pixels.
pub(crate) struct Seen {
    pub(crate) point: Point3<f64>,
    pub(crate) observations: Vec<(usize, [f64; 2])>,
    pub(crate) rms_px: f64,
}

/// The tracks whose points project within `most_px` of where they were seen.
pub(crate) fn triangulated(
    lens: &Intrinsics,
    poses: &[Pose],
    ids: &[PhotoId],
    tracks: &Tracks,
    most_px: f64,
) -> Vec<Seen> {
    let cameras: Vec<Camera> = poses
        .iter()
        .map(|pose| Camera {
            lens: *lens,
            pose: *pose,
        })
        .collect();
    let one = |track: &Vec<shape::Observation>| {
        let place = |s: &shape::Observation| {
            let camera = ids.iter().position(|id| *id == s.photo)?;
            Some((camera, s.at_px.map(f64::from)))
        };
        let observations: Vec<(usize, [f64; 2])> = track.iter().filter_map(place).collect();
        let (point, rms_px) = triangulate(&cameras, &observations)?;
        (rms_px < most_px).then_some(Seen {
            point,
            observations,
            rms_px,
        })
    };
    tracks.points.iter().filter_map(one).collect()
}

/// The point nearest to all rays, then two Gauss–Newton steps on the pixels, and its residual.
pub(crate) fn triangulate(
    cameras: &[Camera],
    observations: &[(usize, [f64; 2])],
) -> Option<(Point3<f64>, f64)> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    let mut rays = Vec::new();
    for (c, px) in observations {
        let ray = cameras[*c].ray((*px).into()).into_inner();
        let across = Matrix3::identity() - ray * ray.transpose();
        normal += across;
        right += across * cameras[*c].centre().coords;
        rays.push(ray);
    }
    let widest = rays
        .iter()
        .flat_map(|a| rays.iter().map(move |b| a.angle(b)))
        .fold(0.0, f64::max);
    if widest < LEAST_PARALLAX_RAD {
        return None;
    }
    let mut point = Point3::from(normal.try_inverse()? * right);
    for _ in 0..2 {
        let (mut h, mut g) = (Matrix3::zeros(), Vector3::zeros());
        for (c, px) in observations {
            let (at, j) = cameras[*c].project_with_jacobian(&point)?;
            let off = nalgebra::Vector2::new(at.x - px[0], at.y - px[1]);
            h += j.transpose() * j;
            g += j.transpose() * off;
        }
        point -= h.try_inverse()? * g;
    }
    let mut sum = 0.0;
    for (c, px) in observations {
        let at = cameras[*c].project(&point)?;
        sum += (at.x - px[0]).powi(2) + (at.y - px[1]).powi(2);
    }
    Some((point, (sum / observations.len() as f64).sqrt()))
}

/// Median of the tracks' residuals. \[px\]
pub(crate) fn median_residual(seen: &[Seen]) -> f64 {
    shape::upper_median(seen.iter().map(|s| s.rms_px)).unwrap_or(f64::MAX)
}
