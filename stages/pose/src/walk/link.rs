//! The stage that follows features over photos in any order.

use crate::calibration::prior::enlargement;
use crate::features::params::TracksParams;
use crate::walk::chains::{Link, chained};
use crate::walk::error::WalkError;
use crate::walk::pairs::{Rules, Shared, again, chosen, compared, largest, parts};
use crate::walk::stage::WalkParams;
use rayon::prelude::*;
use shape::{Features, Keypoints, PhotoId, Photos, Tracks};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// Which photos are compared, and which features are one point.
    pub struct LinkParams {
        /// How many of a photo's largest features are compared with those of all other photos.
        #[range(50..=20000)]
        #[source(structural)]
        preview: u32 = 1000,
        /// Fewest matches that must agree before two photos are compared in full.
        #[range(8..=1000)]
        #[source(derived = "as many as hold two photos together")]
        preview_least: u32 = WalkParams::default().least,
        /// How many of them are compared with those of a photo that holds on; then all features are,
        /// along epipolar lines.
        #[range(100..=100000)]
        #[source(structural)]
        search: u32 = 4000,
        /// Most photos with which a photo is compared in full: those that share most with it.
        #[range(1..=200)]
        #[source(structural)]
        partners: u32 = 12,
        /// Photos within so many steps of each other are compared in full in any case.
        #[range(0..=20)]
        #[source(structural)]
        neighbours: u32 = 1,
        /// The nearest description must be nearer than this share of the next one.
        #[range(0.3..=1.0)]
        #[source(cited = "Lowe 2004, §7.1")]
        ratio: f64 = 0.8,
        /// How far a match may be off its epipolar line, in proportion more on photos of more than
        /// 2400 pixels.
        #[range(0.1..=50.0)]
        #[source(derived = "as of pose.tracks")]
        epipolar_px: f64 = TracksParams::default().epipolar_px,
        /// Features that move less between two photos tell nothing of a camera that walks.
        #[range(0.0..=50.0)]
        #[source(derived = "three standard deviations of a feature (feature_px of pose.walk)")]
        still_px: f64 = 3.0 * WalkParams::default().feature_px,
        /// Least share of what photos have in common that must move in the picture.
        #[range(0.0..=1.0)]
        #[source(by_hand = "one capture: halved, nothing changes; doubled, no cameras for one (docs/lab/numbers.md)")]
        least_moving: f64 = 0.5,
        /// Fewest matches that hold two photos together.
        #[range(8..=1000)]
        #[source(derived = "as many as hold a camera of pose.walk")]
        least: u32 = WalkParams::default().least,
        /// Photos of which no such share of the matches agrees have nothing in common.
        #[range(0.0..=1.0)]
        #[source(derived = "as of pose.tracks: by chance a quarter of the matches agrees")]
        least_share: f64 = TracksParams::default().least_share,
        /// Most samples of a pair's RANSAC.
        #[range(10..=100000)]
        #[source(structural)]
        rounds: u32 = 1500,
        /// Seed of RANSAC.
        #[source(structural)]
        seed: i64 = 1,
    }
}

stage::inputs! {
    /// Features, and the photos they are of.
    pub struct LinkInput {
        /// The features.
        keypoints: Arc<Keypoints>,
        /// The photos: their names.
        photos: Arc<Photos>,
    }
}

/// Of a feature: its description as numbers, twice (structural). \[bytes\]
const FEATURE: u64 = 2 * 512;
/// Likenesses to one feature's descriptions, in a stride (structural). \[bytes\]
const STRIDE: u64 = 512;

/// `pose.link`: keypoints, photos → tracks.
pub struct LinkUp;

impl Stage for LinkUp {
    const NAME: &'static str = "pose.link";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Follows features over photos in any order that a camera took on its way: all pairs by their largest features, those that hold together in full.";
    type Params = LinkParams;
    type Input = LinkInput;
    type Output = Tracks;
    const METRICS: &'static [&'static str] = &[
        "pairs compared in full",
        "pairs that hold",
        "matches a pair",
        "stood still",
        "tracks",
    ];

    /// Two photos a thread: descriptions as they are compared.
    fn memory(_: &LinkParams, input: &LinkInput) -> u64 {
        let features = input.keypoints.views.values().map(|f| f.points.len());
        let most = features.max().unwrap_or(0) as u64;
        2 * most * (FEATURE + STRIDE) * rayon::current_num_threads() as u64
    }

    fn run(p: &LinkParams, input: LinkInput, ctx: &Ctx<'_>) -> Result<Tracks, Stop> {
        let views: Vec<(PhotoId, &Features)> = input.keypoints.views.iter().collect();
        let n = views.len();
        let full = Rules {
            ratio: p.ratio,
            epipolar_px: p.epipolar_px * enlargement(&input.photos),
            still_px: p.still_px,
            least: p.least as usize,
            share: p.least_share,
            rounds: p.rounds as usize,
            seed: p.seed as u64,
        };
        let quick = Rules {
            least: p.preview_least as usize,
            epipolar_px: 1.5 * full.epipolar_px,
            ..full
        };
        let few = |(_, f): &(PhotoId, &Features)| largest(f, p.preview as usize);
        let few: Vec<Vec<u32>> = views.iter().map(few).collect();
        let every: Vec<(usize, usize)> = (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .collect();
        let previews = compare(&every, &views, &few, &quick, false, ctx)?;
        let counts = every.iter().zip(&previews);
        let counts: Vec<_> = counts.map(|(p, s)| (*p, s.matches.len())).collect();
        let pairs = chosen(n, &counts, p.partners as usize, p.neighbours as usize);
        let some = |(_, f): &(PhotoId, &Features)| largest(f, p.search as usize);
        let some: Vec<Vec<u32>> = views.iter().map(some).collect();
        let shared = compare(&pairs, &views, &some, &full, true, ctx)?;
        let (still, moved) = shared
            .iter()
            .fold((0, 0), |(s, m), c| (s + c.still, m + c.matches.len()));
        let links: Vec<Link> = pairs
            .iter()
            .zip(shared)
            .filter(|(_, s)| !s.matches.is_empty())
            .map(|(photos, s)| Link {
                photos: *photos,
                matches: s.matches,
            })
            .collect();
        ctx.metric("pairs compared in full", pairs.len() as f64, "");
        ctx.metric("pairs that hold", links.len() as f64, "");
        let each = moved as f64 / links.len().max(1) as f64;
        ctx.metric("matches a pair", each, "");
        ctx.metric("stood still", still as f64, "");
        let name = |i: usize| {
            let photo = input.photos.get(views[i].0);
            photo.map_or(String::new(), |p| p.name.clone())
        };
        let linked: Vec<(usize, usize)> = links.iter().map(|l| l.photos).collect();
        if (moved as f64) < p.least_moving * (moved + still) as f64 {
            return Err(WalkError::StoodStill { still, moved }.into());
        }
        hangs_together(n, &linked, &name)?;
        let tracks = chained(&views, &links);
        ctx.metric("tracks", tracks.points.len() as f64, "");
        Ok(tracks)
    }
}

/// Compares pairs, side by side.
fn compare(
    pairs: &[(usize, usize)],
    views: &[(PhotoId, &Features)],
    some: &[Vec<u32>],
    rules: &Rules,
    guided: bool,
    ctx: &Ctx<'_>,
) -> Result<Vec<Shared>, Stop> {
    let steps = ctx.steps("pairs of photos", pairs.len());
    let one = |(i, j): &(usize, usize)| -> Result<Shared, Stop> {
        let both = [views[*i].1, views[*j].1];
        let mut found = compared(both, [&some[*i], &some[*j]], rules);
        if guided && !found.matches.is_empty() {
            found = again(both, found, rules);
        }
        steps.tick()?;
        Ok(found)
    };
    pairs.par_iter().map(one).collect()
}

/// Refuses photos that do not hang together.
fn hangs_together(
    photos: usize,
    pairs: &[(usize, usize)],
    name: &dyn Fn(usize) -> String,
) -> Result<(), WalkError> {
    let parts = parts(photos, pairs);
    let most = parts.first().map_or(0, Vec::len);
    if most >= 3 && 4 * most >= 3 * photos {
        return Ok(());
    }
    let alone: Vec<usize> = parts.iter().skip(1).flatten().copied().collect();
    Err(WalkError::Apart {
        most,
        of: photos,
        rest: alone.len(),
        names: alone
            .iter()
            .take(5)
            .map(|i| name(*i))
            .collect::<Vec<_>>()
            .join(", "),
    })
}
