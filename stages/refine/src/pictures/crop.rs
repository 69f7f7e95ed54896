//! Which part of a photo is made ready: the body's, and what is close around it.

use nalgebra::{Point2, Vector2};
use shape::{Image, Intrinsics, Mask};

/// What is kept around the silhouette, as a share of the photo's longer side (structural: a cap on memory): some 7 cm
/// where a standing person fills the photo, more than a body sways.
const AROUND_SHARE: f64 = 0.04;

/// What is kept at least: four times what a contour is looked at beyond itself (structural: a cap on memory). \[px\]
const LEAST_AROUND_PX: f64 = 32.0;

/// A part of an image. \[px\]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Crop {
    /// Its first column and row.
    pub corner: [usize; 2],
    /// Its width and height.
    pub size: [usize; 2],
}

impl Crop {
    /// All of an image.
    pub(crate) fn whole(size: [usize; 2]) -> Crop {
        Crop {
            corner: [0; 2],
            size,
        }
    }

    /// The silhouette and what is around it as a lens `to` without distortion shows it, `from` being the photo's; all of
    /// it where the silhouette is empty. The answer is in pixels of `to`.
    pub(crate) fn around(mask: &Mask, from: &Intrinsics, to: &Intrinsics) -> Crop {
        let size = [to.width as usize, to.height as usize];
        let Some(body) = bounds(mask) else {
            return Crop::whole(size);
        };
        let seen = |p: [f64; 2]| {
            let ray = from.undistort(Point2::new(p[0], p[1]));
            [0, 1].map(|i| to.centre[i] + to.focal[i] * ray[i])
        };
        let margin = (AROUND_SHARE * size[0].max(size[1]) as f64).max(LEAST_AROUND_PX);
        body.carried(seen).grown(margin, size)
    }

    /// The part of a photo with the lens `to` that shows this part of a picture with the lens `from`, which has no
    /// distortion; corner and size are whole multiples of `step`, so that it can be halved. \[px of the photo\]
    pub(crate) fn in_photo(&self, from: &Intrinsics, to: &Intrinsics, step: usize) -> Crop {
        let seen = |p: [f64; 2]| {
            let ray = [0, 1].map(|i| (p[i] - from.centre[i]) / from.focal[i]);
            let at = to.distort(Vector2::from(ray));
            [at.x, at.y]
        };
        let size = [to.width as usize, to.height as usize];
        // A pixel of the picture is read between those of the photo that surround it.
        let read = self.carried(seen).grown(2.0 * step as f64, size);
        let corner = read.corner.map(|c| c / step * step);
        let end = |i: usize| {
            let end = (read.corner[i] + read.size[i]).next_multiple_of(step);
            end.min(size[i] / step * step).max(corner[i] + 1)
        };
        Crop {
            corner,
            size: [0, 1].map(|i| end(i) - corner[i]),
        }
    }

    /// This part of an image.
    pub(crate) fn of<T: Copy>(&self, image: &Image<T>) -> Image<T> {
        image.part([0, 1].map(|i| self.corner[i]..self.corner[i] + self.size[i]))
    }

    /// A lens that shows this part of what `lens` shows.
    pub(crate) fn lens(&self, lens: &Intrinsics) -> Intrinsics {
        Intrinsics {
            width: self.size[0] as u32,
            height: self.size[1] as u32,
            centre: [0, 1].map(|i| lens.centre[i] - self.corner[i] as f64),
            ..*lens
        }
    }

    /// How many pixels it has.
    pub(crate) fn area(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The extent of where a part's border is seen by another lens: least and greatest column and row.
    fn carried(&self, seen: impl Fn([f64; 2]) -> [f64; 2]) -> Extent {
        // Points of a side (structural: samples).
        const POINTS: usize = 16;
        let mut extent = Extent {
            least: [f64::INFINITY; 2],
            most: [f64::NEG_INFINITY; 2],
        };
        let side = |i: usize, k: usize| {
            let last = self.size[i] as f64 - 1.0;
            self.corner[i] as f64 + last * k as f64 / POINTS as f64
        };
        for k in 0..=POINTS {
            let ([x, y], [left, right]) = ([side(0, k), side(1, k)], [0, POINTS]);
            let points = [
                [x, side(1, left)],
                [x, side(1, right)],
                [side(0, left), y],
                [side(0, right), y],
            ];
            for at in points.map(&seen) {
                for i in 0..2 {
                    extent.least[i] = extent.least[i].min(at[i]);
                    extent.most[i] = extent.most[i].max(at[i]);
                }
            }
        }
        extent
    }
}

/// Least and greatest column and row. \[px\]
struct Extent {
    least: [f64; 2],
    most: [f64; 2],
}

impl Extent {
    /// The part of an image of this size that is within, a margin around it; of one that it misses, all.
    fn grown(&self, margin: f64, size: [usize; 2]) -> Crop {
        let first = |i: usize| (self.least[i] - margin).floor().max(0.0) as usize;
        let end = |i: usize| ((self.most[i] + margin).ceil().max(0.0) as usize + 1).min(size[i]);
        if (0..2).any(|i| first(i) >= end(i)) {
            return Crop::whole(size);
        }
        Crop {
            corner: [first(0), first(1)],
            size: [0, 1].map(|i| end(i) - first(i)),
        }
    }
}

/// The smallest part of a silhouette's image that has the silhouette; [`None`] where it is empty.
fn bounds(mask: &Mask) -> Option<Crop> {
    let extent = mask.extent()?;
    Some(Crop {
        corner: [extent[0].start, extent[1].start],
        size: extent.map(|e| e.len()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(width: usize, height: usize, at: &[[usize; 2]]) -> Mask {
        let mut mask = Mask::filled(width, height, 0);
        for [x, y] in at {
            *mask.at_mut(*x, *y) = 255;
        }
        mask
    }

    #[test]
    fn bounds_are_the_silhouettes_own() {
        let mask = spot(60, 40, &[[20, 10], [31, 7], [5, 22]]);
        let bounds = bounds(&mask).unwrap();
        assert_eq!((bounds.corner, bounds.size), ([5, 7], [27, 16]));
        assert_eq!(super::bounds(&spot(6, 4, &[])), None);
    }

    #[test]
    fn a_crop_holds_the_silhouette_through_a_lens_and_its_photo_holds_the_crop() {
        let mut lens = Intrinsics::simple(600, 900, 700.0);
        lens.radial = [-0.25, 0.05];
        let pinhole = Intrinsics {
            radial: [0.0; 2],
            ..lens.resized(300, 450)
        };
        let mask = spot(600, 900, &[[480, 150], [520, 740]]);
        let crop = Crop::around(&mask, &lens, &pinhole);
        let photo = crop.in_photo(&pinhole, &lens, 2);
        assert!(crop.area() < 300 * 450 / 2, "{crop:?}");
        let within = |c: &Crop, p: [f64; 2], spare: f64| {
            (0..2).all(|i| {
                let from = p[i] - c.corner[i] as f64;
                from >= spare && from <= c.size[i] as f64 - 1.0 - spare
            })
        };
        for at in [[480.0, 150.0], [520.0, 740.0]] {
            let ray = lens.undistort(Point2::new(at[0], at[1]));
            let shown = pinhole.distort(ray);
            assert!(within(&crop, [shown.x, shown.y], 8.0), "{crop:?} {shown:?}");
            assert!(within(&photo, at, 0.0));
        }
        assert!(photo.corner.iter().chain(&photo.size).all(|n| n % 2 == 0));
        let part = crop.lens(&pinhole);
        let ray = Vector2::new(0.1, -0.2);
        let (a, b) = (pinhole.distort(ray), part.distort(ray));
        assert_eq!(a.x - b.x, crop.corner[0] as f64);
        assert_eq!(a.y - b.y, crop.corner[1] as f64);
    }
}
