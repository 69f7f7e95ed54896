//! Where a photo hides an outline, as where clothes have the wall's colour, no pixel shows where the body ends: a mask follows
//! other photos and a learned sense of a person there, and is off by more than elsewhere.

use nalgebra::{Point3, Unit, Vector3};
use rayon::prelude::*;
use shape::{
    Camera, Cameras, MaskRuns, Masks, Outline, PhotoId, Photos, Place, Plane, Sigmas, View,
};
use std::f64::consts::TAU;

/// From this share of a tape on it is noted that outlines do not confirm it. By hand: looked at three scans
/// and five captures, at 0.7 and 1.4 of it: nothing changes.
pub(crate) const OPEN_SHARE: f64 = 0.012;
/// Of a pixel: its colours as they are decoded, and as they are (structural: what the buffers hold). \[bytes\]
const PHOTO_PIXEL: u64 = 6;
/// Standard deviation of an outline whose sides look alike, as a share of stature, off alike on all photos, fitted on masks of five
/// captures of `docs/lab/masks.md`, drawn by a seed (17, 20, 23, 27, 73): 0.0014 to 0.0061.
const UNSEEN: f64 = 0.0055;

/// The outlines of all masks, with what photos show of them.
pub(crate) struct Edges {
    views: Vec<(PhotoId, Camera, Vec<Place>)>,
    stature: f64,
}

/// What no photo shows of a section.
#[derive(Default)]
pub(crate) struct Unseen {
    /// Standard deviation of its tape by it: photos may all err alike. \[mm\]
    pub(crate) tape_mm: f64,
    /// Photos that show no edge beside it.
    pub(crate) photos: Vec<PhotoId>,
}

impl Unseen {
    /// Whether it shows in the interval of a tape, and is most of it if that is given. \[mm\]
    pub(crate) fn shows(&self, tape_mm: f64, sigmas: Option<&Sigmas>) -> bool {
        let most = |s: &Sigmas| 2.0 * self.tape_mm * self.tape_mm > s.variance();
        self.tape_mm > OPEN_SHARE * tape_mm && sigmas.is_none_or(most)
    }
}

impl Edges {
    /// What finding them takes: a photo a thread. \[bytes\]
    pub(crate) fn memory(photos: &Photos) -> u64 {
        photos.most_pixels() * PHOTO_PIXEL * rayon::current_num_threads() as u64
    }

    /// Of the photos whose sizes masks have. \[mm\]
    pub(crate) fn of(cameras: &Cameras, masks: &Masks, photos: &Photos, stature: f64) -> Edges {
        let pairs: Vec<_> = cameras.views.join(&masks.views).collect();
        let one = |(id, view, mask): &(PhotoId, &View, &MaskRuns)| {
            let outline = Outline::of(&photos.get(*id)?.decode().ok()?, &mask.pixels())?;
            let camera = view
                .camera
                .resized(outline.size[0] as u32, outline.size[1] as u32);
            Some((*id, camera, outline.places))
        };
        Edges {
            views: pairs.par_iter().filter_map(one).collect(),
            stature,
        }
    }

    /// What is unseen of a section: of each photo the outline beside its two ends.
    pub(crate) fn unseen(&self, contour: &[Point3<f64>], plane: &Plane) -> Unseen {
        let near_mm = 2.0 * UNSEEN * self.stature;
        let origin = crate::geometry::section::centre(contour);
        let (mut asked, mut sum, mut photos) = (0.0, 0.0, Vec::new());
        for (id, camera, places) in &self.views {
            let across = Vector3::from(plane.normal).cross(&(origin - camera.centre()));
            let Some(across) = Unit::try_new(across, 1e-9) else {
                continue;
            };
            let mut hidden = 0.0;
            for turn in [1.0, -1.0] {
                let out = |p: &&Point3<f64>| turn * (*p - origin).dot(&across);
                let end = contour.iter().max_by(|a, b| out(a).total_cmp(&out(b)));
                let shown = end.and_then(|end| camera.project_with_depth(end));
                let Some((px, depth)) = shown else { continue };
                let near_px = near_mm * camera.lens.focal[0] / depth;
                let far = |at: [usize; 2]| libm::hypot(at[0] as f64 - px.x, at[1] as f64 - px.y);
                let near = places.iter().filter(|place| far(place.at) < near_px);
                let (sum, all) = near.fold((0.0, 0.0), |(sum, all), place| {
                    (sum + f64::from(place.hidden), all + 1.0)
                });
                if all > 0.0 {
                    asked += 1.0;
                    hidden += sum / all;
                }
            }
            sum += hidden;
            // On one side at least.
            if hidden > 0.5 {
                photos.push(*id);
            }
        }
        Unseen {
            tape_mm: TAU * UNSEEN * self.stature * sum / f64::max(asked, 1.0),
            photos,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Intrinsics, Mask, Rgb};

    /// A post of 150 mm before a wall, which on its left has the post's colour: photos all around, and the post's section.
    fn post(alike: bool) -> (Edges, Vec<Point3<f64>>) {
        let one = |k: u32| {
            let (s, c) = libm::sincos(f64::from(k) * TAU / 18.0);
            let from = Point3::new(2500.0 * c, 2500.0 * s, 500.0);
            let lens = Intrinsics::simple(240, 320, 900.0);
            let camera = Camera::looking(lens, from, Point3::new(0.0, 0.0, 500.0));
            let mask = Mask::filled(240, 320, 0);
            let body = |i: usize| (i as f64 % 240.0 - 119.5).abs() < 54.1;
            let all = 0..240 * 320;
            let cover = all.clone().map(|i| if body(i) { 255 } else { 0 });
            let color = all.map(|i| match body(i) || alike && i % 240 < 120 {
                true => [140, 141, (i % 5) as u8 + 140],
                false => [90, 141, 140],
            });
            let photo = Rgb {
                width: 240,
                height: 320,
                data: color.collect(),
            };
            let mask = Mask {
                data: cover.collect(),
                ..mask
            };
            let outline = Outline::of(&photo, &mask).expect("one size");
            (PhotoId(k), camera, outline.places)
        };
        let edges = Edges {
            views: (0..18).map(one).collect(),
            stature: 1700.0,
        };
        let round = (0..360).map(|k| {
            let (s, c) = libm::sincos(f64::from(k) * TAU / 360.0);
            Point3::new(150.0 * c, 150.0 * s, 500.0)
        });
        (edges, round.collect())
    }

    #[test]
    fn a_tape_is_as_unsure_as_the_share_of_its_outlines_that_no_photo_shows() {
        let level = Plane {
            point_mm: [0.0, 0.0, 500.0],
            normal: [0.0, 0.0, 1.0],
        };
        let unseen = |alike| {
            let (edges, contour) = post(alike);
            edges.unseen(&contour, &level)
        };
        let half = unseen(true);
        let want = TAU * UNSEEN * 1700.0 / 2.0;
        assert!(
            (half.tape_mm - want).abs() < 0.02 * want,
            "{}",
            half.tape_mm
        );
        assert_eq!(half.photos.len(), 18);
        let clear = unseen(false);
        assert!(clear.tape_mm < 1e-3 * want && clear.photos.is_empty());
    }
}
