//! Parts of the body that look like the empty scene along the outline: there no colour shows where the body ends.

use crate::likelihood::body::STRANGE;
use crate::raster::as_mask;
use rayon::prelude::*;
use shape::{
    BodyPart, Evidence, Found, Image, Label, Labels, People, PhotoEvidence, PhotoId, Photos,
    signed_distance, some_photos,
};
use stage::{Message, message};

stage::messages! {
    LIKE_SCENE = "warn-like-scene": "{part} and empty scene look alike along the outline on {names}: masks may leave out body there, or keep some of the scene; look at these masks, and wear another colour";
}

/// A part whose edge looks like the scene deeper than this on the mean is named: a pixel, structural, for the borders of labels are no finer.
/// \[px of the reduced photo\]
const DEEPEST: f64 = 1.0;

/// What to look at, by part of the body.
pub(crate) fn like_scene(
    photos: &Photos,
    evidence: &Evidence,
    labels: &Labels,
    people: &People,
) -> Vec<Message> {
    let one = |(id, label): &(PhotoId, Label)| {
        let (found, evidence) = people.subject(*id).zip(evidence.views.get(*id))?;
        Some((
            photos.get(*id)?.name.clone(),
            depths(found, evidence, &label.body),
        ))
    };
    let views = labels.views.as_slice().par_iter();
    let all: Vec<(String, [f64; 5])> = views.filter_map(one).collect();
    let warning = |part: BodyPart| {
        let alike = all.iter().filter(|(_, deep)| deep[part as usize] > DEEPEST);
        let names: Vec<String> = alike.map(|(name, _)| name.clone()).collect();
        let names = some_photos(&names)?;
        Some(message!(LIKE_SCENE, part = part.word(), names = names))
    };
    BodyPart::ALL.into_iter().filter_map(warning).collect()
}

/// Within so many reduced pixels the network parts nothing: two of its own. \[px\]
fn reach(found: &Found, factor: usize) -> usize {
    (2.0 * found.pixel_px() / factor as f32).ceil() as usize
}

/// By part, how deep the edge of a mask looks like the scene on the mean, rather than like a body of unknown colours. The
/// edge is as wide as a learned outline, but for its first pixel, which is mixed. \[px of the reduced photo\]
fn depths(found: &Found, evidence: &PhotoEvidence, body: &Image<bool>) -> [f64; 5] {
    let factor = evidence.factor as usize;
    let wide = reach(found, factor);
    let depth = signed_distance(&as_mask(body)).data;
    let on_photo = |v: usize| (v * factor) as f32 + (factor - 1) as f32 / 2.0;
    let (mut edge, mut alike) = ([0usize; 5], [0usize; 5]);
    for (i, odds) in evidence.log_odds(STRANGE as f32).enumerate() {
        let on_edge = depth[i] > 1.0 && depth[i] <= 1.0 + wide as f32;
        if odds.is_finite() && on_edge {
            let at = [i % body.width, i / body.width].map(on_photo);
            let part = found.part_at(at) as usize;
            edge[part] += 1;
            alike[part] += usize::from(odds > 0.0);
        }
    }
    std::array::from_fn(|part| (wide * alike[part]) as f64 / edge[part].max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::raster;
    use shape::{Crop, Joint, Known, Photo, Rgb};

    const SIDE: usize = 120;

    /// Somebody whose trunk is the middle of the photo, with legs below.
    fn found() -> Found {
        let mut at = [[60.0, 5.0]; 33];
        for (joint, place) in [(11, [75.0, 30.0]), (12, [45.0, 30.0]), (23, [70.0, 60.0])] {
            at[joint] = place;
        }
        at[24] = [50.0, 60.0];
        (13..23).for_each(|k| at[k] = [200.0, 30.0]);
        (25..33).for_each(|k| at[k] = [if k % 2 == 1 { 70.0 } else { 50.0 }, 110.0]);
        Found {
            crop: Crop {
                centre_px: [60.0, 60.0],
                side_px: 128.0,
                angle: 0.0,
            },
            body: Image::filled(64, 64, 0),
            joints: at
                .map(|at_px| Joint {
                    at_px,
                    visibility: 1.0,
                    presence: 1.0,
                })
                .to_vec(),
            ..Found::default()
        }
    }

    /// A photo whose body costs the scene so much in rows 30 to 60, and much elsewhere.
    fn evidence(garment: f32) -> PhotoEvidence {
        let cost = |i: usize| match i / SIDE {
            30..60 => garment,
            _ => 28.0,
        };
        PhotoEvidence {
            factor: 1,
            photo: Rgb::filled(SIDE, SIDE, [0; 3]),
            background: (0..SIDE * SIDE).map(cost).collect(),
            against_ground: vec![],
            mirrored: vec![],
            person: vec![],
            known: vec![Known::Unknown; SIDE * SIDE],
            noise_levels: 1.0,
        }
    }

    #[test]
    fn a_shirt_of_the_walls_colour_is_named_by_photo_and_part_and_no_other_is() {
        let body = |i: usize| (45..75).contains(&(i % SIDE)) && (20..115).contains(&(i / SIDE));
        let label = Label {
            body: raster(SIDE, SIDE, (0..SIDE * SIDE).map(body).collect()),
            known: vec![Known::Unknown; SIDE * SIDE],
            body_colors: vec![],
            background_colors: vec![],
        };
        let ids = || (0..2).map(PhotoId);
        let photo = |id: PhotoId| {
            Photo::of(
                format!("{}.jpg", id.0),
                [SIDE as u32, SIDE as u32],
                Vec::new(),
            )
        };
        let photos = Photos {
            photos: ids().map(photo).collect(),
            ..Photos::default()
        };
        let labels = Labels {
            views: ids().map(|id| (id, label.clone())).collect(),
        };
        let evidence = Evidence {
            views: ids().zip([28.0, 6.0].map(evidence)).collect(),
        };
        let mut people = People {
            views: ids().map(|id| (id, vec![found()])).collect(),
            person: true,
        };
        let warned = |people: &People| -> Vec<String> {
            let all = like_scene(&photos, &evidence, &labels, people);
            all.iter().map(Message::to_string).collect()
        };
        let named = warned(&people);
        assert!(
            named.len() == 1 && named[0].starts_with("trunk"),
            "{named:?}"
        );
        assert!(
            named[0].contains("1.jpg") && !named[0].contains("0.jpg"),
            "{named:?}"
        );
        people.person = false;
        assert!(warned(&people).is_empty(), "a thing has no parts");
    }
}
