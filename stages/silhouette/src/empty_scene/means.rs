//! The empty scene at full size, a photo at a time, so that memory holds a few of them only.

use crate::raster::raster;
use crate::scene::backdrop::{SHY, thinned};
use crate::scene::disk_map::{laid_out, point};
use shape::{Camera, Image, Rgb, Seen};

/// Means over the photos whose masks leave a pixel free.
pub(crate) struct Means {
    width: usize,
    still: Vec<([u16; 3], u8)>,
    side: usize,
    disk: Vec<([u16; 3], u8)>,
    radius: f64,
}

impl Means {
    /// Nothing seen yet of photos of a size, and of a disk. \[px, mm\]
    pub(crate) fn new(width: usize, height: usize, radius: f64, side: usize) -> Self {
        let side = if radius > 0.0 { side } else { 1 };
        Means {
            width,
            still: vec![([0; 3], 0); width * height],
            side,
            disk: vec![([0; 3], 0); side * side],
            radius,
        }
    }

    /// Takes a photo in. `cut` is its mask at another size.
    pub(crate) fn add(&mut self, photo: &Rgb, camera: &Camera, cut: &Image<bool>) {
        let covered = thinned(&cut.map(|b| !b), SHY).map(|b| !b);
        let factor = (photo.width / covered.width).max(1);
        let hidden = |x: usize, y: usize| {
            let (x, y) = (
                (x / factor).min(covered.width - 1),
                (y / factor).min(covered.height - 1),
            );
            covered.at(x, y)
        };
        let put = |to: &mut ([u16; 3], u8), color: [u8; 3]| {
            if to.1 < u8::MAX {
                (0..3).for_each(|c| to.0[c] += u16::from(color[c]));
                to.1 += 1;
            }
        };
        let width = self.width;
        for (i, to) in self.still.iter_mut().enumerate() {
            if !hidden(i % width, i / width) {
                put(to, photo.data[i]);
            }
        }
        if self.radius <= 0.0 {
            return;
        }
        let map = laid_out(photo, camera, self.radius, self.side);
        for (i, color) in map.into_iter().enumerate() {
            let at = point(i, self.radius, self.side).and_then(|x| camera.project(&x));
            if let (Some(color), Some(at)) = (color, at)
                && !hidden(
                    at.x.round().max(0.0) as usize,
                    at.y.round().max(0.0) as usize,
                )
            {
                put(&mut self.disk[i], color);
            }
        }
    }

    /// The still background, and the disk's map where there is a disk: how many photos show each pixel.
    pub(crate) fn seen(self) -> (Seen, Option<Seen>) {
        let settled = |sums: Vec<([u16; 3], u8)>, width: usize| {
            let height = sums.len() / width;
            let mean = |(sum, n): &([u16; 3], u8)| {
                let half = u16::from(*n) / 2;
                sum.map(|s| ((s + half) / u16::from(*n).max(1)) as u8)
            };
            Seen {
                image: raster(width, height, sums.iter().map(mean).collect()),
                shown_by: raster(width, height, sums.iter().map(|s| s.1).collect()),
            }
        };
        let disk = (self.radius > 0.0).then(|| settled(self.disk, self.side));
        (settled(self.still, self.width), disk)
    }
}
