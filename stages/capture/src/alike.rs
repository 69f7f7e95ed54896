//! Whether the photos of a turn are alike: one size, one camera, one focal length, one turn.

use crate::error::CaptureError;
use shape::{LEAST_OF_TURN, Photo};
use stage::{Message, message};

stage::messages! {
    TWO_TURNS = "warn-two-turns": "between {last} and {first} passed {pause:.0 s}, else {usual:.0 s}: are these two turns? Put each into a folder of its own, or list the photos of the turn: `images = [\"…\"]` in capture.toml, or --images";
    LATE = "warn-order": "{early} was taken before {late}: names should be in turning order";
    OTHER_CAMERA = "warn-other-camera": "{name} was taken with another camera ({camera}) than most photos ({usual}): one camera must take all of a turn; take it again, or remove it";
    ZOOMED = "warn-zoomed": "{name} was taken at {focal:.1 mm}, most photos at {usual:.1 mm}: do not zoom during a turn; take it again, or remove it";
}

/// All of one size, the plate, too.
pub(crate) fn one_size(photos: &[Photo], plate: Option<&Photo>) -> Result<(), CaptureError> {
    let size = |p: &Photo| format!("{}×{} pixels", p.width, p.height);
    let of = |p: &Photo| (p.width, p.height);
    let sizes: Vec<_> = photos.iter().map(of).collect();
    let Some(usual) = most(&sizes, |a, b| a == b).copied() else {
        return Ok(());
    };
    let all = || photos.iter().chain(plate);
    let odd: Vec<&Photo> = all().filter(|p| of(p) != usual).collect();
    let Some(first) = all().find(|p| of(p) == usual).filter(|_| !odd.is_empty()) else {
        return Ok(());
    };
    let turned = |p: &Photo| match (p.height, p.width) == usual {
        true => ", on its side",
        false => "",
    };
    let mut named: Vec<String> = odd
        .iter()
        .take(SHOWN)
        .map(|p| format!("{} is {}{}", p.name, size(p), turned(p)))
        .collect();
    if odd.len() > SHOWN {
        named.push(format!("and {} more", odd.len() - SHOWN));
    }
    Err(CaptureError::Size {
        most: sizes.iter().filter(|s| **s == usual).count(),
        size: size(first),
        odd: named.join(", "),
    })
}

/// So many photos are named, more are counted (structural: length of a message).
const SHOWN: usize = 4;

/// What speaks against photos being one turn of one camera, in order.
pub(crate) fn not_one_turn(photos: &[Photo]) -> Vec<Message> {
    let mut warnings = other_cameras(photos);
    warnings.extend(out_of_order(photos));
    warnings.extend(two_turns(photos));
    warnings
}

/// A pause between two turns is so many times longer than that between photos, and at least so long. By hand: not on
/// record. \[1, s\]
const PAUSE_BEYOND: (f64, f64) = (6.0, 45.0);

/// Where the folder may hold two turns: a long pause with enough photos before and after it.
fn two_turns(photos: &[Photo]) -> Option<Message> {
    let times: Vec<f64> = photos.iter().map(|p| p.time_s).collect::<Option<_>>()?;
    let pauses: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    let usual = &shape::upper_median(&pauses)?;
    let at = pauses
        .iter()
        .position(|pause| *pause > (PAUSE_BEYOND.0 * usual).max(PAUSE_BEYOND.1))?;
    let (before, after) = (at + 1, photos.len() - at - 1);
    (before.min(after) >= LEAST_OF_TURN).then(|| {
        let [last, first] = [at, at + 1].map(|i| &photos[i].name);
        message!(
            TWO_TURNS,
            last = last,
            first = first,
            pause = pauses[at],
            usual = usual
        )
    })
}

/// The first photo that was taken before the one in front of it; photos without a time are
/// passed over.
fn out_of_order(photos: &[Photo]) -> Option<Message> {
    let timed = photos.iter().filter_map(|p| Some((&p.name, p.time_s?)));
    let timed: Vec<_> = timed.collect();
    let late = timed.windows(2).find(|w| w[0].1 > w[1].1)?;
    let (a, b) = (late[0].0, late[1].0);
    Some(message!(LATE, early = b, late = a))
}

/// Focal lengths that differ by more than this share are two. By hand: not on record.
const ZOOM_SHARE: f64 = 0.01;

/// Photos that another camera took than most, or the same one zoomed otherwise, by EXIF.
fn other_cameras(photos: &[Photo]) -> Vec<Message> {
    let devices: Vec<&str> = photos.iter().map(|p| p.device.as_str()).collect();
    let usual = most(&devices, |a, b| a == b);
    let focals: Vec<f64> = photos.iter().filter_map(|p| p.focal_35mm).collect();
    let focal = most(&focals, |a, b| (a / b - 1.0).abs() < ZOOM_SHARE);
    let mut warnings = Vec::new();
    for photo in photos {
        let (name, device) = (&photo.name, photo.device.as_str());
        if let Some(usual) = usual.filter(|u| !device.is_empty() && !u.is_empty() && **u != device)
        {
            let (camera, usual) = (device, *usual);
            warnings.push(message!(
                OTHER_CAMERA,
                name = name,
                camera = camera,
                usual = usual
            ));
        }
        if let (Some(own), Some(focal)) = (photo.focal_35mm, focal)
            && (own / focal - 1.0).abs() > ZOOM_SHARE
        {
            warnings.push(message!(ZOOMED, name = name, focal = own, usual = focal));
        }
    }
    warnings
}

/// The one that most are like; none of nothing.
fn most<T>(all: &[T], like: impl Fn(&T, &T) -> bool) -> Option<&T> {
    let count = |a: &T| all.iter().filter(|b| like(a, b)).count();
    // The first of those with the highest count.
    all.iter().rev().max_by_key(|a| count(a))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photo(name: &str, device: &str, focal_35mm: Option<f64>) -> Photo {
        Photo {
            focal_35mm,
            device: device.into(),
            ..Photo::of(name, [4, 4], Vec::new())
        }
    }

    #[test]
    fn another_camera_and_a_zoom_are_named_by_photo() {
        let photos = [
            photo("a", "Sony 7", Some(50.0)),
            photo("b", "Canon 6D", Some(50.0)),
            photo("c", "Canon 6D", Some(70.0)),
            photo("d", "Canon 6D", Some(50.1)),
            photo("e", "", None),
        ];
        let warnings = other_cameras(&photos);
        assert_eq!(warnings.len(), 2, "{warnings:?}");
        assert!(warnings[0].starts_with("a was taken with another camera (Sony 7)"));
        assert!(warnings[1].starts_with("c was taken at 70.0 mm, most photos at 50"));
    }

    #[test]
    fn sizes_are_named_with_what_to_do_and_a_long_pause_as_two_turns() {
        let mut photos: Vec<Photo> = (0..20)
            .map(|i| Photo {
                time_s: Some(f64::from(i) * 3.0 + if i < 9 { 0.0 } else { 300.0 }),
                ..photo(&format!("{i}.jpg"), "", None)
            })
            .collect();
        assert!(one_size(&photos, None).is_ok());
        let warning = two_turns(&photos).unwrap();
        assert!(
            warning.starts_with("between 8.jpg and 9.jpg passed 303 s, else 3 s"),
            "{warning}"
        );
        assert_eq!(two_turns(&photos[2..]), None, "seven photos are no turn");
        (photos[0].width, photos[0].height) = (3, 4);
        photos[7].width = 9;
        let plate = Photo {
            height: 3,
            ..photo("plate.jpg", "", None)
        };
        let error = one_size(&photos, Some(&plate)).unwrap_err().to_string();
        for part in [
            "18 are 4×4",
            "0.jpg is 3×4",
            "7.jpg is 9×4",
            "plate.jpg is 4×3",
            "--images",
        ] {
            assert!(error.contains(part), "{part}: {error}");
        }
    }

    #[test]
    fn a_photo_without_a_time_is_not_late() {
        let at = |name, time_s| Photo {
            time_s,
            ..photo(name, "", None)
        };
        let photos = [at("a", Some(0.0)), at("b", None), at("c", Some(20.0))];
        assert_eq!(out_of_order(&photos), None);
        let photos = [at("a", Some(30.0)), at("b", None), at("c", Some(20.0))];
        let warning = out_of_order(&photos).unwrap();
        assert!(warning.starts_with("c was taken before a"), "{warning}");
    }
}
