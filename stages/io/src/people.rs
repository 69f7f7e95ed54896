//! People on photos, and what masks lose of them: as JSON, and drawn on the photos.

use crate::marks::{drawn, line};
use nalgebra::Point2;
use serde_json::{Value, json};
use shape::{BodyPart, Found, Joint, LostParts, People, PhotoError, PhotoId, Photos, Rgb};

/// Which joints are drawn as one line, by their places in [`Found::JOINTS`] (structural).
const BONES: [[usize; 2]; 21] = [
    [11, 12],
    [23, 24],
    [11, 23],
    [12, 24],
    [11, 13],
    [13, 15],
    [15, 19],
    [12, 14],
    [14, 16],
    [16, 20],
    [23, 25],
    [25, 27],
    [27, 29],
    [29, 31],
    [24, 26],
    [26, 28],
    [28, 30],
    [30, 32],
    [0, 7],
    [0, 8],
    [9, 10],
];
/// The one who is followed, and anybody else (structural: colours). \[sRGB\]
const FOLLOWED: [u8; 3] = [80, 230, 60];
/// Another person (structural: a colour of the drawing).
const ANOTHER: [u8; 3] = [255, 150, 40];
/// The left side's bones, and the right side's (structural: colours). \[sRGB\]
const LEFT: [u8; 3] = [90, 200, 255];
/// The right one (structural: a colour of the drawing).
const RIGHT: [u8; 3] = [255, 210, 60];

/// Everybody by photo, first who is followed: scores, places and joints; masks are left to the pictures.
pub fn people_to_json(people: &People, photos: &Photos) -> String {
    let joint = |(name, joint): (&str, &Joint)| {
        let [x, y] = joint.at_px;
        json!({ "name": name, "at_px": [x, y], "visibility": joint.visibility, "presence": joint.presence })
    };
    let one = |f: &Found| {
        let joints = Found::JOINTS.into_iter().zip(&f.joints).map(joint);
        json!({
            "score": f.score, "presence": f.presence, "head_px": f.head_px,
            "square": { "centre_px": f.crop.centre_px, "side_px": f.crop.side_px, "angle_deg": f.crop.angle.to_degrees() },
            "joints": joints.collect::<Vec<Value>>(),
        })
    };
    let view = |(id, found): (PhotoId, &Vec<Found>)| {
        let all: Vec<Value> = found.iter().map(one).collect();
        json!({ "photo": id.0, "name": photos.get(id).map(|p| &p.name), "people": all })
    };
    let views: Vec<Value> = people.views.iter().map(view).collect();
    let all = json!({ "person": people.person, "views": views });
    serde_json::to_string_pretty(&all).expect("bug: people JSON cannot hold")
}

/// By part of the body, but for feet, the photos whose masks leave out some of it, and those with body where no person is seen, by name.
pub fn lost_parts_to_json(parts: &LostParts, photos: &Photos) -> String {
    let names = |ids: &[PhotoId]| -> Vec<Value> {
        let name =
            |id: &PhotoId| json!({ "photo": id.0, "name": photos.get(*id).map(|p| &p.name) });
        ids.iter().map(name).collect()
    };
    let part = |part: BodyPart| (part.word().to_owned(), names(parts.of(part)).into());
    let [seen @ .., _feet] = BodyPart::ALL;
    let lost: serde_json::Map<String, Value> = seen.into_iter().map(part).collect();
    let all = json!({ "photos": parts.photos, "lost": lost, "added": names(&parts.added) });
    serde_json::to_string_pretty(&all).expect("bug: lost parts JSON cannot hold")
}

/// Each photo with everybody drawn on it, named as the photo: the border of the coarse mask (green for who is followed),
/// bones blue on the person's left, yellow on the right.
///
/// # Errors
///
/// A photo cannot be decoded.
pub fn people_to_png(
    people: &People,
    photos: &Photos,
) -> Result<Vec<(String, Vec<u8>)>, PhotoError> {
    drawn(photos, |id, picture, by| {
        let found = people.views.get(id).into_iter().flatten();
        for (i, one) in found.enumerate() {
            let followed = i == 0 && people.person;
            mask(picture, by, one, if followed { FOLLOWED } else { ANOTHER });
            for [a, b] in BONES {
                let side = if a % 2 == 1 { LEFT } else { RIGHT };
                let end = |k: usize| one.joints[k].at_px.map(|v| v / by);
                line(picture, end(a), end(b), side);
            }
        }
    })
}

/// The border of a coarse mask.
fn mask(picture: &mut Rgb, by: f32, found: &Found, colour: [u8; 3]) {
    let body = |x: usize, y: usize| {
        let at = Point2::new(x as f64, y as f64) * f64::from(by);
        found.log_odds(at).is_some_and(|odds| odds > 0.0)
    };
    let inside: Vec<bool> = (0..picture.data.len())
        .map(|i| body(i % picture.width, i / picture.width))
        .collect();
    let width = picture.width;
    for i in 0..inside.len() {
        let beside = [(i % width + 1 < width).then_some(i + 1), Some(i + width)];
        let beside = beside.into_iter().flatten().filter_map(|k| inside.get(k));
        if beside.into_iter().any(|b| *b != inside[i]) {
            picture.data[i] = colour;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Crop, Image, Photo, PhotoId, rgb_to_png};

    #[test]
    fn people_are_listed_and_drawn() {
        let photo = Photo::of(
            "a.png",
            [200, 200],
            rgb_to_png(&Rgb::filled(200, 200, [90; 3])),
        );
        let photos = Photos {
            photos: vec![photo],
            ..Photos::default()
        };
        let joint = Joint {
            at_px: [100.0, 90.0],
            visibility: 1.0,
            presence: 1.0,
        };
        let mut body = Image::filled(64, 64, -100i8);
        (32 * 20..32 * 40).for_each(|i| body.data[2 * i] = 100);
        (32 * 20..32 * 40).for_each(|i| body.data[2 * i + 1] = 100);
        let found = Found {
            score: 0.9,
            presence: 0.8,
            head_px: [90.0, 10.0, 110.0, 30.0],
            crop: Crop {
                centre_px: [99.5, 99.5],
                side_px: 128.0,
                angle: 0.0,
            },
            body,
            joints: vec![joint; 33],
        };
        let people = People {
            views: [(PhotoId(0), vec![found])].into_iter().collect(),
            person: true,
        };
        let json: Value = serde_json::from_str(&people_to_json(&people, &photos)).unwrap();
        assert_eq!(json["views"][0]["name"], "a.png");
        let joints = &json["views"][0]["people"][0]["joints"];
        assert_eq!(joints[32]["name"], "right toes");
        let drawn = people_to_png(&people, &photos).unwrap();
        assert_eq!(drawn[0].0, "a.png");
        let plain = people_to_png(&People::default(), &photos).unwrap();
        assert_ne!(drawn[0].1, plain[0].1);
        let mut parts = LostParts::default();
        parts.lost[BodyPart::Legs as usize].push(PhotoId(0));
        let json: Value = serde_json::from_str(&lost_parts_to_json(&parts, &photos)).unwrap();
        assert_eq!(json["lost"]["legs"][0]["name"], "a.png");
        assert_eq!(json["lost"]["head"], json!([]));
    }
}
