//! What photos near each other in a turn have in common, from tracks.

use crate::ring::start::Pair;
use nalgebra::Vector2;
use shape::{Observation, Tracks};

/// How far apart in the turn photos are compared (derived: over so many steps features are followed).
const PHOTOS_APART: usize = 3;
/// Fewest features that hold a camera, or that a pair of photos has in common. By hand: looked at two captures, halved
/// and doubled: nothing changes, for both have enough (docs/lab/numbers.md).
pub(crate) const LEAST_FEATURES: usize = 12;

/// The pairs of photos with enough in common, pixels from the photo's middle; the turn may close. Features that move by
/// at most `still_px` belong to what does not turn.
pub(crate) fn pairs(tracks: &Tracks, photos: usize, middle: [f64; 2], still_px: f64) -> Vec<Pair> {
    let mut seen: Vec<Vec<[Vector2<f64>; 2]>> = vec![Vec::new(); photos * photos];
    let centred = |at: [f32; 2]| {
        let at = at.map(f64::from);
        Vector2::new(at[0] - middle[0], at[1] - middle[1])
    };
    for track in &tracks.points {
        for (k, a) in track.iter().enumerate() {
            for b in &track[k + 1..] {
                let (i, j) = (a.photo.0.min(b.photo.0), a.photo.0.max(b.photo.0));
                let (i, j) = (i as usize, j as usize);
                let gap = j - i;
                if j >= photos || gap == 0 || gap.min(photos - gap) > PHOTOS_APART {
                    continue;
                }
                let (first, second) = if a.photo <= b.photo { (a, b) } else { (b, a) };
                let both = [centred(first.at_px), centred(second.at_px)];
                if (both[0] - both[1]).norm() > still_px {
                    seen[i * photos + j].push(both);
                }
            }
        }
    }
    seen.into_iter()
        .enumerate()
        .filter(|(_, seen)| seen.len() >= LEAST_FEATURES)
        .map(|(at, seen)| Pair {
            from: at / photos,
            to: at % photos,
            seen,
        })
        .collect()
}

/// At most `most` tracks, longer ones first, spread over all.
pub(crate) fn chosen(tracks: &Tracks, most: usize) -> Tracks {
    let mut order: Vec<usize> = (0..tracks.points.len()).collect();
    order.sort_by_key(|i| {
        let long = tracks.points[*i].len().min(6);
        (
            std::cmp::Reverse(long),
            (*i as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15),
        )
    });
    order.truncate(most);
    order.sort_unstable();
    let points: Vec<Vec<Observation>> = order.iter().map(|i| tracks.points[*i].clone()).collect();
    Tracks { points }
}
