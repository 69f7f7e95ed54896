//! The cylinder around the axis that all cameras look into (paper, Fig. 2 b).

use crate::{Camera, Cameras};
use nalgebra::{Point2, Point3, Vector3};

/// An upright cylinder around the axis of the turn. \[mm\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Radius. \[mm\]
    pub radius: f64,
    /// Height of its bottom. \[mm\]
    pub bottom: f64,
    /// Height of its top. \[mm\]
    pub top: f64,
}

impl Cylinder {
    /// A point of its mantle: angle \[rad\], and share of the height from the bottom.
    pub fn point(&self, angle: f64, share: f64) -> Point3<f64> {
        let z = self.bottom + share * (self.top - self.bottom);
        Point3::new(
            self.radius * libm::cos(angle),
            self.radius * libm::sin(angle),
            z,
        )
    }

    /// Whether a point is inside or on it.
    pub fn holds(&self, x: &Point3<f64>) -> bool {
        libm::hypot(x.x, x.y) <= self.radius && (self.bottom..=self.top).contains(&x.z)
    }
}

/// A side of a field of view: the plane through the camera and one edge of the picture.
struct Side {
    /// Its normal, inward.
    normal: Vector3<f64>,
    /// `normal · centre`.
    offset: f64,
}

impl Side {
    /// The four sides, from the rays of the picture's corners.
    fn of(camera: &Camera) -> [Side; 4] {
        let (w, h) = (
            f64::from(camera.lens.width) - 1.0,
            f64::from(camera.lens.height) - 1.0,
        );
        let corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)]
            .map(|(x, y)| camera.ray(Point2::new(x, y)).into_inner());
        [0, 1, 2, 3].map(|i| {
            let normal = corners[i].cross(&corners[(i + 1) % 4]).normalize();
            let offset = normal.dot(&camera.centre().coords);
            Side { normal, offset }
        })
    }

    /// Length of the normal's level part.
    fn level(&self) -> f64 {
        libm::hypot(self.normal.x, self.normal.y)
    }

    /// Whether it bounds heights rather than widths; a camera may be on its side.
    fn bounds_height(&self) -> bool {
        self.normal.z.abs() > self.level()
    }

    /// The height at which it cuts the axis. \[mm\]
    fn on_axis(&self) -> f64 {
        self.offset / self.normal.z
    }

    /// Radius of the circle around the axis at a height that touches it. \[mm\] Negative if it cuts it.
    fn inside(&self, z: f64) -> f64 {
        (self.normal.z * z - self.offset) / self.level().max(1e-12)
    }
}

/// Least and greatest height that a camera sees on the axis, not below the ground. \[mm\]
fn heights(sides: &[Side; 4], ground: f64) -> [f64; 2] {
    let mut ends = [ground, f64::MAX];
    for side in sides.iter().filter(|s| s.bounds_height()) {
        if side.normal.z > 0.0 {
            ends[0] = ends[0].max(side.on_axis());
        } else {
            ends[1] = ends[1].min(side.on_axis());
        }
    }
    ends
}

/// Radii of circles around the axis at some heights that touch a side of a camera's field of view. \[mm\]
fn inside<'a>(sides: &'a [Side; 4], heights: &'a [f64; 2]) -> impl Iterator<Item = f64> + 'a {
    let upright = sides.iter().filter(|s| !s.bounds_height());
    upright.flat_map(|s| heights.iter().map(|z| s.inside(*z)))
}

/// The widest cylinder around the axis whose sides every camera has in view, as tall as the axis is in
/// view of all of them, and not below the ground. `None` without cameras, or where they share nothing.
pub fn bounding_cylinder(cameras: &Cameras) -> Option<Cylinder> {
    let views = cameras.views.values().map(|v| Side::of(&v.camera));
    let views: Vec<[Side; 4]> = views.collect();
    let each = views.iter().map(|v| heights(v, cameras.ground_mm));
    let [bottom, top] = each.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])])?;
    let ends = [bottom, top];
    let radius = views.iter().flat_map(|v| inside(v, &ends));
    let radius = radius.fold(f64::MAX, f64::min);
    let some = radius > 0.0 && radius < f64::MAX && top > bottom && top < f64::MAX;
    some.then_some(Cylinder {
        radius,
        bottom,
        top,
    })
}

/// A cylinder that holds whatever half of the cameras of a ring see, for arms that leave some photos.
///
/// A camera d inside of whose sides the axis runs sees a point at r from the axis on that part of the
/// turn on which `r sin(θ + φ) <= d`, φ the half angle of view: on half of it if `r = √2 d`. The top is
/// the highest that any camera sees there.
pub fn seen_by_half(cameras: &Cameras) -> Option<Cylinder> {
    let away = cameras.views.values().map(|v| v.camera.centre());
    let nearest = away.map(|c| libm::hypot(c.x, c.y)).fold(f64::MAX, f64::min);
    let bottom = cameras.ground_mm;
    let (mut widest, mut top) = (0.0f64, f64::MIN);
    let views = cameras.views.values().map(|v| Side::of(&v.camera));
    let views: Vec<[Side; 4]> = views.collect();
    for sides in &views {
        let high = heights(sides, bottom)[1];
        let ends = [bottom, high.min(bottom + 20.0 * nearest)];
        widest = inside(sides, &ends).fold(widest, f64::max);
    }
    // The cameras themselves are outside.
    let radius = (widest * std::f64::consts::SQRT_2).min(0.8 * nearest);
    for side in views.iter().flatten() {
        if side.bounds_height() && side.normal.z < 0.0 {
            // At the side of the cylinder where it is highest.
            top = top.max(side.on_axis() + radius * side.level() / -side.normal.z);
        }
    }
    let some = radius > 0.0 && radius < f64::MAX && top > bottom;
    some.then_some(Cylinder {
        radius,
        bottom,
        top,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Intrinsics, PhotoId, Pose, Scale, View};
    use nalgebra::{Matrix3, Rotation3};

    /// Cameras around the axis, 0.8 m up, looking at it from above by an angle; the first is turned
    /// aside, and all may be on their side.
    fn ring(count: u32, down: f64, aside: f64, on_side: bool) -> Cameras {
        let view = |k: u32| {
            let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::TAU / f64::from(count));
            let forward =
                Vector3::new(-c * libm::cos(down), -s * libm::cos(down), -libm::sin(down));
            let right = Vector3::new(-s, c, 0.0);
            let rows = [right, forward.cross(&right), forward].map(|r| r.transpose());
            let twist =
                Rotation3::from_axis_angle(&Vector3::z_axis(), if k == 0 { aside } else { 0.0 });
            let roll = Rotation3::from_axis_angle(
                &Vector3::z_axis(),
                if on_side {
                    std::f64::consts::FRAC_PI_2
                } else {
                    0.0
                },
            );
            let upright = Rotation3::from_matrix_unchecked(Matrix3::from_rows(&rows));
            let rotation = roll * upright * twist;
            let centre = Vector3::new(2000.0 * c, 2000.0 * s, 800.0);
            let lens = match on_side {
                true => Intrinsics::simple(1201, 801, 1000.0),
                false => Intrinsics::simple(801, 1201, 1000.0),
            };
            let pose = Pose {
                rotation,
                translation: -(rotation * centre),
            };
            let view = View::of(String::new(), Camera { lens, pose });
            (PhotoId(k), view)
        };
        Cameras::of((0..count).map(view), Scale::Given)
    }

    fn seen(cameras: &Cameras, x: &Point3<f64>) -> usize {
        let sees = |v: &&View| v.camera.project(x).is_some_and(|px| v.camera.holds(px));
        cameras.views.values().filter(sees).count()
    }

    #[test]
    fn the_cylinder_touches_the_sides_of_the_field_of_view() {
        // Half the width is seen at 400/1000, half the height at 600/1000: 1.2 m up and down.
        for on_side in [false, true] {
            let cylinder = bounding_cylinder(&ring(12, 0.0, 0.0, on_side)).unwrap();
            let radius = 2000.0 * libm::sin(libm::atan(0.4f64));
            proof::near(cylinder.radius, radius, 1e-9);
            proof::near(cylinder.top, 2000.0, 1e-9);
            assert_eq!(cylinder.bottom, 0.0);
        }
    }

    #[test]
    fn all_cameras_see_the_mantle_amid_its_height_and_one_misses_it_further_out() {
        for down in [0.0, 0.2] {
            let cameras = ring(36, down, 0.0, false);
            let cylinder = bounding_cylinder(&cameras).unwrap();
            let at = |i: u32, share: f64, wider: f64| {
                let x = cylinder.point(f64::from(i) * 0.07, share);
                Point3::new(x.x * wider, x.y * wider, x.z)
            };
            let all = |wider| (0..90).all(|i| seen(&cameras, &at(i, 0.5, wider)) == 36);
            assert!(all(0.999), "{cylinder:?}");
            let ends = |share| (0..90).any(|i| seen(&cameras, &at(i, share, 1.02)) < 36);
            assert!(ends(0.1) || ends(0.9), "{cylinder:?}");
        }
    }

    #[test]
    fn what_half_of_the_cameras_see_is_inside_of_the_wider_one() {
        let cameras = ring(36, 0.1, 0.0, false);
        let cylinder = seen_by_half(&cameras).unwrap();
        let mut dice = proof::Dice(4);
        let (mut within, mut outside) = (0, 0);
        for _ in 0..20_000 {
            let [x, y] = [0, 1].map(|_| dice.within(-1500.0, 1500.0));
            let x = Point3::new(x, y, dice.within(0.0, 2800.0));
            if seen(&cameras, &x) * 2 >= 36 {
                within += 1;
                outside += usize::from(!cylinder.holds(&x));
            }
        }
        // 36 cameras are no full ring: a point may be seen by one more than its share.
        assert!(
            within > 2000 && outside * 100 < within,
            "{outside} of {within}"
        );
    }

    #[test]
    fn cameras_that_look_away_share_no_cylinder() {
        let mut cameras = ring(6, 0.0, 1.0, false);
        assert_eq!(bounding_cylinder(&cameras), None);
        cameras.views = Default::default();
        assert_eq!(bounding_cylinder(&cameras), None);
        assert_eq!(seen_by_half(&cameras), None);
    }
}
