//! The plane of the disk's top: where a pixel's ray meets it; and colours between pixels.

use nalgebra::{Point2, Point3};
use shape::{Camera, Rgb};
use std::ops::Range;

/// Sides of a polygon around a disk's outline (structural: it decides time alone).
const SIDES: u32 = 90;

/// A disk's top before a camera, asked pixel by pixel: most of a photo is far from it, and rays are dear.
pub(crate) struct DiskTop<'a> {
    camera: &'a Camera,
    radius: f64,
    /// Columns that may see it.
    columns: Range<usize>,
    /// Rows that may.
    rows: Range<usize>,
}

impl<'a> DiskTop<'a> {
    /// Before a photo of a size; all of that may see it where the outline is not all before the camera. \[mm, px\]
    pub(crate) fn of(camera: &'a Camera, radius: f64, [width, height]: [usize; 2]) -> Self {
        let step = std::f64::consts::TAU / f64::from(SIDES);
        let corner = radius / libm::cos(step / 2.0);
        let outline = (0..SIDES).map(|i| {
            let (s, c) = libm::sincos(f64::from(i) * step);
            camera.project(&Point3::new(corner * c, corner * s, 0.0))
        });
        let outline: Vec<Option<Point2<f64>>> = outline.collect();
        let along = |k: usize, size: usize| {
            let each = || outline.iter().map(|px| px.map_or(f64::NAN, |px| px[k]));
            if each().any(f64::is_nan) {
                return 0..size;
            }
            let (lo, hi) = each().fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
            let clamp = |v: f64| v.clamp(0.0, size as f64) as usize;
            clamp(lo - 1.0)..clamp(hi + 2.0)
        };
        DiskTop {
            camera,
            radius,
            columns: along(0, width),
            rows: along(1, height),
        }
    }

    /// The pixels (x, y) that see it, row by row, and where.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = (usize, usize, Point3<f64>)> {
        let row = |y| self.columns.clone().map(move |x| (x, y));
        let all = self.rows.clone().flat_map(row);
        all.filter_map(|(x, y)| Some((x, y, self.at(x, y)?)))
    }

    /// As [`on_disk`].
    pub(crate) fn at(&self, x: usize, y: usize) -> Option<Point3<f64>> {
        let near = self.columns.contains(&x) && self.rows.contains(&y);
        near.then(|| on_disk(self.camera, Point2::new(x as f64, y as f64), self.radius))?
    }
}

/// The point of the disk's top that is seen at a pixel, if it is on the disk. \[mm\]
pub(crate) fn on_disk(camera: &Camera, at_px: Point2<f64>, radius: f64) -> Option<Point3<f64>> {
    let (centre, ray) = (camera.centre(), camera.ray(at_px));
    if ray.z >= -1e-6 || centre.z <= 0.0 {
        return None;
    }
    let hit = centre - ray.into_inner() * (centre.z / ray.z);
    (libm::hypot(hit.x, hit.y) < radius).then_some(hit)
}

/// A pixel between pixels, bilinear; [`None`] outside.
pub(crate) fn sample(image: &Rgb, at: Point2<f64>) -> Option<[f32; 3]> {
    let (x0, y0) = (at.x.floor(), at.y.floor());
    let inside =
        x0 >= 0.0 && y0 >= 0.0 && x0 + 1.0 < image.width as f64 && y0 + 1.0 < image.height as f64;
    if !inside {
        return None;
    }
    let (fx, fy) = ((at.x - x0) as f32, (at.y - y0) as f32);
    let (x, y) = (x0 as usize, y0 as usize);
    let mut color = [0.0; 3];
    for (c, out) in color.iter_mut().enumerate() {
        let at = |x: usize, y: usize| f32::from(image.at(x, y)[c]);
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        *out = shape::bilinear(four, [fx, fy]);
    }
    Some(color)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Intrinsics, Pose};

    #[test]
    fn a_top_is_met_by_the_pixels_by_whose_rays_it_is_met() {
        let mut lens = Intrinsics::simple(120, 160, 160.0);
        lens.radial = [-0.1, 0.02];
        // From before the disk, from so low that it is thin, and from above it, where it is beside the camera, too.
        let mut seen = [0; 3];
        for (k, (away, height, down)) in [
            (3000.0, 1100.0, 0.3),
            (3000.0, 40.0, 0.0),
            (300.0, 40.0, 0.5),
        ]
        .into_iter()
        .enumerate()
        {
            let rotation =
                Rotation3::from_euler_angles(std::f64::consts::FRAC_PI_2 + down, 0.0, 0.0);
            let centre = Vector3::new(0.0, -away, height);
            let pose = Pose {
                rotation,
                translation: -(rotation * centre),
            };
            let camera = Camera { lens, pose };
            let top = DiskTop::of(&camera, 450.0, [120, 160]);
            for (x, y) in (0..160).flat_map(|y| (0..120).map(move |x| (x, y))) {
                let hit = on_disk(&camera, Point2::new(x as f64, y as f64), 450.0);
                assert_eq!(top.at(x, y), hit, "{x} {y}");
                seen[k] += usize::from(hit.is_some());
            }
        }
        assert!(seen.iter().all(|n| (1..120 * 160).contains(n)), "{seen:?}");
    }
}
