//! A silhouette as a distance field, and where one of many alone shows no body.

use crate::{Camera, Gray, Image, Mask, bilinear, signed_distance};
use nalgebra::Point3;
use std::borrow::Cow;
use std::ops::Range;

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

/// What is kept around a body, as a share of the mask's longer side (structural: a cap on memory; more than
/// [`DISSENT_DEPTH`], for beyond it only the least distance is known).
const AROUND_SHARE: f32 = 0.02;

/// A silhouette as a distance field, and its camera at the field's size.
pub struct Silhouette {
    /// The camera.
    pub camera: Camera,
    /// Width and height of the mask, halved where it is large. \[px\]
    whole: [usize; 2],
    /// The columns and rows of the body: the first, and the first beyond. \[px\]
    body: [Range<usize>; 2],
    /// Where the field begins: column and row of its first pixel. \[px\]
    corner: [usize; 2],
    /// Signed distance to the border, positive inside, of the body and what is close around it. \[px\]
    distance: Gray,
}

impl Silhouette {
    /// Of a mask and its camera; of masks of more than 3000 pixels, at half their size: 24 megapixels show no more of a border.
    pub fn of(mask: &Mask, camera: &Camera) -> Silhouette {
        let mask = halved(mask);
        let whole = [mask.width, mask.height];
        let body = mask.extent().unwrap_or(whole.map(|n| 0..n));
        let around = (AROUND_SHARE * whole[0].max(whole[1]) as f32).ceil() as usize;
        let part = [0, 1]
            .map(|i| body[i].start.saturating_sub(around)..whole[i].min(body[i].end + around));
        Silhouette {
            camera: camera.resized(mask.width as u32, mask.height as u32),
            whole,
            body,
            corner: part.each_ref().map(|range| range.start),
            distance: signed_distance(&mask.part(part)),
        }
    }

    /// How deep inside of the silhouette's cone a point is. \[mm\] Farther from the body than what is kept around it, at
    /// least so far outside. `None` where it is out of view.
    #[inline]
    pub fn depth_inside(&self, x: &Point3<f64>) -> Option<f32> {
        let (px, depth) = self.camera.project_with_depth(x)?;
        let [w, h] = self.whole.map(|n| n as f64);
        if px.x < 0.0 || px.y < 0.0 || px.x > w - 1.0 || px.y > h - 1.0 {
            return None;
        }
        let far = self.distance_at([px.x as f32, px.y as f32]);
        Some(far * (depth / self.camera.lens.focal[0]) as f32)
    }

    /// How many pixels show the body, of a mask that was halved those that are left.
    pub fn body_px(&self) -> usize {
        self.distance.data.iter().filter(|d| **d > 0.0).count()
    }

    /// Signed distance to the border, between four pixels. \[px\]
    #[inline]
    fn distance_at(&self, at: [f32; 2]) -> f32 {
        let first = at.map(|a| a as usize);
        let size = [self.distance.width, self.distance.height];
        let [x, y] = [0, 1].map(|i| first[i].wrapping_sub(self.corner[i]));
        // The last column of the mask has none beyond it.
        let last = [0, 1].map(|i| size[i] - usize::from(self.corner[i] + size[i] < self.whole[i]));
        if x >= last[0] || y >= last[1] {
            let out = |i: usize| {
                let Range { start, end } = &self.body[i];
                f32::max(*start as f32 - at[i], at[i] - (end - 1) as f32).max(0.0)
            };
            return 0.5 - libm::hypotf(out(0), out(1));
        }
        let next = [(x + 1).min(size[0] - 1), (y + 1).min(size[1] - 1)];
        let four = [(x, y), (next[0], y), (x, next[1]), next.into()];
        let four = four.map(|(x, y)| self.distance.at(x, y));
        bilinear(four, [0, 1].map(|i| at[i] - first[i] as f32))
    }
}

/// At half the size, where a mask is large.
fn halved(mask: &Mask) -> Cow<'_, Mask> {
    if mask.width.max(mask.height) <= 3000 {
        return Cow::Borrowed(mask);
    }
    let (width, height) = (mask.width / 2, mask.height / 2);
    let mean = |i: usize| {
        let (x, y) = (i % width * 2, i / width * 2);
        let four =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| u32::from(mask.at(x + dx, y + dy)));
        (four.iter().sum::<u32>() / 4) as u8
    };
    Cow::Owned(Image {
        width,
        height,
        data: (0..width * height).map(mean).collect(),
    })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Intrinsics, Pose};
    use nalgebra::{Rotation3, Vector3};

    #[test]
    fn near_the_body_distances_are_those_of_the_whole_mask_and_farther_off_no_greater() {
        let mut mask = Mask::filled(300, 400, 0);
        for (x, y) in (120..170).flat_map(|x| (90..=399).map(move |y| (x, y))) {
            *mask.at_mut(x, y) = if x == 120 { 90 } else { 255 };
        }
        let camera = Camera {
            lens: Intrinsics::simple(300, 400, 500.0),
            pose: Pose {
                rotation: Rotation3::identity(),
                translation: Vector3::zeros(),
            },
        };
        let silhouette = Silhouette::of(&mask, &camera);
        let whole = signed_distance(&mask);
        assert_eq!(silhouette.corner, [113, 82]);
        assert_eq!(silhouette.body_px(), mask.area());
        let mut dice = proof::Dice(5);
        for _ in 0..20_000 {
            let at = [dice.unit() * 299.0, dice.unit() * 399.0].map(|a| a as f32);
            let (got, exact) = (silhouette.distance_at(at), whole.sample(at[0], at[1]));
            let near = at[0] >= 113.0 && at[0] < 177.0 && at[1] >= 82.0;
            match near {
                true => assert_eq!(got, exact, "{at:?}"),
                false => assert!(exact - 0.1 <= got && got <= -7.0, "{at:?}: {got}, {exact}"),
            }
        }
        let empty = Silhouette::of(&Mask::filled(30, 40, 0), &camera);
        assert!(empty.distance_at([29.0, 39.0]) < -1e4);
    }
}
