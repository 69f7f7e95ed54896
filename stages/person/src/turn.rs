//! What the photos of a turn show together: who is followed, and whether it is a person.

use crate::same::{PRESENT, alike, middle, overlap, present, within};
use shape::{ByPhoto, Crop, Found, PhotoId};

/// So many of the photos must show the same person. By hand: looked at the live man and woman, three made bodies, the
/// mannequin and a marble David, of which all photos do, a draped statue on a pedestal, 15 of 25, a squirrel, 21 of 36,
/// and a temple, 1 of 16.
const LEAST_SHARE: f64 = 0.75;
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
    let Some(most) = turning_most(&tracks, &views) else {
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
    let most = turning_most(&tracks, views)?;
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

/// Of those whom most photos show in the same place the one whose shoulders change most in width.
fn turning_most<'a>(tracks: &'a [Track], views: &[(PhotoId, Vec<Found>)]) -> Option<&'a Track> {
    let least = (LEAST_SHARE * views.len() as f64).max(1.0);
    let often = tracks
        .iter()
        .filter(|track| track.seen.len() as f64 >= least);
    often.max_by(|a, b| turning(a, views).total_cmp(&turning(b, views)))
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
mod tests {
    use super::*;
    use shape::{Image, Joint};

    fn found(x: f32, side: f32, score: f32, presence: f32) -> Found {
        let joint = Joint {
            at_px: [x, 500.0],
            visibility: 1.0,
            presence: 1.0,
        };
        Found {
            score,
            presence,
            head_px: [0.0; 4],
            crop: Crop {
                centre_px: [x, 500.0],
                side_px: side,
                angle: 0.0,
            },
            body: Image::filled(0, 0, 0),
            joints: vec![joint; 33],
        }
    }

    fn turn(of: impl Fn(u32) -> Vec<Found>) -> ByPhoto<Vec<Found>> {
        (0..12).map(|i| (PhotoId(i), of(i))).collect()
    }

    #[test]
    fn the_one_on_the_axis_is_followed_past_a_surer_bystander() {
        let views = turn(|i| match i {
            3 | 4 => vec![
                found(900.0 + i as f32, 700.0, 0.99, 0.99),
                found(402.0, 810.0, 0.8, 0.9),
            ],
            _ => vec![found(400.0 + i as f32, 800.0, 0.9, 0.99)],
        });
        let Followed {
            views,
            person,
            beside,
        } = followed(views);
        assert!(person);
        assert!(views.values().all(|f| f[0].crop.centre_px[0] < 420.0));
        assert_eq!(views.get(PhotoId(3)).unwrap().len(), 2);
        assert_eq!(beside, [PhotoId(3), PhotoId(4)]);
    }

    #[test]
    fn who_is_not_found_on_a_photo_is_to_be_looked_for_where_most_photos_show_that_one() {
        let views = turn(|i| match i {
            7 => vec![found(900.0, 500.0, 0.6, 0.95)],
            9 => vec![],
            11 => vec![found(430.0, 400.0, 0.6, 0.8)],
            _ => vec![found(400.0 + i as f32, 800.0, 0.9, 0.99)],
        });
        let views: Vec<_> = views.iter().map(|(id, f)| (id, f.clone())).collect();
        let missing = not_found(&views).unwrap();
        // On the third the network took the upper half of that one for all.
        assert_eq!(missing.photos, [(7, 0.99), (9, 0.99), (11, PRESENT)]);
        assert!((400.0..412.0).contains(&missing.square.centre_px[0]));
        assert!(not_found(&views[7..10]).is_none(), "one of three is nobody");
    }

    /// Somebody whose shoulders are so wide. \[px\]
    fn faces(x: f32, score: f32, wide: f32) -> Found {
        let mut found = found(x, 800.0, score, 0.99);
        found.joints[11].at_px[0] = x + wide / 2.0;
        found.joints[12].at_px[0] = x - wide / 2.0;
        found
    }

    #[test]
    fn the_one_who_turns_is_followed_past_one_who_is_surer_on_all_photos() {
        let turned = |i: u32| 160.0 * libm::cosf(i as f32 * std::f32::consts::TAU / 12.0);
        // The one beside is seen from behind: the network takes his left for his right on every second photo.
        let beside = |i: u32| {
            faces(
                1300.0,
                0.99,
                if i.is_multiple_of(2) { 150.0 } else { -158.0 },
            )
        };
        let views = turn(|i| match i {
            5 => vec![beside(i)],
            _ => vec![beside(i), faces(400.0, 0.7, turned(i))],
        });
        let Followed {
            views,
            person,
            beside,
        } = followed(views);
        assert!(person && beside.len() == 12);
        let first = |i: u32| views.get(PhotoId(i)).unwrap().first();
        assert!(first(5).is_none(), "who is not followed is nobody");
        assert!(
            (0..12)
                .filter_map(first)
                .all(|f| f.crop.centre_px[0] < 420.0)
        );
    }

    #[test]
    fn what_is_seen_here_and_there_is_no_person() {
        let jumps = turn(|i| vec![found(100.0 * (i % 5) as f32, 300.0, 0.9, 0.9)]);
        assert!(!followed(jumps).person);
        let seldom = turn(|i| match i % 2 {
            0 => vec![found(400.0, 800.0, 0.9, 0.99)],
            _ => vec![],
        });
        assert!(!followed(seldom).person);
        let unsure = turn(|_| vec![found(400.0, 800.0, 0.9, 0.2)]);
        assert!(!followed(unsure).person);
        assert!(!followed(ByPhoto::default()).person);
    }
}
