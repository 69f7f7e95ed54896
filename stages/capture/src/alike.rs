//! Whether the photos of a turn are alike: one size, one camera, one focal length, no photo twice.

use crate::error::CaptureError;
use shape::Photo;

/// All of one size, no two equal.
pub(crate) fn alike(photos: &[Photo], plate: Option<&Photo>) -> Result<(), CaptureError> {
    let size = |p: &Photo| format!("{}×{} pixels", p.width, p.height);
    let first = &photos[0];
    for photo in photos.iter().chain(plate) {
        if (photo.width, photo.height) != (first.width, first.height) {
            return Err(CaptureError::Size {
                name: photo.name.clone(),
                size: size(photo),
                first: first.name.clone(),
                first_size: size(first),
            });
        }
    }
    for (i, a) in photos.iter().enumerate() {
        if let Some(b) = photos[i + 1..].iter().find(|b| b.file == a.file) {
            return Err(CaptureError::Twin(a.name.clone(), b.name.clone()));
        }
    }
    Ok(())
}

/// The first photo that was taken before the one in front of it; photos that tell no time are
/// passed over.
pub(crate) fn out_of_order(photos: &[Photo]) -> Option<String> {
    let timed = photos.iter().filter_map(|p| Some((&p.name, p.time_s?)));
    let timed: Vec<_> = timed.collect();
    let late = timed.windows(2).find(|w| w[0].1 > w[1].1)?;
    let (a, b) = (late[0].0, late[1].0);
    Some(format!(
        "{b} was taken before {a}: names should be in turning order"
    ))
}

/// Focal lengths that differ by more than this share are two.
const ZOOM: f64 = 0.01;

/// Photos that another camera took than most, or the same one zoomed otherwise, as EXIF tells.
pub(crate) fn other_cameras(photos: &[Photo]) -> Vec<String> {
    let devices: Vec<&str> = photos.iter().map(|p| p.device.as_str()).collect();
    let usual = most(&devices, |a, b| a == b);
    let focals: Vec<f64> = photos.iter().filter_map(|p| p.focal_35mm).collect();
    let focal = most(&focals, |a, b| (a / b - 1.0).abs() < ZOOM);
    let mut said = Vec::new();
    for photo in photos {
        let (name, device) = (&photo.name, photo.device.as_str());
        if let Some(usual) = usual.filter(|u| !device.is_empty() && !u.is_empty() && **u != device)
        {
            said.push(format!(
                "{name} was taken with another camera ({device}) than most photos ({usual}): one camera must take all of a turn; take it again, or remove it"
            ));
        }
        if let (Some(own), Some(focal)) = (photo.focal_35mm, focal)
            && (own / focal - 1.0).abs() > ZOOM
        {
            said.push(format!(
                "{name} was taken at {own:.1} mm, most photos at {focal:.1} mm: do not zoom during a turn; take it again, or remove it"
            ));
        }
    }
    said
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
    use std::sync::Arc;

    fn photo(name: &str, device: &str, focal_35mm: Option<f64>) -> Photo {
        Photo {
            name: name.into(),
            width: 4,
            height: 4,
            orientation: 1,
            focal_35mm,
            device: device.into(),
            time_s: None,
            file: Arc::from([]),
        }
    }

    #[test]
    fn another_camera_and_a_zoom_are_told_by_photo() {
        let photos = [
            photo("a", "Sony 7", Some(50.0)),
            photo("b", "Canon 6D", Some(50.0)),
            photo("c", "Canon 6D", Some(70.0)),
            photo("d", "Canon 6D", Some(50.1)),
            photo("e", "", None),
        ];
        let said = other_cameras(&photos);
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(said[0].starts_with("a was taken with another camera (Sony 7)"));
        assert!(said[1].starts_with("c was taken at 70.0 mm, most photos at 50"));
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
        let told = out_of_order(&photos).unwrap();
        assert!(told.starts_with("c was taken before a"), "{told}");
    }
}
