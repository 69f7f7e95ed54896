//! Who is measured, in `[subject]` of `capture.toml`.

use crate::date::day_text;
use crate::keys::{Keys, RigError};
use shape::{Person, Sex, day_number};
use toml::Table;

/// The keys of `[subject]` that describe a person.
pub(crate) const PERSONAL: [&str; 3] = ["sex", "born", "age_years"];

/// What a `capture.toml` names of a person; its other keys are not read.
pub(crate) fn read_person(table: Table) -> Result<Person, RigError> {
    let Some(mut subject) = Keys::root(table).inner("subject")? else {
        return Ok(Person::default());
    };
    let sex = match subject.take("sex") {
        None => None,
        Some(value) => {
            let sex = value.as_str().and_then(Sex::read);
            let wants = "\"female\" or \"male\" (whose growth reference is meant)";
            Some(sex.ok_or_else(|| subject.wrong("sex", wants, &value))?)
        }
    };
    let born = match subject.take("born") {
        None => None,
        Some(value) => {
            let day = day_text(&value);
            let wants = "a day such as \"2016-05-01\"";
            match day_number(&day) {
                Some(_) => Some(day),
                None => return Err(subject.wrong("born", wants, &value)),
            }
        }
    };
    let years = subject.known("age_years")?;
    if born.is_some() && years.is_some() {
        let both =
            "`subject.born` and `subject.age_years` are the same fact: leave one of them out";
        return Err(RigError::wrong(both));
    }
    Ok(Person {
        sex,
        born,
        age_months: years.map(|years| 12.0 * years),
    })
}
