//! The day of a capture: given, or read from the photos where the user asks for that. Never the time of day.

use crate::keys::{Keys, RigError};
use stage::{day_number, message};
use toml::Value;

/// Where the day of a capture comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Day {
    /// `date = "2026-05-01"`.
    Given(String),
    /// `date = "exif"`: that of the first photo.
    Exif,
}

stage::messages! {
    DAY_OR_EXIF = "rig-day-or-exif": "a day such as \"2026-05-01\", or \"exif\" to take the photos' own";
}

/// The key `date` of `capture.toml`.
pub(crate) fn read_day(root: &mut Keys<'_>) -> Result<Option<Day>, RigError> {
    let Some(value) = root.take("date") else {
        return Ok(None);
    };
    let text = day_text(&value);
    match text.as_str() {
        "exif" => Ok(Some(Day::Exif)),
        day if day_number(day).is_some() => Ok(Some(Day::Given(text))),
        _ => Err(root.wrong("date", message!(DAY_OR_EXIF), &value)),
    }
}

/// What may be a day, as text or as TOML has it.
pub(crate) fn day_text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Datetime(date) => date.date.map_or_else(String::new, |d| d.to_string()),
        _ => String::new(),
    }
}

/// The day of a time in seconds since 0000-03-01 of the proleptic Gregorian calendar.
pub(crate) fn day_of(seconds: f64) -> String {
    let days = (seconds / 86400.0).floor() as i64;
    // That one is so many days before 1970-01-01.
    stage::day_text(days - 719_468)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_its_day() {
        // 2000-03-01 is 2000 years of the calendar after 0000-03-01.
        let start = 5.0 * 146_097.0 * 86400.0;
        assert_eq!(day_of(start), "2000-03-01");
        assert_eq!(day_of(start - 1.0), "2000-02-29");
        assert_eq!(day_of(start + 366.0 * 86400.0), "2001-03-02");
    }

    #[test]
    fn the_key_is_a_text_a_toml_date_or_exif() {
        let read = |text: &str| read_day(&mut Keys::root(text.parse().unwrap()));
        assert_eq!(
            read("date = \"2026-05-01\"").unwrap(),
            Some(Day::Given("2026-05-01".into()))
        );
        assert_eq!(
            read("date = 2026-05-01").unwrap(),
            Some(Day::Given("2026-05-01".into()))
        );
        assert_eq!(read("date = \"exif\"").unwrap(), Some(Day::Exif));
        assert_eq!(read("").unwrap(), None);
        for wrong in ["date = 5", "date = \"May\"", "date = 10:00:00"] {
            assert!(
                read(wrong).unwrap_err().to_string().contains("2026-05-01"),
                "{wrong}"
            );
        }
    }
}
