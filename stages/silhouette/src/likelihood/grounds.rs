//! What the background is at each pixel of a photo: wall, floor, or disk.

use crate::likelihood::floor::Floor;
use crate::scene::disk_plane::on_disk;
use nalgebra::{Point2, Point3};

/// What the background is at a pixel, which decides how light may change there (`DARKEST_LIGHTS` by this order).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ground {
    /// Walls: the subject dims or brightens them a little.
    Wall,
    /// The floor around the disk: a shadow may fall on it.
    Floor,
    /// The disk's top: feet touch it, and under them it is nearly dark.
    Disk,
}

/// The least light of a wall, the floor and the disk in the subject's shadow, as a share of their own. By hand: looked
/// at scenes 131 with a plate and 132 without, at 0.7 and 1.4 of it on floor and disk: equal masks; on walls at 0.62 and
/// 0.94: mean IoU at most −0.0002 and +0.0000.
pub(crate) const DARKEST_LIGHTS: [f32; 3] = [0.88, 0.45, 0.2];

/// Side of the blocks of a photo, in most of which the ground is the same (structural: it decides time alone). \[px\]
const SIDE: usize = 8;
/// Points of the disk's outline: fewer pixels apart than a block is wide (structural).
const OUTLINE: usize = 720;

/// The ground of each pixel of a photo.
pub(crate) struct Grounds<'a> {
    /// The floor before the camera at the reduced size.
    floor: Option<&'a Floor>,
    factor: usize,
    /// Blocks along a row, and one more corner.
    wide: usize,
    /// The ground at each block's left upper corner.
    corners: Vec<Ground>,
    /// Whether it is the same all over the block.
    plain: Vec<bool>,
}

impl<'a> Grounds<'a> {
    /// Of a photo of a size, `factor` times as large as the floor's camera sees it.
    pub(crate) fn of(floor: Option<&'a Floor>, factor: usize, width: usize, height: usize) -> Self {
        let (wide, tall) = (width / SIDE + 2, height / SIDE + 2);
        let mut grounds = Grounds {
            floor,
            factor,
            wide,
            corners: Vec::new(),
            plain: Vec::new(),
        };
        let places = || (0..tall).flat_map(|y| (0..wide).map(move |x| (x, y)));
        grounds.corners = places()
            .map(|(x, y)| grounds.seen(SIDE * x, SIDE * y))
            .collect();
        // An outline that passes between the corners around a block is a thin disk's.
        let plain = |(x, y): (usize, usize)| {
            let here = grounds.corners[y * wide + x];
            let rows = y.max(1) - 1..(y + 3).min(tall);
            let mut all = rows.flat_map(|y| {
                let row = &grounds.corners[y * wide..];
                &row[x.max(1) - 1..(x + 3).min(wide)]
            });
            all.all(|corner| *corner == here)
        };
        grounds.plain = places().map(plain).collect();
        for (x, y) in grounds.outline() {
            if x < wide && y < tall {
                grounds.plain[y * wide + x] = false;
            }
        }
        grounds
    }

    /// The ground at a pixel.
    pub(crate) fn at(&self, x: usize, y: usize) -> Ground {
        let block = y / SIDE * self.wide + x / SIDE;
        match self.plain[block] {
            true => self.corners[block],
            false => self.seen(x, y),
        }
    }

    /// The ground nearby.
    pub(crate) fn about(&self, x: usize, y: usize) -> Ground {
        self.corners[y / SIDE * self.wide + x / SIDE]
    }

    /// What a pixel's ray meets. Where no floor is known a shadow may fall anywhere.
    fn seen(&self, x: usize, y: usize) -> Ground {
        let Some(floor) = self.floor else {
            return Ground::Floor;
        };
        let small = |v: usize| (v as f64 + 0.5) / self.factor as f64 - 0.5;
        let at = Point2::new(small(x), small(y));
        match on_disk(&floor.camera, at, floor.shadow) {
            None => Ground::Wall,
            Some(hit) if libm::hypot(hit.x, hit.y) < floor.touched => Ground::Disk,
            Some(_) => Ground::Floor,
        }
    }

    /// The blocks through which the disk's outline passes, and those beside them.
    fn outline(&self) -> Vec<(usize, usize)> {
        let Some(Floor {
            camera,
            touched: radius,
            ..
        }) = self.floor
        else {
            return Vec::new();
        };
        let point = |i: usize| {
            let (s, c) = libm::sincos(i as f64 * std::f64::consts::TAU / OUTLINE as f64);
            let px = camera.project(&Point3::new(radius * c, radius * s, 0.0))?;
            let block = |v: f64| ((v + 0.5) * self.factor as f64 / SIDE as f64).floor();
            let (x, y) = (block(px.x), block(px.y));
            (x >= -1.0 && y >= -1.0).then_some((x as i64, y as i64))
        };
        let around = |(x, y): (i64, i64)| {
            (-1..=1).flat_map(move |dy| (-1..=1).map(move |dx| (x + dx, y + dy)))
        };
        let all = (0..OUTLINE).filter_map(point).flat_map(around);
        all.filter(|(x, y)| *x >= 0 && *y >= 0)
            .map(|(x, y)| (x as usize, y as usize))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Camera, Intrinsics, Pose};

    #[test]
    fn blocks_are_what_their_pixels_are() {
        // From the height of a chest, and so low that the disk is a few pixels thin.
        for (height, down) in [(1100.0, 0.35), (12.0, 0.004)] {
            let mut lens = Intrinsics::simple(160, 240, 300.0);
            lens.radial = [-0.1, 0.02];
            let rotation =
                Rotation3::from_euler_angles(std::f64::consts::FRAC_PI_2 + down, 0.0, 0.0);
            let centre = Vector3::new(0.0, -3000.0, height);
            let pose = Pose {
                rotation,
                translation: -(rotation * centre),
            };
            let disk = Floor::of_disk(Camera { lens, pose }, 450.0);
            let grounds = Grounds::of(Some(&disk), 3, 480, 720);
            let mut met = [0; 3];
            for (x, y) in (0..720).flat_map(|y| (0..480).map(move |x| (x, y))) {
                assert_eq!(grounds.at(x, y), grounds.seen(x, y), "{x} {y}");
                met[grounds.at(x, y) as usize] += 1;
            }
            assert!(met.iter().all(|count| *count > 0), "{met:?}");
        }
    }
}
