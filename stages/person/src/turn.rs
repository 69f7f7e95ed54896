//! What the photos of a turn show together: who is followed, and whether it is a person.

use crate::same::{PRESENT, alike, middle, overlap, present, within};
use shape::{ByPhoto, Crop, Found, PhotoId};

/// So many of the photos must show the same person. By hand: looked at the live man and woman, three made bodies, the
/// mannequin and a marble David, of which all photos do, a draped statue on a pedestal, 15 of 25, a squirrel, 21 of 36,
/// and a temple, 1 of 16.
const LEAST_SHARE: f64 = 0.75;
/// Whoever is on most photos, and on three in four of those surely, is looked for on the rest (structural: a majority): the first network
/// misses those whose head is cut off, or who are seen from far above, from the side.
const MOST_SHARE: f64 = 0.5;
/// The network is sure from here on. By hand: looked at the same captures and nine made ones: three in four photos of a person reach
/// 0.991 and more, of the statue 0.95, of the squirrel 0.69.
const SURE: f32 = 0.99;
/// Shoulders in [`Found::JOINTS`], structural.
const SHOULDERS: [usize; 2] = [11, 12];

/// Who is on the photos of a turn.
#[derive(Debug, Default)]
pub(crate) struct Followed {
    /// Of each photo: first the one who is followed, then whoever else is seen, if the followed one is; else nobody.
    pub(crate) views: ByPhoto<Vec<Found>>,
    /// Whether the one who is followed is a person.
    pub(crate) person: bool,
    /// Photos that show somebody else.
    pub(crate) beside: Vec<PhotoId>,
}

/// Follows the one who turns: of those whom most photos show in the same place the one whose shoulders change most in width,
/// as seen, from photo to photo. Whoever is beside, hangs on the wall or is on a screen shows the same side on all.
pub(crate) fn followed(views: ByPhoto<Vec<Found>>) -> Followed {
    let views: Vec<(PhotoId, Vec<Found>)> = views.iter().map(|(id, f)| (id, f.clone())).collect();
    let tracks = tracks(&views);
    let Some(most) = turning_most(&tracks, &views, LEAST_SHARE) else {
        return Followed {
            views: views.into_iter().collect(),
            ..Followed::default()
        };
    };
    let places = places(most, &tracks, views.len());
    let mut all = Followed {
        person: true,
        ..Followed::default()
    };
    let one = |((id, mut found), place): ((PhotoId, Vec<Found>), Option<usize>)| {
        let near = place.map_or(most.middle, |k| found[k].crop);
        if found.iter().any(|f| present(f) && !alike(&f.crop, &near)) {
            all.beside.push(id);
        }
        match place {
            Some(k) => found[..=k].rotate_right(1),
            None => found.clear(),
        }
        (id, found)
    };
    all.views = views.into_iter().zip(places).map(one).collect();
    all
}

/// The one who turns, for photos on which that one is not found.
pub(crate) struct NotFound {
    /// The places of these photos among all, and how surely at least the network must see that one there: as somebody rather than
    /// nothing; where it saw somebody within that square already, as likely as not.
    pub(crate) photos: Vec<(usize, f32)>,
    /// Where that one is on all the rest.
    pub(crate) square: Crop,
}

/// Nothing where no one is on most photos.
pub(crate) fn not_found(views: &[(PhotoId, Vec<Found>)]) -> Option<NotFound> {
    let tracks = tracks(views);
    let most = turning_most(&tracks, views, LEAST_SHARE);
    let surely = || turning_most(&tracks, views, MOST_SHARE).filter(|track| is_sure(track, views));
    let most = most.or_else(surely)?;
    let found = |photo: &usize| most.seen.iter().any(|(seen, _)| seen == photo);
    let presence = |(photo, k): &(usize, usize)| views[*photo].1[*k].presence;
    let least = most.seen.iter().map(presence).fold(1.0, f32::min);
    let part = |f: &Found| present(f) && within(&f.crop, &most.middle);
    let bound = |photo: usize| match views[photo].1.iter().any(part) {
        true => (photo, PRESENT),
        false => (photo, least),
    };
    let missing = (0..views.len()).filter(|photo| !found(photo));
    Some(NotFound {
        photos: missing.map(bound).collect(),
        square: most.middle,
    })
}

/// Of those whom such a share of the photos show in the same place the one whose shoulders change most in width.
fn turning_most<'a>(
    tracks: &'a [Track],
    views: &[(PhotoId, Vec<Found>)],
    share: f64,
) -> Option<&'a Track> {
    let least = (share * views.len() as f64).max(1.0);
    let often = tracks
        .iter()
        .filter(|track| track.seen.len() as f64 >= least);
    often.max_by(|a, b| turning(a, views).total_cmp(&turning(b, views)))
}

/// Whether three in four of the photos that show somebody do so surely.
fn is_sure(track: &Track, views: &[(PhotoId, Vec<Found>)]) -> bool {
    let presence = |(photo, k): &(usize, usize)| views[*photo].1[*k].presence;
    let sure = track.seen.iter().filter(|one| presence(one) >= SURE);
    sure.count() as f64 >= LEAST_SHARE * track.seen.len() as f64
}

/// Where the one who is followed is among those who are found, photo by photo. Whoever is never seen on a photo with that
/// one is the same, elsewhere: cut off, or upside down.
fn places(most: &Track, tracks: &[Track], photos: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; photos];
    for track in std::iter::once(most).chain(tracks) {
        if track.seen.iter().all(|(photo, _)| places[*photo].is_none()) {
            track
                .seen
                .iter()
                .for_each(|(photo, k)| places[*photo] = Some(*k));
        }
    }
    places
}

/// Somebody whom photos show in the same place.
struct Track {
    middle: Crop,
    /// Photo, and the place among those who are found on it.
    seen: Vec<(usize, usize)>,
}

/// Everybody, each from the surest square on that nobody has yet.
fn tracks(views: &[(PhotoId, Vec<Found>)]) -> Vec<Track> {
    let mut open: Vec<(usize, usize)> = (0..views.len())
        .flat_map(|photo| (0..views[photo].1.len()).map(move |k| (photo, k)))
        .filter(|(photo, k)| present(&views[*photo].1[*k]))
        .collect();
    let crop = |(photo, k): &(usize, usize)| views[*photo].1[*k].crop;
    let mut tracks = vec![];
    while let Some(first) = open.first() {
        let mut track = Track {
            middle: crop(first),
            seen: vec![],
        };
        // Once around the first, once around the middle of those.
        for _ in 0..2 {
            track.seen = nearest(&open, &crop, &track.middle);
            let squares: Vec<Crop> = track.seen.iter().map(crop).collect();
            track.middle = middle(&squares).unwrap_or(track.middle);
        }
        let first = *first;
        open.retain(|one| *one != first && !track.seen.contains(one));
        tracks.push(track);
    }
    tracks
}

/// Of each photo the square that is most alike to another, if it is one person's.
fn nearest(
    open: &[(usize, usize)],
    crop: &dyn Fn(&(usize, usize)) -> Crop,
    to: &Crop,
) -> Vec<(usize, usize)> {
    let mut seen: Vec<(usize, usize)> = vec![];
    for one in open.iter().filter(|one| alike(&crop(one), to)) {
        match seen.last_mut() {
            Some(last) if last.0 == one.0 => {
                if overlap(&crop(one), to) > overlap(&crop(last), to) {
                    *last = *one;
                }
            }
            _ => seen.push(*one),
        }
    }
    seen
}

/// How much the width of somebody's shoulders changes over the photos: its standard deviation, left for right
/// or not, for of a back the network may take one for the other. \[px\]
fn turning(track: &Track, views: &[(PhotoId, Vec<Found>)]) -> f64 {
    let wide = |(photo, k): &(usize, usize)| {
        let [left, right] = SHOULDERS.map(|j| views[*photo].1[*k].joints[j].at_px[0]);
        f64::from((left - right).abs())
    };
    let all: Vec<f64> = track.seen.iter().map(wide).collect();
    let count = all.len().max(1) as f64;
    let mean = all.iter().sum::<f64>() / count;
    (all.iter().map(|w| (w - mean) * (w - mean)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests;
