//! Who a table of girths is of: the capture's name and day, sex, and age on that day.

use shape::{Girths, Person};
use stage::{Message, message};

stage::messages! {
    NO_DAY = "warn-born-no-day": "the day of birth is given, but not that of the capture, so the age is not known: set `date` in capture.toml, or give --date";
    BORN_LATER = "warn-born-later": "the capture is before the day of birth: correct `born` or `date` in capture.toml";
}

/// What the capture is called, its day, given or by its photos, sex, and the age on that day; what is odd about these.
pub(crate) fn named(
    girths: &mut Girths,
    person: &Person,
    by_photos: Option<String>,
) -> Vec<Message> {
    girths.capture = person.capture.clone();
    girths.date = person.date.clone().or(by_photos);
    girths.sex = person.sex;
    let age = person.age_on(girths.date.as_deref());
    girths.age_months = age.filter(|months| *months >= 0.0);
    match age {
        None if person.born.is_some() => vec![message!(NO_DAY)],
        Some(months) if months < 0.0 => vec![message!(BORN_LATER)],
        _ => vec![],
    }
}
