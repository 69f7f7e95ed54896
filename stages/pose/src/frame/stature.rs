//! Where a subject's crown and soles are, from silhouettes and cameras that turn about the z axis.

use nalgebra::{Point2, Point3, Vector3};
use shape::{Camera, Mask};

/// Crown and soles, in the cameras' unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stature {
    /// Height of the crown.
    pub crown: f64,
    /// Height of the ground under the soles.
    pub ground: f64,
    /// Standard deviation of the crown over the photos, of one photo.
    pub crown_spread: f64,
    /// The same of the ground.
    pub ground_spread: f64,
}

/// Share of the silhouette's rows from below that hold the feet only. By hand: looked at nine captures, halved and
/// doubled: no more than chance (docs/lab/numbers.md).
const FEET_SHARE: f64 = 0.05;

/// Radius of the head about its crown, as a share of stature: a ray that touches a ball from below crosses its middle
/// above its top, at r / cos(elevation). Half of a head's length is 0.057 of it, half of its breadth 0.044 (ANSUR II).
const HEAD_RADIUS: f64 = 0.055;

/// What one silhouette shows.
struct Extent {
    crown: f64,
    /// 1 / cos(elevation) of the ray past it, less one.
    over: f64,
    /// Distance of the foremost sole from the axis where the ground is at 0, and by how much it
    /// grows with the ground's height.
    front: [f64; 2],
    half_width: f64,
}

/// Crown and soles from silhouettes all around. The highest ray past the head crosses the axis at
/// the crown on average over the turn; the lowest ray touches the foremost sole, and over the turn
/// the mean distance of that from the axis is half the feet's mean width (Cauchy), which the
/// silhouettes show sideways. `None` for fewer than three silhouettes, and for a camera that does
/// not look down on the feet.
pub fn stature(views: impl Iterator<Item = (Camera, Mask)>) -> Option<Stature> {
    let all: Vec<Extent> = views.filter_map(|(c, m)| extent(&c, &m)).collect();
    if all.len() < 3 {
        return None;
    }
    let count = all.len() as f64;
    let mean = |f: &dyn Fn(&Extent) -> f64| all.iter().map(f).sum::<f64>() / count;
    let crown = mean(&|e| e.crown);
    let (front, slope) = (mean(&|e| e.front[0]), mean(&|e| e.front[1]));
    let half_width = mean(&|e| e.half_width);
    let spread = mean(&|e| (e.crown - crown).powi(2)).sqrt();
    let ground = (half_width - front) / slope;
    let alone = |e: &Extent| (e.half_width - e.front[0]) / e.front[1];
    (slope.abs() > 0.5).then(|| Stature {
        crown: crown - HEAD_RADIUS * (crown - ground) * mean(&|e| e.over),
        ground,
        crown_spread: spread,
        ground_spread: mean(&|e| (alone(e) - ground).powi(2)).sqrt(),
    })
}

fn extent(camera: &Camera, mask: &Mask) -> Option<Extent> {
    let camera = camera.resized(mask.width as u32, mask.height as u32);
    let row = |y: usize| {
        let row = &mask.data[y * mask.width..(y + 1) * mask.width];
        let first = row.iter().position(|c| *c > 127)?;
        let last = row.iter().rposition(|c| *c > 127)?;
        let count = row.iter().filter(|c| **c > 127).count();
        (count >= 3).then_some((first as f64, last as f64))
    };
    let rows: Vec<usize> = (0..mask.height).filter(|y| row(*y).is_some()).collect();
    let (top, bottom) = (*rows.first()?, *rows.last()?);
    // Cut off by the photo's border, nothing is known.
    if top == 0 || bottom + 1 == mask.height {
        return None;
    }
    let centre = camera.centre();
    let out = Vector3::new(centre.x, centre.y, 0.0).try_normalize(1e-9)?;
    let side = Vector3::z().cross(&out);
    let ray = |x: f64, y: f64| camera.ray(Point2::new(x, y)).into_inner();
    // The point of a ray on the plane through the axis that faces the camera.
    let facing =
        |r: Vector3<f64>| -> Point3<f64> { centre - r * (centre.coords.dot(&out) / r.dot(&out)) };
    let (a, b) = row(top)?;
    let past = ray((a + b) / 2.0, top as f64 - 0.5);
    let crown = facing(past).z;
    let over = 1.0 / (1.0 - past.z * past.z).max(0.1).sqrt() - 1.0;
    let (a, b) = row(bottom)?;
    let low = ray((a + b) / 2.0, bottom as f64 + 0.5);
    // P(z) = C + r (z - C.z) / r.z
    let slope = low.dot(&out) / low.z;
    let front = centre.coords.dot(&out) - centre.z * slope;
    let feet = bottom - ((bottom - top) as f64 * FEET_SHARE) as usize;
    let (mut left, mut right) = (f64::MAX, f64::MIN);
    for y in feet..=bottom {
        if let Some((a, b)) = row(y) {
            for x in [a - 0.5, b + 0.5] {
                let s = facing(ray(x, y as f64)).coords.dot(&side);
                (left, right) = (left.min(s), right.max(s));
            }
        }
    }
    Some(Extent {
        crown,
        over,
        front: [front, slope],
        half_width: (right - left) / 2.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adjust::ring::Ring;
    use nalgebra::Rotation3;
    use shape::Intrinsics;

    /// A cylinder beside the axis, as it is seen.
    fn seen(camera: &Camera, radius: f64, ground: f64, crown: f64) -> Mask {
        let mut mask = Mask::filled(400, 600, 0);
        for k in 0..720 {
            let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 720.0);
            for h in 0..=600 {
                let z = ground + (crown - ground) * f64::from(h) / 600.0;
                for r in [radius, radius * 0.8, radius * 0.5, radius * 0.2] {
                    let at = Point3::new(30.0 + r * cos, r * sin - 20.0, z);
                    let px = camera.project(&at).unwrap();
                    *mask.at_mut(px.x.round() as usize, px.y.round() as usize) = 255;
                }
            }
        }
        mask
    }

    #[test]
    fn a_cylinder_is_as_tall_as_it_is() {
        let ring = Ring {
            turn: Rotation3::from_euler_angles(1.7, 0.0, 0.0),
            offset: Vector3::new(0.0, 0.0, 2500.0),
            angles: (0..12)
                .map(|k| f64::from(k) * std::f64::consts::FRAC_PI_6)
                .collect(),
        };
        let lens = Intrinsics::simple(400, 600, 670.0);
        let cameras: Vec<Camera> = ring
            .poses()
            .into_iter()
            .map(|pose| Camera { lens, pose })
            .collect();
        let view = |c: Camera| (c, seen(&c, 110.0, -900.0, 700.0));
        let found = stature(cameras.into_iter().map(view)).unwrap();
        proof::near(found.ground, -900.0, 12.0);
        proof::near(found.crown, 700.0, 25.0);
    }
}
