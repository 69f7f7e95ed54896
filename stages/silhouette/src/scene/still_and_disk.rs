//! The empty scene as it is laid out: the still background, and the disk, which turns.

use crate::scene::backdrop::{Backdrop, middle};
use crate::scene::disk_map::{laid_out, lay_into, point};
use crate::scene::disk_plane::{DiskTop, on_disk};
use nalgebra::Point2;
use rayon::prelude::*;
use shape::{Camera, Image, PhotoId, Rgb};

/// A photo, reduced, with its camera at that size.
pub struct Shot {
    /// The photo.
    pub id: PhotoId,
    /// The pixels.
    pub small: Rgb,
    /// The camera.
    pub camera: Camera,
}

impl Shot {
    /// Whether a pixel looks at the disk's top, or what is on it.
    pub(crate) fn shows_disk(&self, i: usize, radius: f64) -> bool {
        let at = Point2::new((i % self.small.width) as f64, (i / self.small.width) as f64);
        radius > 0.0 && on_disk(&self.camera, at, radius).is_some()
    }

    /// The disk's top, to ask of all pixels.
    pub(crate) fn top(&self, radius: f64) -> DiskTop<'_> {
        DiskTop::of(&self.camera, radius, [self.small.width, self.small.height])
    }
}

/// The still background, and the disk, which turns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scene {
    /// The still background as all photos show it.
    pub still: Backdrop,
    /// The map of the disk's top.
    pub disk: Backdrop,
    /// The disk's radius. \[mm\] 0 without one.
    pub radius: f64,
}

impl Scene {
    /// What one camera would see. Where nobody saw it, it is the photo itself, which is no evidence.
    pub(crate) fn behind(&self, photo: &Rgb, camera: &Camera) -> Backdrop {
        let mut behind = self.still.clone();
        if self.radius > 0.0 {
            let Backdrop { image, seen } = &mut behind;
            let (map, known) = (&self.disk.image, &self.disk.seen);
            lay_into(image, seen, camera, self.radius, map, known);
        }
        for (i, seen) in behind.seen.data.iter().enumerate() {
            if !seen {
                behind.image.data[i] = photo.data[i];
            }
        }
        behind
    }
}

/// Finds the scene from reduced photos; `covered` names the photos (first) and pixels (second) that
/// cannot show it.
pub(crate) fn scene(
    shots: &[Shot],
    still: Backdrop,
    radius: f64,
    covered: &[Image<bool>],
) -> Scene {
    let cameras: Vec<Camera> = shots.iter().map(|s| s.camera).collect();
    let side = full_side(&cameras, radius);
    if radius <= 0.0 {
        return Scene {
            still,
            disk: Backdrop::nowhere(),
            radius,
        };
    }
    let shown = |(shot, covered): (&Shot, &Image<bool>)| -> Vec<Option<[u8; 3]>> {
        let hides = |i: usize| {
            let Some(at) = point(i, radius, side).and_then(|x| shot.camera.project(&x)) else {
                return true;
            };
            let [x, y] = [at.x, at.y].map(|v| v.round().max(0.0) as usize);
            x < covered.width && y < covered.height && covered.at(x, y)
        };
        let map = laid_out(&shot.small, &shot.camera, radius, side).into_iter();
        let free = map.enumerate();
        free.map(|(i, color)| color.filter(|_| !hides(i))).collect()
    };
    let maps: Vec<_> = shots.par_iter().zip(covered).map(shown).collect();
    Scene {
        still,
        disk: middle(&maps, side),
        radius,
    }
}

/// As many points along the map of the disk as its width has pixels.
pub(crate) fn full_side(cameras: &[Camera], radius: f64) -> usize {
    let width = |c: &Camera| 2.0 * radius * c.lens.focal[0] / c.centre().coords.norm();
    let most = cameras.iter().map(width).fold(0.0, f64::max);
    (most as usize).clamp(64, 2048)
}
