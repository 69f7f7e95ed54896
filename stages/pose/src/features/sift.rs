//! The stage that finds features.

use crate::features::describe::describe;
use crate::features::detect::{Extremum, extrema, orientations};
use crate::features::gradients::fading;
use crate::features::moving::moving;
use crate::features::pyramid::{Octave, octaves};
use crate::features::quota::{FAINT_SHARE, Spot, kept, within};
use rayon::prelude::*;
use shape::{Features, Gray, Image, Keypoint, Keypoints, Photo, PhotoId, Photos};
use stage::{Ctx, Stage, Stop};
use std::borrow::Cow;
use std::sync::Arc;

stage::params! {
    /// Which points are features.
    pub struct SiftParams {
        /// Least contrast of a feature, in levels of 255.
        #[range(0.1..=50.0)]
        #[source(by_hand = "three captures: halved, ground +2.4 mm for one; doubled, ground +3.2 to +19.2 mm for two (docs/lab/numbers.md)")]
        contrast: f64 = 1.6,
        /// Greatest ratio of curvatures: beyond, a point is on an edge.
        #[range(1.5..=100.0)]
        #[source(cited = "Lowe 2004, §4.1")]
        edge: f64 = 10.0,
        /// Most features a photo: where the background is still while things turn three quarters of them
        /// there, spread over what is seen; else the strongest.
        #[range(50..=100000)]
        #[source(structural)]
        most: u32 = 6000,
        /// Longest side at which features are searched; larger photos are reduced by whole factors.
        #[range(200..=10000)]
        #[source(structural)]
        longest_px: u32 = 3200,
        /// Photos whose longer side is at most this are searched at twice their size, too: for
        /// features of the size of a pixel.
        // How far to search is structural; where the bound is was set by hand, between captures that were looked at
        // (docs/lab/performance.md).
        #[range(0..=10000)]
        #[source(structural)]
        fine_px: u32 = 2000,
        /// Whether features are searched even where a marker mat gives the cameras.
        beside_mat: bool = false,
    }
}

stage::inputs! {
    /// Photos.
    pub struct SiftInput {
        /// The photos to search.
        photos: Arc<Photos>,
    }
}

/// Of a pixel of the photo: its colours and its brightness (structural: what the buffers hold). \[bytes\]
const PHOTO_PIXEL: u64 = 8;

/// Of a pixel at the finest scale: its octave's six scales, and what is in the making. \[bytes\]
/// (structural: what the buffers hold.)
const SCALES_PIXEL: u64 = 30;

/// What the search in one photo takes. \[bytes\]
fn scales_bytes(width: u32, height: u32, p: &SiftParams) -> u64 {
    let factor = u64::from(width.max(height).div_ceil(p.longest_px).max(1));
    let pixels = u64::from(width) * u64::from(height);
    let twice = u64::from(width.max(height)) / factor <= u64::from(p.fine_px);
    let finest = pixels / (factor * factor) * if twice { 4 } else { 1 };
    pixels * PHOTO_PIXEL + finest * SCALES_PIXEL
}

/// `pose.sift`: photos → keypoints.
pub struct Sift;

impl Stage for Sift {
    const NAME: &'static str = "pose.sift";
    const VERSION: u32 = 5;
    const ABOUT: &'static str =
        "Finds scale-invariant features (Lowe 2004) and describes them (RootSIFT).";
    type Params = SiftParams;
    type Input = SiftInput;
    type Output = Keypoints;
    const METRICS: &'static [&'static str] = &["features a photo"];

    /// A photo a thread: its scales, at twice its size where that is searched, too.
    fn memory(p: &SiftParams, input: &SiftInput) -> u64 {
        if input.photos.rig.tagged() && !p.beside_mat {
            return 0;
        }
        let photos = input.photos.iter();
        let each = photos.map(|(_, photo)| scales_bytes(photo.width, photo.height, p));
        each.max().unwrap_or(0) * rayon::current_num_threads() as u64
    }

    fn run(p: &SiftParams, input: SiftInput, ctx: &Ctx<'_>) -> Result<Keypoints, Stop> {
        if input.photos.rig.tagged() && !p.beside_mat {
            return Ok(Keypoints::default());
        }
        let all: Vec<(PhotoId, &Photo)> = input.photos.iter().collect();
        let regions = moving(&input.photos)?;
        ctx.check()?;
        let steps = ctx.steps("photos", all.len());
        let one = |(id, photo): &(PhotoId, &Photo)| -> Result<(PhotoId, Features), Stop> {
            let region = regions.as_ref().map(|r| &r[id.0 as usize]);
            let turning = region.map(|r| r.data.iter().map(|t| u8::from(*t)).collect::<Vec<u8>>());
            let depends = [photo.content(), stage::hash(&turning.unwrap_or_default())];
            let found: Keypoints = ctx.part("features", &depends, || {
                let gray = photo.decode()?.gray();
                let views = [(PhotoId(0), features_in(&gray, p, region))]
                    .into_iter()
                    .collect();
                Ok(Keypoints { views })
            })?;
            steps.tick()?;
            Ok((
                *id,
                found.views.get(PhotoId(0)).cloned().unwrap_or_default(),
            ))
        };
        let views: Vec<_> = all.par_iter().map(one).collect::<Result<_, Stop>>()?;
        let keypoints = Keypoints {
            views: views.into_iter().collect(),
        };
        let count: usize = keypoints.views.values().map(|f| f.points.len()).sum();
        ctx.metric(
            "features a photo",
            count as f64 / all.len().max(1) as f64,
            "",
        );
        Ok(keypoints)
    }
}

/// The features of one image, the strongest first.
pub fn features(gray: &Gray, p: &SiftParams) -> Features {
    features_in(gray, p, None)
}

/// The same; where a region shows what turns, most of them are there, fainter ones too.
fn features_in(gray: &Gray, p: &SiftParams, region: Option<&Image<bool>>) -> Features {
    let longest = gray.width.max(gray.height);
    let factor = longest.div_ceil(p.longest_px as usize).max(1);
    let reduced = match factor {
        1 => Cow::Borrowed(gray),
        _ => Cow::Owned(gray.reduced(factor)),
    };
    let mut found: Vec<(f32, Keypoint, [u8; 128])> = Vec::new();
    let fading = fading();
    let fine = reduced.width.max(reduced.height) <= p.fine_px as usize;
    let (contrast, edge) = (p.contrast as f32, p.edge as f32);
    let least = if region.is_some() { FAINT_SHARE } else { 1.0 } * contrast;
    let looked = octaves(&reduced, fine, |unit, mut octave| {
        let found = extrema(&octave, least, edge);
        octave.keep(|layer| found.iter().any(|e| e.layer == layer));
        ((unit, octave), found)
    });
    let (octaves, all): (Vec<(f32, Octave)>, Vec<Vec<Extremum>>) = looked.into_iter().unzip();
    let at = |unit: f32, v: f32| (v * unit + 0.5) * factor as f32 - 0.5;
    let mut chosen = match region {
        Some(region) => {
            let spot = |unit: f32, e: &Extremum| Spot {
                at: [at(unit, e.x), at(unit, e.y)],
                contrast: e.contrast,
            };
            let each = octaves.iter().zip(&all);
            let spots = each.flat_map(|((unit, _), es)| es.iter().map(|e| spot(*unit, e)));
            let spots: Vec<Spot> = spots.collect();
            let size = [gray.width, gray.height];
            kept(&spots, p.most as usize, size, contrast, &|place| {
                within(region, place, size)
            })
        }
        None => strongest(&all, p.most as usize),
    }
    .into_iter();
    for ((unit, octave), points) in octaves.iter().zip(&all) {
        for e in points {
            // Those that are not among the chosen are not described.
            if chosen.next() != Some(true) {
                continue;
            }
            let image = &octave.blurred[e.layer];
            for angle in orientations(image, e, &fading) {
                let point = Keypoint {
                    x: at(*unit, e.x),
                    y: at(*unit, e.y),
                    scale: e.scale * unit * factor as f32,
                    angle,
                };
                found.push((e.contrast, point, describe(image, e, angle, &fading)));
            }
        }
    }
    found.sort_by(|a, b| {
        let place = |k: &Keypoint| (k.y, k.x);
        let (p, q) = (place(&a.1), place(&b.1));
        b.0.total_cmp(&a.0)
            .then(p.0.total_cmp(&q.0))
            .then(p.1.total_cmp(&q.1))
    });
    found.truncate(p.most as usize);
    Features {
        points: found.iter().map(|f| f.1).collect(),
        descriptors: found.iter().map(|f| f.2).collect(),
    }
}

/// Whether each of all is among the strongest.
fn strongest(all: &[Vec<Extremum>], most: usize) -> Vec<bool> {
    let mut strong: Vec<f32> = all.iter().flatten().map(|e| e.contrast).collect();
    strong.sort_by(|a, b| b.total_cmp(a));
    let bar = strong.get(most).copied().unwrap_or(0.0);
    all.iter().flatten().map(|e| e.contrast >= bar).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Soft blobs at known places.
    fn blobs(turn: f32, shift: [f32; 2]) -> (Gray, Vec<[f32; 2]>) {
        let mut dice = proof::Dice(4);
        let (s, c) = libm::sincosf(turn);
        let mut image = Gray::filled(320, 320, 90.0);
        let mut places = Vec::new();
        for _ in 0..60 {
            let (x, y) = (
                dice.within(-110.0, 110.0) as f32,
                dice.within(-110.0, 110.0) as f32,
            );
            let (sx, sy) = (dice.within(2.0, 5.0) as f32, dice.within(2.0, 5.0) as f32);
            let high = dice.within(-60.0, 60.0) as f32;
            let at = [
                160.0 + c * x - s * y + shift[0],
                160.0 + s * x + c * y + shift[1],
            ];
            places.push(at);
            for (i, v) in image.data.iter_mut().enumerate() {
                let (dx, dy) = ((i % 320) as f32 - at[0], (i / 320) as f32 - at[1]);
                let (u, w) = (c * dx + s * dy, c * dy - s * dx);
                *v += high * libm::expf(-(u * u / (sx * sx) + w * w / (sy * sy)) / 2.0);
            }
        }
        (image, places)
    }

    #[test]
    fn a_turned_and_shifted_picture_shows_the_same_features() {
        let p = SiftParams {
            contrast: 1.0,
            ..SiftParams::default()
        };
        let (a, b) = (
            features(&blobs(0.0, [0.0, 0.0]).0, &p),
            features(&blobs(0.6, [3.3, -2.7]).0, &p),
        );
        let (s, c) = libm::sincosf(0.6f32);
        let (mut near, mut right) = (0, 0);
        for (k, d) in a.points.iter().zip(&a.descriptors) {
            let (x, y) = (k.x - 160.0, k.y - 160.0);
            let want = [160.0 + c * x - s * y + 3.3, 160.0 + s * x + c * y - 2.7];
            let differ = |e: &[u8; 128]| -> i32 {
                d.iter()
                    .zip(e)
                    .map(|(a, b)| (i32::from(*a) - i32::from(*b)).pow(2))
                    .sum()
            };
            let best = (0..b.points.len())
                .min_by_key(|i| differ(&b.descriptors[*i]))
                .unwrap();
            let off = libm::hypotf(b.points[best].x - want[0], b.points[best].y - want[1]);
            near += usize::from(off < 3.0);
            right += usize::from(off < 0.3);
        }
        let count = a.points.len();
        assert!(count > 50, "{count}");
        assert!(
            near * 10 > count * 7 && right * 10 > near * 8,
            "{right} of {near} of {count}"
        );
    }
}
