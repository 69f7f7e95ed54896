//! What photos and people give: who is followed, through which lens, and where the joints are seen.

use crate::error::MotionError;
use crate::given::{MotionInput, MotionParams};
use crate::joints::Sights;
use nalgebra::Point2;
use shape::{Found, Intrinsics, LEAST_OF_TURN, People, PhotoId, Photos, film_to_px};
use stage::{Message, message};

stage::messages! {
    NO_FOCAL = "warn-turning-focal": "neither the photos nor capture.toml have the focal length: {focal:.0 mm}, as of phones' main cameras, was taken; give --focal";
}

/// The photos that show the person, and have a mask where there are some.
pub(crate) fn followed(input: &MotionInput) -> Result<Vec<PhotoId>, MotionError> {
    let masked = |id: PhotoId| {
        input
            .masks
            .as_ref()
            .is_none_or(|m| m.views.get(id).is_some())
    };
    let all = input.photos.iter().map(|(id, _)| id);
    let seen = all.filter(|id| input.people.subject(*id).is_some() && masked(*id));
    let ids: Vec<PhotoId> = seen.collect();
    match ids.len() {
        n if n < LEAST_OF_TURN => Err(MotionError::NoPerson {
            seen: n,
            of: input.photos.photos.len(),
            least: LEAST_OF_TURN,
        }),
        _ => Ok(ids),
    }
}

/// The lens, as EXIF or the user have it; else as phones', and a warning.
pub(crate) fn lens(
    p: &MotionParams,
    photos: &Photos,
) -> Result<(Intrinsics, Option<Message>), MotionError> {
    let first = photos.photos.first().ok_or(MotionError::NoPerson {
        seen: 0,
        of: 0,
        least: LEAST_OF_TURN,
    })?;
    let (width, height) = (first.width, first.height);
    let film = |mm: f64| film_to_px(mm, width, height);
    let known = photos.rig.focal_px;
    let known = known.or(photos.rig.focal_35mm.or(first.focal_35mm).map(film));
    let unknown = known
        .is_none()
        .then(|| message!(NO_FOCAL, focal = p.focal_35mm));
    let mut lens = Intrinsics::simple(width, height, known.unwrap_or_else(|| film(p.focal_35mm)));
    if let Some(centre) = photos.rig.centre_px {
        lens.centre = centre;
    }
    Ok((lens, unknown))
}

/// How far beyond the photo's border a joint is taken as the network guesses it, as a share of the photo's size: of a
/// body that is cut off at the hips, hips are a guess that is worth more than none. By hand: not on record.
const BEYOND_SHARE: f64 = 0.25;

/// All joints in the photo or little beyond its border, on the plane z = 1.
pub(crate) fn sights(people: &People, ids: &[PhotoId], lens: &Intrinsics) -> Sights {
    let (w, h) = (f64::from(lens.width), f64::from(lens.height));
    let sight = |id: &PhotoId, joint: usize| {
        let [x, y] = people.subject(*id)?.joints[joint].at_px.map(f64::from);
        let near =
            |at: f64, size: f64| at >= -BEYOND_SHARE * size && at < (1.0 + BEYOND_SHARE) * size;
        let inside = near(x, w) && near(y, h);
        inside.then(|| lens.undistort(Point2::new(x, y)))
    };
    (0..Found::JOINTS.len())
        .map(|joint| ids.iter().map(|id| sight(id, joint)).collect())
        .collect()
}

/// Places of wrists and fingers, structural: hands move by themselves.
const HANDS: std::ops::RangeInclusive<usize> = 15..=22;
/// The sights without those of hands.
pub(crate) fn without_hands(sights: &Sights) -> Sights {
    let mut used = sights.clone();
    for joint in HANDS {
        used[joint].iter_mut().for_each(|s| *s = None);
    }
    used
}
