//! How many masks have each point of a grid outside: whole bricks of points at once where a mask is even.

use nalgebra::Point3;
use rayon::prelude::*;
use shape::{Camera, Mask};

/// Points along each side of a brick (structural: any number gives the same counts).
const BRICK_POINTS: usize = 4;
/// A brick that shows as more is taken point by point (structural: any number gives the same counts). \[px\]
const WIDE_PX: f64 = 64.0;
/// How far beyond its corners a brick may show by the lens's distortion, beside [`BENT_SHARE`] (derived: a radial
/// distortion k bends a line of s pixels by 6 k s²/(8 f), which for k = 0.5, f = 500 and the widest brick is 3 pixels of
/// the 9 that these come to). \[px\]
const BENT_PX: f64 = 1.0;
/// As a share of its width (derived: as [`BENT_PX`]).
const BENT_SHARE: f64 = 0.125;

/// A mask with its camera, ready to be asked for whole rectangles.
pub(crate) struct Outline<'a> {
    mask: &'a Mask,
    camera: &'a Camera,
    /// Of the pixels above and to the left of each how many are body, a row and a column more than the mask has.
    sums: Vec<u32>,
}

/// What a mask has of all points of a brick.
#[derive(Clone, Copy, PartialEq)]
enum All {
    Body,
    Background,
    BeyondPhoto,
    Unlike,
}

impl<'a> Outline<'a> {
    /// The sums of a mask.
    pub(crate) fn of(mask: &'a Mask, camera: &'a Camera) -> Self {
        let wide = mask.width + 1;
        let mut sums = vec![0; wide * (mask.height + 1)];
        for y in 0..mask.height {
            let mut row = 0;
            for x in 0..mask.width {
                row += u32::from(mask.at(x, y) > 127);
                sums[(y + 1) * wide + x + 1] = sums[y * wide + x + 1] + row;
            }
        }
        Outline { mask, camera, sums }
    }

    /// Whether the mask has a point as body; `None` beyond the photo.
    fn shows(&self, x: &Point3<f64>) -> Option<bool> {
        let px = self.camera.project(x).filter(|px| self.camera.holds(*px))?;
        Some(self.mask.shows(px))
    }

    /// What the mask has of all points between eight corners.
    fn of_all(&self, corners: &[Point3<f64>; 8]) -> All {
        let (mut lo, mut hi) = ([f64::MAX; 2], [f64::MIN; 2]);
        for corner in corners {
            let Some(px) = self.camera.project(corner) else {
                return All::Unlike;
            };
            for a in 0..2 {
                (lo[a], hi[a]) = (lo[a].min(px[a]), hi[a].max(px[a]));
            }
        }
        let wide = (hi[0] - lo[0]).max(hi[1] - lo[1]);
        if wide.is_nan() || wide > WIDE_PX {
            return All::Unlike;
        }
        let more = BENT_PX + BENT_SHARE * wide;
        let size = [self.mask.width, self.mask.height].map(|n| n as f64);
        if (0..2).any(|a| hi[a] + more < -0.5 || lo[a] - more >= size[a] - 0.5) {
            return All::BeyondPhoto;
        }
        let (lo, hi) = (
            lo.map(|v| (v - more).floor()),
            hi.map(|v| (v + more).ceil()),
        );
        if (0..2).any(|a| lo[a] < 0.0 || hi[a] > size[a] - 1.0) {
            return All::Unlike;
        }
        let ([left, top], [right, bottom]) = (lo.map(|v| v as usize), hi.map(|v| v as usize + 1));
        let at = |x: usize, y: usize| self.sums[y * (self.mask.width + 1) + x] as usize;
        let body = at(right, bottom) + at(left, top) - at(left, bottom) - at(right, top);
        match body {
            0 => All::Background,
            _ if body == (right - left) * (bottom - top) => All::Body,
            _ => All::Unlike,
        }
    }
}

/// How many masks have each point of a grid outside, x fastest, `most` + 1 at most; so many, too, where fewer than half of the
/// photos hold it. A point's place along each axis may only grow or only fall with its number.
pub(crate) fn against(
    outlines: &[Outline<'_>],
    most: u8,
    count: [usize; 3],
    point: &(dyn Fn([usize; 3]) -> Point3<f64> + Sync),
) -> Vec<u8> {
    let [nx, ny, nz] = count;
    let mut out = vec![0; nx * ny * nz];
    let layers = out.par_chunks_mut((nx * ny * BRICK_POINTS).max(1));
    layers.enumerate().for_each(|(k, layers)| {
        let z = [k * BRICK_POINTS, nz.min((k + 1) * BRICK_POINTS)];
        for y in (0..ny).step_by(BRICK_POINTS) {
            for x in (0..nx).step_by(BRICK_POINTS) {
                let ends = [
                    [x, nx.min(x + BRICK_POINTS)],
                    [y, ny.min(y + BRICK_POINTS)],
                    z,
                ];
                let mut note = |[x, y, z]: [usize; 3], against| {
                    layers[((z - ends[2][0]) * ny + y) * nx + x] = against;
                };
                brick(outlines, most, ends, point, &mut note);
            }
        }
    });
    out
}

/// The counts of one brick of points.
fn brick(
    outlines: &[Outline<'_>],
    most: u8,
    ends: [[usize; 2]; 3],
    point: &dyn Fn([usize; 3]) -> Point3<f64>,
    note: &mut dyn FnMut([usize; 3], u8),
) {
    let corners: [Point3<f64>; 8] = std::array::from_fn(|corner| {
        point([0, 1, 2].map(|a| match corner >> a & 1 {
            0 => ends[a][0],
            _ => ends[a][1] - 1,
        }))
    });
    let (mut met, mut outside, mut unlike) = (0, 0, Vec::new());
    for outline in outlines {
        match outline.of_all(&corners) {
            All::Body => met += 1,
            All::Background => (met, outside) = (met + 1, outside + 1),
            All::BeyondPhoto => (),
            All::Unlike => unlike.push(outline),
        }
    }
    let cells = (ends[2][0]..ends[2][1])
        .flat_map(|z| (ends[1][0]..ends[1][1]).map(move |y| [y, z]))
        .flat_map(|[y, z]| (ends[0][0]..ends[0][1]).map(move |x| [x, y, z]));
    for cell in cells {
        let (mut met, mut outside) = (met, outside);
        let x = point(cell);
        for outline in &unlike {
            if outside > usize::from(most) {
                break;
            }
            if let Some(body) = outline.shows(&x) {
                met += 1;
                outside += usize::from(!body);
            }
        }
        let few = outside <= usize::from(most) && met * 2 >= outlines.len();
        note(cell, if few { outside as u8 } else { most + 1 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::raster;
    use nalgebra::{Matrix3, Rotation3, Vector3};
    use proof::Dice;
    use shape::{Intrinsics, Pose};

    const SIZE: [usize; 2] = [90, 120];

    /// A camera 900 mm from the axis, with a lens that bends lines, partly beside the body.
    fn camera(angle: f64, dice: &mut Dice) -> Camera {
        let (s, c) = libm::sincos(angle);
        let rows = Matrix3::new(c, s, 0.0, 0.0, 0.0, -1.0, -s, c, 0.0);
        let mut lens = Intrinsics::simple(SIZE[0] as u32, SIZE[1] as u32, 150.0);
        lens.radial = [dice.within(-0.5, 0.2), dice.within(0.0, 0.2)];
        Camera {
            lens,
            pose: Pose {
                rotation: Rotation3::from_matrix_unchecked(rows),
                translation: Vector3::new(dice.within(-250.0, 250.0), 300.0, 900.0),
            },
        }
    }

    /// A round body with a hole, and single pixels that are wrong.
    fn mask(dice: &mut Dice) -> Mask {
        let (middle, hole) = ([44.0 + dice.within(-6.0, 6.0), 60.0], [40.0, 50.0]);
        let mut pixel = |i: usize| {
            let at = [(i % SIZE[0]) as f64, (i / SIZE[0]) as f64];
            let within = |c: [f64; 2], r| libm::hypot(at[0] - c[0], at[1] - c[1]) < r;
            let body = within(middle, 30.0) && !within(hole, 7.0);
            if body == (dice.unit() < 0.998) {
                255
            } else {
                0
            }
        };
        let pixels = (0..SIZE[0] * SIZE[1]).map(&mut pixel).collect();
        raster(SIZE[0], SIZE[1], pixels)
    }

    /// Point by point, photo by photo.
    fn plainly(views: &[(Mask, Camera)], most: u8, x: &Point3<f64>) -> u8 {
        let shown = |(mask, camera): &(Mask, Camera)| {
            let px = camera.project(x).filter(|px| camera.holds(*px))?;
            Some(mask.shows(px))
        };
        let shown: Vec<bool> = views.iter().filter_map(shown).collect();
        let outside = shown.iter().filter(|body| !**body).count();
        match shown.len() * 2 >= views.len() {
            true => outside.min(usize::from(most) + 1) as u8,
            false => most + 1,
        }
    }

    #[test]
    fn bricks_count_as_points_one_by_one_do_through_lenses_that_bend_lines() {
        let mut dice = Dice(7);
        for (round, count) in [[41, 38, 45], [3, 9, 4], [1, 1, 1], [20, 0, 5]]
            .into_iter()
            .enumerate()
        {
            let views: Vec<(Mask, Camera)> = (0..9)
                .map(|k| (mask(&mut dice), camera(f64::from(k) * 0.7, &mut dice)))
                .collect();
            let outlines: Vec<Outline<'_>> = views.iter().map(|(m, c)| Outline::of(m, c)).collect();
            // The first is so large that it reaches behind cameras.
            let cell = [60.0, 12.0, 9.0, 9.0][round];
            let point = |at: [usize; 3]| {
                Point3::from([0, 1, 2].map(|a| (at[a] as f64 - count[a] as f64 / 2.0) * cell))
            };
            let got = against(&outlines, 2, count, &point);
            let [nx, ny, _] = count;
            let at = |i: usize| [i % nx, i / nx % ny, i / nx / ny];
            let want: Vec<u8> = (0..count.iter().product())
                .map(|i| plainly(&views, 2, &point(at(i))))
                .collect();
            assert!(got == want, "round {round}");
            assert!(
                round > 0 || (0..4).all(|n| want.contains(&n)),
                "all counts occur"
            );
        }
    }
}
