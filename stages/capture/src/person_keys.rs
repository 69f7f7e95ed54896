//! Who is measured and when, in `capture.toml`.

use crate::date::{Day, day_text, read_day};
use crate::keys::{Keys, RigError};
use shape::{Person, Sex};
use stage::message;
use toml::Table;

stage::messages! {
    SEXES = "rig-sexes": "\"female\" or \"male\" (whose growth reference is meant)";
    DAY = "rig-day": "a day such as \"2016-05-01\"";
    ONE_FACT = "rig-one-fact": "`subject.born` and `subject.age_years` are the same fact: leave one of them out";
}

/// The keys that describe who is measured and when: nothing of the photos depends on them.
pub const PERSONAL: [&str; 6] = [
    "name",
    "date",
    "subject.sex",
    "subject.born",
    "subject.age_years",
    "subject.weight_kg",
];

/// Passes over those of `[subject]`.
pub(crate) fn pass_over(subject: &mut Keys<'_>) {
    let keys = PERSONAL.iter();
    keys.filter_map(|key| key.strip_prefix("subject."))
        .for_each(|key| drop(subject.take(key)));
}

/// What a `capture.toml` names of a person; its other keys are not read.
pub(crate) fn read_person(table: Table) -> Result<Person, RigError> {
    let mut root = Keys::root(table);
    let mut person = Person {
        capture: root.text("name")?,
        ..Person::default()
    };
    if let Some(Day::Given(day)) = read_day(&mut root)? {
        person.date = Some(day);
    }
    let Some(mut subject) = root.inner("subject")? else {
        return Ok(person);
    };
    let sex = match subject.take("sex") {
        None => None,
        Some(value) => {
            let sex = value.as_str().and_then(Sex::read);
            Some(sex.ok_or_else(|| subject.wrong("sex", message!(SEXES), &value))?)
        }
    };
    let born = match subject.take("born") {
        None => None,
        Some(value) => {
            let day = day_text(&value);
            match stage::day_number(&day) {
                Some(_) => Some(day),
                None => return Err(subject.wrong("born", message!(DAY), &value)),
            }
        }
    };
    let years = subject.known("age_years")?;
    if born.is_some() && years.is_some() {
        return Err(RigError::wrong(message!(ONE_FACT)));
    }
    Ok(Person {
        sex,
        born,
        age_months: years.map(|years| 12.0 * years),
        weight_kg: subject.known("weight_kg")?,
        ..person
    })
}
