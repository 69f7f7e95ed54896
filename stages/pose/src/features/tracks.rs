//! The stage that follows features over the photos.

use crate::calibration::prior::{first_lens, knows_focal};
use crate::features::matching::{mutual, standing, still};
use crate::two_view::background_shift::background_shift;
use crate::two_view::epipolar::{agreeing, agreeing_through};
use crate::two_view::five_point::Both;
use rayon::prelude::*;
use shape::{Features, Intrinsics, Keypoints, Observation, PhotoId, Photos, Tracks};
use stage::{Ctx, Message, Stage, Stop, message};
use std::collections::BTreeMap;
use std::sync::Arc;

stage::messages! {
    FEW_FEATURES = "warn-few-features": "only {seen} features are seen on other photos, too: lay a mat or a patterned cloth on the disk, or turn by smaller steps";
    BACKGROUND_MOVED = "warn-room-moved": "between {before} and {after} the background moved by {by:.0 px} in the photo: the camera was moved; leave out what was taken before or after, or take the turn again";
    SHOWS_SAME = "warn-shows-same": "{after} shows the same as {before}, nothing turned between them: remove one of them";
    MORE = "warn-and-more": "and so on, {count} more photos";
}

stage::params! {
    /// Which features are one point.
    pub struct TracksParams {
        /// Photos within so many steps of each other are compared.
        #[range(1..=20)]
        #[source(structural)]
        neighbours: u32 = 3,
        /// How far a feature may rise or sink from photo to photo, as a share of the photo's height.
        #[range(0.01..=1.0)]
        #[source(by_hand = "two captures: halved, size +0.16 % for one; doubled, rotations −0.02° for one (docs/lab/numbers.md)")]
        rise: f64 = 0.16,
        /// The nearest description must be nearer than this share of the next one.
        #[range(0.3..=1.0)]
        #[source(by_hand = "two captures: halved, centres −2.90 to +300.89 mm (docs/lab/numbers.md)")]
        ratio: f64 = 0.85,
        /// Features that move less belong to what does not turn: the background.
        #[range(0.0..=50.0)]
        #[source(by_hand = "two captures: halved, size +0.17 % for one; doubled, size +0.07 % for one (docs/lab/numbers.md)")]
        still_px: f64 = 3.0,
        /// How far a match may be off its epipolar line.
        #[range(0.1..=50.0)]
        #[source(by_hand = "two captures: halved, ground −1.3 mm for one; doubled, ground −1.1 mm for one (docs/lab/numbers.md)")]
        epipolar_px: f64 = 2.5,
        /// Photos of which no such share of the matches agrees have nothing in common: by chance, a
        /// quarter does.
        #[range(0.0..=1.0)]
        #[source(derived = "by chance a quarter of the matches agrees with some epipolar geometry")]
        least_share: f64 = 0.3,
        /// Most samples of a pair's RANSAC.
        #[range(10..=100000)]
        #[source(structural)]
        rounds: u32 = 3000,
        /// Seed of RANSAC.
        #[source(structural)]
        seed: i64 = 1,
    }
}

stage::inputs! {
    /// Features, and the photos they are of.
    pub struct TracksInput {
        /// The features.
        keypoints: Arc<Keypoints>,
        /// The photos: their size and names.
        photos: Arc<Photos>,
    }
}

/// Of a feature: its description as numbers, and its matches (structural: what the buffers hold). \[bytes\]
const FEATURE: u64 = 768;

/// `pose.tracks`: keypoints, photos → tracks.
pub struct Follow;

impl Stage for Follow {
    const NAME: &'static str = "pose.tracks";
    const VERSION: u32 = 8;
    const ABOUT: &'static str = "Follows features over the photos: what does not move and what breaks the epipolar constraint goes.";
    type Params = TracksParams;
    type Input = TracksInput;
    type Output = Tracks;
    const METRICS: &'static [&'static str] =
        &["matches a pair", "matches ignored as background", "tracks"];

    /// Descriptions as they are compared, and what they match.
    fn memory(_: &TracksParams, input: &TracksInput) -> u64 {
        let features = input.keypoints.views.values().map(|f| f.points.len());
        features.sum::<usize>() as u64 * FEATURE
    }

    fn run(p: &TracksParams, input: TracksInput, ctx: &Ctx<'_>) -> Result<Tracks, Stop> {
        let views: Vec<(PhotoId, &Features)> = input.keypoints.views.iter().collect();
        let n = views.len();
        let reach = (p.neighbours as usize).min(n.saturating_sub(1) / 2).max(1);
        let pairs: Vec<(usize, usize)> = (0..n)
            .flat_map(|i| (1..=reach).map(move |step| (i, (i + step) % n)))
            .map(|(i, j)| (i.min(j), i.max(j)))
            .filter(|(i, j)| i != j)
            .collect();
        let height = input
            .photos
            .photos
            .first()
            .map_or(1000.0, |p| p.height as f32);
        if input.photos.photos.is_empty() {
            return Ok(Tracks::default());
        }
        let first = first_lens(&input.photos);
        let known = knows_focal(&input.photos.rig).then_some(&first);
        let of: Vec<&Features> = views.iter().map(|v| v.1).collect();
        let still = standing(&of, p.neighbours as usize, p.still_px as f32);
        ctx.check()?;
        let steps = ctx.steps("pairs", pairs.len());
        let one = |(i, j): &(usize, usize)| -> Result<Common, Stop> {
            let found = matched(
                [of[*i], of[*j]],
                [&still[*i], &still[*j]],
                p,
                p.rise as f32 * height,
                &first,
                known,
            );
            steps.tick()?;
            Ok(found)
        };
        let all: Vec<_> = pairs.par_iter().map(one).collect::<Result<_, Stop>>()?;
        let still: usize = all.iter().map(|a| a.still).sum();
        let name = |i: usize| input.photos.get(views[i].0).map_or("", |p| p.name.as_str());
        warnings(&pairs, &all, &name)
            .iter()
            .for_each(|w| ctx.warn(w));
        let matches: Vec<Match> = pairs
            .iter()
            .zip(&all)
            .flat_map(|((i, j), c)| c.matches.iter().map(|(a, b)| ((*i, *a), (*j, *b))))
            .collect();
        ctx.metric(
            "matches a pair",
            matches.len() as f64 / pairs.len().max(1) as f64,
            "",
        );
        ctx.metric("matches ignored as background", still as f64, "");
        let tracks = joined(&views, &matches);
        ctx.metric("tracks", tracks.points.len() as f64, "");
        for (id, _) in &views {
            let seen = tracks
                .points
                .iter()
                .filter(|t| t.iter().any(|s| s.photo == *id))
                .count();
            if seen < 20 {
                let name = input.photos.get(*id).map_or("", |p| p.name.as_str());
                ctx.warn(message!(FEW_FEATURES, seen = seen).of_what(name));
            }
        }
        Ok(tracks)
    }
}

/// Two features, each by photo and place.
type Match = ((usize, u32), (usize, u32));

/// What two photos have in common.
struct Common {
    /// What moves as one rigid thing.
    matches: Vec<(u32, u32)>,
    /// How many features stood still.
    still: usize,
    /// How far the background moved, where it did. \[px\]
    background_px: Option<f64>,
}

/// What the user should know of neighbouring photos: a camera that was moved, a photo taken twice.
fn warnings<'a>(
    pairs: &[(usize, usize)],
    all: &[Common],
    name: &dyn Fn(usize) -> &'a str,
) -> Vec<Message> {
    let next = || pairs.iter().zip(all).filter(|((i, j), _)| *j == i + 1);
    let mut stood: Vec<usize> = next().map(|(_, c)| c.still).collect();
    stood.sort_unstable();
    let usual = stood.get(stood.len() / 2).copied().unwrap_or(0);
    let mut warnings: Vec<Message> = Vec::new();
    for ((i, j), c) in next() {
        let (a, b) = (name(*i), name(*j));
        if let Some(px) = c.background_px {
            warnings.push(message!(BACKGROUND_MOVED, before = a, after = b, by = px));
        }
        if c.matches.is_empty() && c.still > 100 && c.still > usual * 11 / 10 {
            warnings.push(message!(SHOWS_SAME, after = b, before = a));
        }
    }
    if warnings.len() > 5 {
        let more = warnings.len() - 4;
        warnings.truncate(4);
        warnings.push(message!(MORE, count = more));
    }
    warnings
}

/// The matches of a pair.
fn matched(
    [a, b]: [&Features; 2],
    known_still: [&Vec<bool>; 2],
    p: &TracksParams,
    rise: f32,
    first: &Intrinsics,
    known: Option<&Intrinsics>,
) -> Common {
    let mut left_out = still(a, b, p.still_px as f32);
    let still = left_out[0].iter().filter(|still| **still).count();
    for (out, known) in left_out.iter_mut().zip(known_still) {
        out.iter_mut().zip(known).for_each(|(o, s)| *o |= s);
    }
    let mut moving = mutual(a, b, p.ratio, rise, &left_out);
    let both = |(i, j): &(u32, u32)| -> Both {
        let (k, l) = (&a.points[*i as usize], &b.points[*j as usize]);
        [
            [f64::from(k.x), f64::from(k.y)],
            [f64::from(l.x), f64::from(l.y)],
        ]
    };
    moving.retain(|m| {
        let [k, l] = both(m);
        libm::hypot(k[0] - l[0], k[1] - l[1]) >= p.still_px
    });
    let (rounds, seed) = (p.rounds as usize, p.seed as u64);
    let mut pairs: Vec<Both> = moving.iter().map(both).collect();
    let background = background_shift(first, &pairs, rounds.min(500), seed);
    if let Some(background) = &background {
        let mut of = background.of.iter();
        moving.retain(|_| !of.next().is_some_and(|of| *of));
        pairs = moving.iter().map(both).collect();
    }
    let agree = match known {
        Some(lens) => agreeing_through(lens, &pairs, p.epipolar_px, rounds, seed),
        None => agreeing(&pairs, p.epipolar_px, rounds, seed),
    };
    let kept: Vec<(u32, u32)> = moving
        .iter()
        .zip(&agree)
        .filter(|(_, agree)| **agree)
        .map(|(m, _)| *m)
        .collect();
    let chance = (kept.len() as f64) < p.least_share * moving.len() as f64;
    Common {
        matches: if chance { vec![] } else { kept },
        still,
        background_px: background.map(|r| r.by_px),
    }
}

/// Matches joined to tracks (union-find); a track with two features on one photo is no point.
fn joined(views: &[(PhotoId, &Features)], matches: &[Match]) -> Tracks {
    let mut first = vec![0usize];
    views
        .iter()
        .for_each(|(_, f)| first.push(first[first.len() - 1] + f.points.len()));
    let total = first[views.len()];
    let mut parents: Vec<u32> = (0..total as u32).collect();
    for ((v, i), (w, j)) in matches {
        shape::join(&mut parents, first[*v] as u32 + i, first[*w] as u32 + j);
    }
    let mut groups: BTreeMap<u32, Vec<Observation>> = BTreeMap::new();
    for (v, (id, features)) in views.iter().enumerate() {
        for (i, k) in features.points.iter().enumerate() {
            let at = shape::root(&mut parents, (first[v] + i) as u32);
            let observation = Observation {
                photo: *id,
                at_px: [k.x, k.y],
                scale_px: k.scale,
            };
            groups.entry(at).or_default().push(observation);
        }
    }
    let single =
        |t: &Vec<Observation>| t.len() >= 2 && t.windows(2).all(|w| w[0].photo != w[1].photo);
    Tracks {
        points: groups.into_values().filter(single).collect(),
    }
}
