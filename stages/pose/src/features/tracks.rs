//! The stage that follows features over the photos.

use crate::calibration::prior::{first_lens, knows_focal};
use crate::features::matching::standing;
use crate::features::order::{Misplaced, Shared, doubtful, misplaced};
use crate::features::pair::{Common, matched};
use crate::features::params::TracksParams;
use rayon::prelude::*;
use shape::{Features, Keypoints, Observation, PhotoId, Photos, Tracks, upper_median};
use stage::{Ctx, Message, Stage, Stop, message};
use std::collections::BTreeMap;
use std::sync::Arc;

stage::messages! {
    FEW_FEATURES = "warn-few-features": "only {seen} features are seen on other photos, too: lay a mat or a patterned cloth on the disk, or turn by smaller steps";
    BACKGROUND_MOVED = "warn-room-moved": "between {before} and {after} the background moved by {by:.0 px} in the photo: the camera was moved; leave out what was taken before or after, or take the turn again";
    SHOWS_SAME = "warn-shows-same": "{after} shows the same as {before}, nothing turned between them: remove one of them";
    MORE = "warn-and-more": "and so on, {count} more photos";
}

stage::failures! {
    /// Why photos are in no turn.
    pub enum OrderError {
        /// Some are where they do not belong.
        Misplaced {
            /// How many.
            count: usize,
            /// One of them.
            photo: String,
            /// The photo that it belongs behind.
            before: String,
            /// The photo that it belongs before.
            after: String,
            /// All of them.
            names: String,
        } = "fail-misplaced": "{count} {count|photo is|photos are} out of turning order ({names}): {photo} shows what is between {before} and {after}; rename the photos into their order, or leave out those that are not (if you are sure of it: --set tracks.in_order=false)",
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
    const VERSION: u32 = 10;
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
        let common = |(i, j): &(usize, usize)| -> Result<Common, Stop> {
            let (features, still) = ([of[*i], of[*j]], [&still[*i], &still[*j]]);
            ctx.check()?;
            let rise = p.rise as f32 * height;
            Ok(matched(features, still, p, rise, &first, known))
        };
        let one = |pair| -> Result<Common, Stop> {
            let found = common(pair)?;
            steps.tick()?;
            Ok(found)
        };
        let all: Vec<_> = pairs.par_iter().map(one).collect::<Result<_, Stop>>()?;
        let name = |i: usize| input.photos.get(views[i].0).map_or("", |p| p.name.as_str());
        let same = same(&pairs, &all, &of);
        if p.in_order {
            // Where nothing turned, all that is alike is still.
            let count = |(c, same): (&Common, &bool)| if *same { c.still } else { c.matches.len() };
            let counts = pairs.iter().copied().zip(all.iter().zip(&same).map(count));
            ordered(counts.collect(), n, &common, &name)?;
        }
        let still: usize = all.iter().map(|a| a.still).sum();
        warnings(&pairs, &all, &same, &name)
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

/// Compares two photos, by their places.
type Compare<'a> = dyn Fn(&(usize, usize)) -> Result<Common, Stop> + Sync + 'a;

/// Compares photos that may belong elsewhere with all photos; fails where some do.
fn ordered<'a>(
    mut shared: Shared,
    photos: usize,
    common: &Compare<'_>,
    name: &dyn Fn(usize) -> &'a str,
) -> Result<(), Stop> {
    let doubtful = doubtful(&shared, photos);
    let mut far: Vec<(usize, usize)> = doubtful
        .iter()
        .flat_map(|i| (0..photos).map(move |j| (*i.min(&j), *i.max(&j))))
        .filter(|pair| pair.0 != pair.1 && !shared.contains_key(pair))
        .collect();
    far.sort_unstable();
    far.dedup();
    let found: Vec<Common> = far.par_iter().map(common).collect::<Result<_, Stop>>()?;
    shared.extend(far.into_iter().zip(found.iter().map(|c| c.matches.len())));
    let misplaced = misplaced(&shared, photos);
    let Some(Misplaced { photo, between }) = misplaced.first() else {
        return Ok(());
    };
    let names: Vec<&str> = misplaced.iter().map(|m| name(m.photo)).collect();
    Err(OrderError::Misplaced {
        count: names.len(),
        photo: name(*photo).into(),
        before: name(between[0]).into(),
        after: name(between[1]).into(),
        names: names.join(", "),
    }
    .into())
}

/// Which pairs show the same: most of what turns between other neighbours is where it was.
fn same(pairs: &[(usize, usize)], all: &[Common], of: &[&Features]) -> Vec<bool> {
    let share = |((i, j), c): (&(usize, usize), &Common)| {
        let fewer = of[*i].points.len().min(of[*j].points.len());
        c.still as f64 / fewer.max(1) as f64
    };
    let shares: Vec<f64> = pairs.iter().zip(all).map(share).collect();
    let next = pairs.iter().zip(&shares).filter(|((i, j), _)| *j == i + 1);
    let usual = upper_median(next.map(|(_, share)| *share)).unwrap_or(1.0);
    shares
        .iter()
        .map(|share| *share > (1.0 + usual) / 2.0)
        .collect()
}

/// What the user should know of neighbouring photos: a camera that was moved, a photo taken twice.
fn warnings<'a>(
    pairs: &[(usize, usize)],
    all: &[Common],
    same: &[bool],
    name: &dyn Fn(usize) -> &'a str,
) -> Vec<Message> {
    let next = pairs.iter().zip(all.iter().zip(same));
    let mut warnings: Vec<Message> = Vec::new();
    for ((i, j), (c, same)) in next.filter(|((i, j), _)| *j == i + 1) {
        let (a, b) = (name(*i), name(*j));
        if let Some(px) = c.background_px {
            warnings.push(message!(BACKGROUND_MOVED, before = a, after = b, by = px));
        }
        if *same {
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
