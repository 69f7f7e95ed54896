//! What a photo's file records of the camera. Places and names of people are never read.

use exif::{In, Tag, Value};
use std::io::Cursor;
use std::ops::RangeInclusive;

/// Focal lengths on film that a camera for people may have (structural: from beyond the widest to beyond the longest
/// lens that shows a whole person within a house; some files have 0 or 65 535 for "unknown"). \[mm\]
const FOCALS_MM: RangeInclusive<f64> = 10.0..=300.0;

/// What was found; all of it may be missing.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Exif {
    /// How to turn the pixels upright, 1..=8; 1 where unknown.
    pub orientation: u8,
    /// Focal length as if on 36 × 24 mm film. \[mm\]
    pub focal_35mm: Option<f64>,
    /// Make and model.
    pub device: String,
    /// When it was taken, seconds since some midnight. \[s\]
    pub time_s: Option<f64>,
}

/// Reads the EXIF of a file's bytes.
pub(crate) fn read(file: &[u8]) -> Exif {
    let mut found = Exif {
        orientation: 1,
        ..Exif::default()
    };
    let Ok(exif) = exif::Reader::new().read_from_container(&mut Cursor::new(file)) else {
        return found;
    };
    let number = |tag| {
        exif.get_field(tag, In::PRIMARY)
            .and_then(|f| f.value.get_uint(0))
    };
    if let Some(turn @ 1..=8) = number(Tag::Orientation) {
        found.orientation = turn as u8;
    }
    found.focal_35mm = number(Tag::FocalLengthIn35mmFilm)
        .map(f64::from)
        .filter(|mm| FOCALS_MM.contains(mm));
    let text = |tag| match exif.get_field(tag, In::PRIMARY).map(|f| &f.value) {
        Some(Value::Ascii(lines)) => {
            let line = lines
                .first()
                .map(|l| String::from_utf8_lossy(l).trim().to_owned());
            line.unwrap_or_default()
        }
        _ => String::new(),
    };
    found.device = format!("{} {}", text(Tag::Make), text(Tag::Model))
        .trim()
        .to_owned();
    let date = text(Tag::DateTimeOriginal);
    if let Ok(date) = exif::DateTime::from_ascii(date.as_bytes()) {
        let days = f64::from(days(
            i32::from(date.year),
            i32::from(date.month),
            i32::from(date.day),
        ));
        let clock = f64::from(date.hour) * 3600.0 + f64::from(date.minute) * 60.0;
        let part: f64 = format!("0.{}", text(Tag::SubSecTimeOriginal))
            .parse()
            .unwrap_or(0.0);
        found.time_s = Some(days * 86400.0 + clock + f64::from(date.second) + part);
    }
    found
}

/// Days since 0000-03-01 of the proleptic Gregorian calendar (Howard Hinnant's algorithm).
fn days(year: i32, month: i32, day: i32) -> i32 {
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let of_era = year.rem_euclid(400);
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_day_follows_the_day_before() {
        assert_eq!(days(2024, 3, 1) - days(2024, 2, 28), 2);
        assert_eq!(days(2026, 1, 1) - days(2025, 1, 1), 365);
    }

    #[test]
    fn no_exif_is_no_error() {
        assert_eq!(read(b"nothing").orientation, 1);
    }
}
