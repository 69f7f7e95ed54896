//! Without a plate: what was kept as body though nothing vouches for it.
//!
//! Behind some pixels no photo shows the background. What is there has the body's colours, as the body shows
//! them before a background that is known; where it has not, it may be a bit of that.

use crate::likelihood::body::{STRANGE, body_cost};
use crate::likelihood::disk_colors::mixture;
use crate::likelihood::gmm::Gmm;
use crate::scene::backdrop::{SHY, thinned};
use crate::scene::still_and_disk::Shot;
use rayon::prelude::*;
use shape::{Image, parts};

/// Share of each mask that its largest patch takes which no photo shows without the body, and whose
/// colours the body has nowhere else. \[%\] `radius` is the disk's, 0 without one: its top is left out.
pub(crate) fn doubtful(shots: &[Shot], cuts: &[Option<Image<bool>>], radius: f64) -> Vec<f64> {
    let Some(vouched) = Vouched::of(shots, cuts) else {
        return vec![0.0; shots.len()];
    };
    let share = |(shot, cut): (&Shot, &Option<Image<bool>>)| {
        let Some(cut) = cut else { return 0.0 };
        let doubted = |i: usize| {
            let alone = vouched.alone(shot, cut, i, radius);
            alone && vouched.strange(shot.small.data[i])
        };
        let data = (0..cut.data.len()).map(doubted).collect();
        let (_, sizes) = parts(&Image { data, ..*cut }, true);
        let most = sizes.into_iter().max().unwrap_or(0);
        let all = cut.data.iter().filter(|b| **b).count();
        100.0 * most as f64 / all.max(1) as f64
    };
    shots.par_iter().zip(cuts).map(share).collect()
}

/// Where photos show the background without the body, and which colours the body shows before it.
struct Vouched {
    /// Pixels that some photo shows without the body.
    bare: Image<bool>,
    body: Gmm,
}

impl Vouched {
    /// `None` without any cut, or if nothing is vouched for.
    fn of(shots: &[Shot], cuts: &[Option<Image<bool>>]) -> Option<Self> {
        let mut bare = cuts.iter().flatten().next()?.map(|_| false);
        for cut in cuts.iter().flatten() {
            let free = thinned(&cut.map(|b| !b), SHY);
            let pairs = bare.data.iter_mut().zip(&free.data);
            pairs.for_each(|(bare, free)| *bare |= free);
        }
        let mut colors = Vec::new();
        for (shot, cut) in shots.iter().zip(cuts) {
            let Some(cut) = cut else { continue };
            let before = (0..cut.data.len()).filter(|i| cut.data[*i] && bare.data[*i]);
            colors.extend(before.step_by(5).map(|i| shot.small.data[i]));
        }
        let body = mixture(&colors)?;
        Some(Vouched { bare, body })
    }

    /// Whether nothing but its colour can tell if a pixel of a cut is body.
    fn alone(&self, shot: &Shot, cut: &Image<bool>, i: usize, radius: f64) -> bool {
        cut.data[i] && !self.bare.data[i] && !shot.shows_disk(i, radius)
    }

    /// Whether the body has no such colour.
    fn strange(&self, color: [u8; 3]) -> bool {
        body_cost(&self.body, color) >= STRANGE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::raster;
    use nalgebra::{Rotation3, Vector3};
    use shape::{Camera, Intrinsics, PhotoId, Pose, Rgb};

    #[test]
    fn a_grey_patch_amid_a_skin_that_covers_all_behind_it_is_reported_of_its_photo_alone() {
        let mut dice = proof::Dice(6);
        let camera = Camera {
            lens: Intrinsics::simple(60, 80, 100.0),
            pose: Pose {
                rotation: Rotation3::identity(),
                translation: Vector3::new(0.0, 0.0, 900.0),
            },
        };
        let mut shot = |k: u32| {
            let mut small = Rgb::filled(60, 80, [150; 3]);
            for p in &mut small.data {
                let light = dice.within(-30.0, 30.0);
                *p = [200.0, 150.0, 120.0].map(|v| (v + light) as u8);
            }
            // Grey within the body on the second photo; green beside, where the third shows the background.
            for i in (20 * 60..50 * 60).filter(|_| k == 1) {
                match i % 60 {
                    26..34 => small.data[i] = [150, 150, 148],
                    42..48 => small.data[i] = [60, 160, 60],
                    _ => {}
                }
            }
            Shot {
                id: PhotoId(k),
                small,
                camera,
            }
        };
        let shots: Vec<Shot> = (0..3).map(&mut shot).collect();
        let cut = |from: usize, to: usize| {
            let data = (0..60 * 80).map(|i| (from..to).contains(&(i % 60)));
            Some(raster(60, 80, data.collect()))
        };
        let cuts = [cut(10, 50), cut(10, 50), cut(20, 38)];
        let reported = doubtful(&shots, &cuts, 0.0);
        // 8 × 30 of 40 × 80 pixels.
        assert!((reported[1] - 7.5).abs() < 0.2, "{reported:?}");
        assert!(reported[0] == 0.0 && reported[2] == 0.0, "{reported:?}");
    }
}
