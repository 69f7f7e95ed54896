//! What comes again to the level is background: patches that photos of a turn share.
//!
//! The background is still, so where two photos show it their patches differ by noise alone. A body
//! that has turned between them does not look the same to the level, be it ever so plain: its shade
//! changes. So patches are compared pair by pair, and the photos that agree with most of
//! the rest show the background.

use crate::likelihood::neighbourhoods::{REACH_PX, Sums};
use crate::raster::raster;
use crate::scene::backdrop::Backdrop;
use rayon::prelude::*;
use shape::{Image, Rgb};

/// Patches may differ by so much more than those of most pixels do. By hand: looked at scene 132 without a plate, at
/// 0.7 and 1.4 of it: mean IoU −0.0001 and +0.0005.
const OUTLIER_FACTOR: f32 = 3.5;
/// Least and greatest squared difference that counts as noise before [`OUTLIER_FACTOR`]. By hand: looked at scene 132
/// without a plate, each at 0.7 and 1.4 of it: equal masks. \[levels²\]
const NOISE_SQUARED: (f32, f32) = (0.4, 12.0);
/// Share of a patch's own contrast by which it may differ: cameras tremble by a part of a pixel. By hand: looked at
/// scene 132 without a plate, at 0.7 and 1.4 of it: equal masks.
const TREMBLE_SHARE: f32 = 0.005;
/// Contrast from which on patches show how sharp a photo is. By hand: looked at scene 132 without a plate, at 0.7 and
/// 1.4 of it: mean IoU +0.0001. \[levels²\]
const STEEP_SQUARED: f32 = 200.0;
/// Where photos are not equally sharp [`TREMBLE_SHARE`] is [`OUTLIER_FACTOR`] times what most places of such a contrast
/// differ by, and at most so much: what a shift by half a pixel leaves, 0.5² of its square; photos are aligned better than that
/// (derived; docs/lab/masks.md).
const BLURRED_SHARE: f32 = 0.25;
/// Photos that show the same differ by noise alone, so they agree by so much in the mean. Where those that agree do so
/// barely, a body looks nearly alike from several sides: the crown of a head. By hand: looked at three
/// scenes (158 with a plate, 160 and 170 without), at 0.7 and 1.4 of it: mean IoU +0.0001 and +0.0003 at most.
const ALIKE_SHARE: f32 = 0.45;
/// Photos that each is compared with, at most (structural: a cap on work; of up to 18 photos each is compared with
/// all).
const MOST_PARTNERS: usize = 9;

/// Mean squared difference of the patches of two photos around each pixel, per channel. \[levels²\]
fn differences(a: &Rgb, b: &Rgb) -> Vec<f32> {
    let (w, h) = (a.width, a.height);
    let squared = |i: usize| -> u32 {
        let off = |c: usize| u32::from(a.data[i][c].abs_diff(b.data[i][c]));
        (0..3).map(|c| off(c) * off(c)).sum()
    };
    let sums = Sums::of(w, h, squared);
    let one = |i: usize| {
        let (sum, count) = sums.around(i, REACH_PX);
        sum as f32 / (count * 3) as f32
    };
    (0..w * h).map(one).collect()
}

/// Squared contrast within the patch around each pixel, per channel. \[levels²\]
fn contrast(photo: &Rgb) -> Vec<f32> {
    let (w, h) = (photo.width, photo.height);
    let steep = |i: usize| -> u32 {
        let (x, y) = (i % w, i / w);
        let off = |j: usize| -> u32 {
            let one = |c: usize| u32::from(photo.data[i][c].abs_diff(photo.data[j][c]));
            (0..3).map(|c| one(c) * one(c)).sum()
        };
        let right = if x + 1 < w { off(i + 1) } else { 0 };
        right + if y + 1 < h { off(i + w) } else { 0 }
    };
    let sums = Sums::of(w, h, steep);
    let area = ((2 * REACH_PX + 1) * (2 * REACH_PX + 1) * 3) as f32;
    (0..w * h)
        .map(|i| sums.around(i, REACH_PX).0 as f32 / area)
        .collect()
}

/// Pairs of photos that are compared.
fn pairs(count: usize) -> Vec<(usize, usize)> {
    let half = count / 2;
    let mut steps: Vec<usize> = (1..=MOST_PARTNERS.min(half))
        .map(|i| (i * half).div_ceil(MOST_PARTNERS.min(half)))
        .collect();
    steps.dedup();
    let all = steps
        .iter()
        .flat_map(|s| (0..count).map(move |k| (k, (k + s) % count)));
    let mut all: Vec<(usize, usize)> = all.map(|(a, b)| (a.min(b), a.max(b))).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// How far two photos differ where they show the same.
struct Unlike {
    /// Of most pixels. \[levels²\]
    noise: f32,
    /// Share of a patch's own contrast.
    tremble: f32,
}

impl Unlike {
    /// Measured: less than half shows something else in one of them.
    fn of(far: &[f32], steep: &dyn Fn(usize) -> f32) -> Self {
        let some = || (0..far.len()).step_by(3);
        let middle = |mut values: Vec<f32>| {
            let rank = values.len() * 2 / 5;
            match values.is_empty() {
                true => 0.0,
                false => *values.select_nth_unstable_by(rank, f32::total_cmp).1,
            }
        };
        let noise =
            middle(some().map(|i| far[i]).collect()).clamp(NOISE_SQUARED.0, NOISE_SQUARED.1);
        // Some photos are less sharp.
        let edges = some().filter(|i| steep(*i) > STEEP_SQUARED);
        let blur = middle(
            edges
                .map(|i| (far[i] - noise).max(0.0) / steep(i))
                .collect(),
        );
        let tremble = TREMBLE_SHARE.max((OUTLIER_FACTOR * blur).min(BLURRED_SHARE));
        Unlike { noise, tremble }
    }

    /// The most by which patches of such a contrast differ that show the same. \[levels²\]
    fn most(&self, steep: f32) -> f32 {
        OUTLIER_FACTOR * self.noise + self.tremble * steep
    }
}

/// Photos compared with each other, to find what those that share it pixel for pixel agree on.
pub struct Recurring<'a> {
    photos: &'a [Rgb],
    pairs: Vec<(usize, usize)>,
    /// How far each pair agrees at each pixel, in 255ths.
    agreement: Vec<Vec<u8>>,
}

impl<'a> Recurring<'a> {
    /// Of photos of one size.
    pub fn of(photos: &'a [Rgb]) -> Self {
        let pairs = pairs(photos.len());
        let rough: Vec<Vec<f32>> = photos.par_iter().map(contrast).collect();
        let agreement = pairs.par_iter().map(|(a, b)| {
            let far = differences(&photos[*a], &photos[*b]);
            let steep = |i: usize| rough[*a][i].min(rough[*b][i]);
            let unlike = Unlike::of(&far, &steep);
            let share = |i: usize| (1.0 - far[i] / unlike.most(steep(i))).max(0.0);
            (0..far.len()).map(|i| (share(i) * 255.0) as u8).collect()
        });
        Recurring {
            agreement: agreement.collect(),
            photos,
            pairs,
        }
    }

    /// What they show. `hidden` names the photos (first) and pixels (second) that cannot show it; `least` is the agreement with
    /// other photos, each of which gives 1 at most, that makes a pixel seen.
    pub fn shown(&self, hidden: Option<&[Image<bool>]>, least: f32) -> Backdrop {
        let (w, h) = self.photos.first().map_or((0, 0), |p| (p.width, p.height));
        let one = |i: usize| self.common(i, hidden, least);
        let colors: Vec<Option<[u8; 3]>> = (0..w * h).into_par_iter().map(one).collect();
        let shown = colors.iter().map(|color| color.unwrap_or([0; 3]));
        Backdrop {
            image: raster(w, h, shown.collect()),
            seen: raster(w, h, colors.iter().map(Option::is_some).collect()),
        }
    }

    /// What most photos show at a pixel; `None` where too few agree.
    fn common(&self, i: usize, hidden: Option<&[Image<bool>]>, least: f32) -> Option<[u8; 3]> {
        let open = |k: usize| hidden.is_none_or(|hidden| !hidden[k].data[i]);
        let agreement = || {
            let all = self.pairs.iter().zip(&self.agreement);
            let shown = all.filter(|((a, b), _)| open(*a) && open(*b));
            shown.map(|(pair, agreement)| (pair, agreement[i]))
        };
        let mut worth = vec![0u32; self.photos.len()];
        for ((a, b), share) in agreement() {
            worth[*a] += u32::from(share);
            worth[*b] += u32::from(share);
        }
        let best = (0..worth.len()).max_by_key(|k| (worth[*k], usize::MAX - k))?;
        let partners =
            agreement().filter(|((a, b), share)| *share > 0 && (*a == best || *b == best));
        let agree: Vec<usize> = std::iter::once(best)
            .chain(partners.map(|((a, b), _)| a + b - best))
            .collect();
        let alike = ALIKE_SHARE.min(least) * 255.0 * (agree.len() - 1) as f32;
        if (worth[best] as f32) < alike.max(least * 255.0) {
            return None;
        }
        let count = agree.len() as u32;
        let mut sum = [0u32; 3];
        for k in &agree {
            (0..3).for_each(|c| sum[c] += u32::from(self.photos[*k].data[i][c]));
        }
        Some(sum.map(|s| ((s + count / 2) / count) as u8))
    }
}
