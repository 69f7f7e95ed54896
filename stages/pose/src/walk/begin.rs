//! Two photos to begin with: much in common, seen from well apart.

use crate::adjust::scene::{Scene, Shot};
use crate::two_view::relative::{at_origin, two_views};
use crate::walk::groups::Groups;
use crate::walk::seen::Seen;
use nalgebra::Point2;
use rayon::prelude::*;
use shape::triangulate;
use shape::{Intrinsics, PhotoId};

/// Fewest points of a beginning. By hand: looked at a camera that only turned on the spot, which by 20 points was a walk;
/// two walks and eleven turns come out the same by 20 and by 30.
const LEAST_POINTS: usize = 30;
/// How many pairs are looked at (structural: the width of a search).
const PAIRS: usize = 40;
/// Points seen at this angle are worth most. By hand: looked at one capture, halved and doubled: no more than chance
/// (docs/lab/numbers.md). \[rad\]
const WIDE_RAD: f64 = 0.15;

/// The photos of a pair, and how many features they share.
type Pair = (usize, PhotoId, PhotoId);

/// The pairs that share most, but of each photo only its best few.
fn pairs(seen: &Seen) -> Vec<Pair> {
    let photos = seen.by_photo.len();
    let mut shared = vec![0usize; photos * photos];
    for track in &seen.tracks {
        for (k, (a, _)) in track.iter().enumerate() {
            for (b, _) in &track[k + 1..] {
                let (a, b) = (a.0.min(b.0) as usize, a.0.max(b.0) as usize);
                shared[a * photos + b] += 1;
            }
        }
    }
    let pair = |at: usize| {
        let (a, b) = (at / photos, at % photos);
        (shared[at], PhotoId(a as u32), PhotoId(b as u32))
    };
    let mut all: Vec<Pair> = (0..shared.len())
        .filter(|at| shared[*at] >= LEAST_POINTS)
        .map(pair)
        .collect();
    all.sort_by_key(|(count, a, b)| (std::cmp::Reverse(*count), *a, *b));
    all.truncate(PAIRS);
    all
}

/// The two shots of the best pair, its lenses as given; none where no pair tells of depth.
pub(crate) fn begun(
    seen: &Seen,
    groups: &Groups,
    lenses: &[Intrinsics],
    near_px: f64,
) -> Option<Scene> {
    let tried = |pair: &Pair| tried(seen, groups, lenses, pair, near_px);
    let tried: Vec<Option<(f64, Scene)>> = pairs(seen).par_iter().map(tried).collect();
    let mut best: Option<(f64, Scene)> = None;
    for (score, scene) in tried.into_iter().flatten() {
        if best.as_ref().is_none_or(|(most, _)| score > *most) {
            best = Some((score, scene));
        }
    }
    best.map(|(_, scene)| scene)
}

/// A pair's shots, and what they are worth as a beginning.
fn tried(
    seen: &Seen,
    groups: &Groups,
    lenses: &[Intrinsics],
    (_, a, b): &Pair,
    near_px: f64,
) -> Option<(f64, Scene)> {
    let of = |id: &PhotoId| groups.of[id.0 as usize];
    let own = [&lenses[of(a)], &lenses[of(b)]];
    // Both as one lens without distortion would see them.
    let focal = (own[0].focal[0] + own[1].focal[0]) / 2.0;
    let plain = Intrinsics {
        focal: [focal; 2],
        centre: [0.0; 2],
        radial: [0.0; 2],
        ..*own[0]
    };
    let straight = |i: usize, at: [f64; 2]| {
        let p = own[i].undistort(Point2::from(at)) * focal;
        [p.x, p.y]
    };
    let both: Vec<[[f64; 2]; 2]> = seen
        .both(*a, *b)
        .into_iter()
        .map(|(_, [p, q])| [straight(0, p), straight(1, q)])
        .collect();
    let pose = two_views(&plain, &both)?;
    let shot = |photo: &PhotoId, pose| Shot {
        photo: *photo,
        lens: of(photo),
        pose,
        zoom: 0.0,
    };
    let scene = Scene {
        lenses: lenses.to_vec(),
        shots: vec![shot(a, at_origin()), shot(b, pose)],
        ..Scene::default()
    };
    let cameras = [at_origin(), pose].map(|pose| shape::Camera { lens: plain, pose });
    let centres = cameras.map(|c| c.centre());
    let angle = |both: &[[f64; 2]; 2]| {
        let (at, rms) = triangulate(&cameras, &[(0, both[0]), (1, both[1])])?;
        (rms < near_px).then(|| (centres[0] - at).angle(&(centres[1] - at)))
    };
    let angles: Vec<f64> = both.iter().filter_map(angle).collect();
    let worth = angles.iter().map(|a| (a / WIDE_RAD).min(1.0)).sum::<f64>();
    (angles.len() >= LEAST_POINTS && 2 * angles.len() >= both.len()).then_some((worth, scene))
}
