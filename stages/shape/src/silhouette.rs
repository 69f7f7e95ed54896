//! A silhouette as a distance field, and where one of many alone shows no body.

use crate::{Camera, Gray, Image, Mask, signed_distance};
use nalgebra::Point3;

/// Of fewer photos one alone may see a wide gap, or carve a wide wedge, so nothing is reported. By hand: looked at good
/// masks of 18 photos, which thinned to every second come to 0.56 % of a mask.
pub const MIN_DISSENT_PHOTOS: usize = 12;
/// Where a photo alone shows the background, it must do so this part of the margin beyond the body's border. By hand:
/// looked at gaps narrower than twice that (15 mm of an adult), which are seen by one photo alone even between two
/// round thighs, wider ones by its neighbours, 20° aside, too.
const CORE_PART: f32 = 3.0;
/// How deep in all other photos a place must be, as a share of the body's height, for one photo to contradict them:
/// every view carves a thin wedge that no other does. By hand: looked at good masks (those of man, woman, mannequin,
/// blue background).
pub const DISSENT_DEPTH: f64 = 0.012;

/// A silhouette as a distance field, and its camera at the field's size.
pub struct Silhouette {
    /// The camera.
    pub camera: Camera,
    /// Signed distance to the border, positive inside. \[px\]
    pub distance: Gray,
}

impl Silhouette {
    /// Of a mask and its camera; of masks of more than 3000 pixels, at half their size: 24 megapixels show no more of a border.
    pub fn of(mask: &Mask, camera: &Camera) -> Silhouette {
        let small = halved(mask);
        Silhouette {
            camera: camera.resized(small.width as u32, small.height as u32),
            distance: signed_distance(&small),
        }
    }

    /// How deep inside of the silhouette's cone a point is. \[mm\] `None` where it is out of view.
    #[inline]
    pub fn depth_inside(&self, x: &Point3<f64>) -> Option<f32> {
        let (px, depth) = self.camera.project_with_depth(x)?;
        let (w, h) = (self.distance.width as f64, self.distance.height as f64);
        if px.x < 0.0 || px.y < 0.0 || px.x > w - 1.0 || px.y > h - 1.0 {
            return None;
        }
        let far = self.distance.sample(px.x as f32, px.y as f32);
        Some(far * (depth / self.camera.lens.focal[0]) as f32)
    }
}

/// At half the size, where a mask is large.
fn halved(mask: &Mask) -> Mask {
    if mask.width.max(mask.height) <= 3000 {
        return mask.clone();
    }
    let (width, height) = (mask.width / 2, mask.height / 2);
    let mean = |i: usize| {
        let (x, y) = (i % width * 2, i / width * 2);
        let four =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| u32::from(mask.at(x + dx, y + dy)));
        (four.iter().sum::<u32>() / 4) as u8
    };
    Image {
        width,
        height,
        data: (0..width * height).map(mean).collect(),
    }
}

/// The one view that shows a point as background, where all that see it, at least half of the views, but this one show it as body.
pub fn sole_dissent(views: &[Silhouette], x: &Point3<f64>) -> Option<usize> {
    dissent(views, x, 0.0, 0.0)
}

/// The same where all but this one show it deeper than a margin, and this one so far beyond its body's border as no gap
/// is that one photo alone sees. \[mm\]
pub fn deep_dissent(views: &[Silhouette], x: &Point3<f64>, margin: f32) -> Option<usize> {
    dissent(views, x, margin, margin / CORE_PART)
}

/// The one view in which a point is farther out than `out`, where it is deeper than `deep` in all other views. \[mm\]
fn dissent(views: &[Silhouette], x: &Point3<f64>, deep: f32, out: f32) -> Option<usize> {
    let (mut sole, mut seen) = (None, 0);
    for (v, view) in views.iter().enumerate() {
        let Some(depth) = view.depth_inside(x) else {
            continue;
        };
        seen += 1;
        if depth < deep && (depth >= -out || sole.replace(v).is_some()) {
            return None;
        }
    }
    sole.filter(|_| seen * 2 >= views.len())
}
