//! The stage that reads who is measured and when out of `capture.toml`: name, day, sex, age, weight. They are personal,
//! so they flow apart from the photos: a stage that does not ask for them has them in no key.

use crate::facts::Facts;
use crate::keys::RigError;
use crate::person_keys::read_person;
use shape::Person;
use stage::{Ctx, Files, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// What is given beside the file.
    pub struct PersonalParams {
        /// Who is measured, by the keys of `capture.toml`, over what the file has: `facts.subject.age_years`.
        facts: Facts = Facts::default(),
    }
}

stage::inputs! {
    /// The user's folder.
    pub struct PersonalInput {
        /// Of these, `capture.toml` is read.
        files: Option<Arc<Files>>,
    }
}

/// `capture.person`: files → person.
pub struct Personal;

impl Stage for Personal {
    const NAME: &'static str = "capture.person";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Reads name, day, sex, age and weight out of capture.toml, for what follows from girths; nothing else has them.";
    type Params = PersonalParams;
    type Input = PersonalInput;
    type Output = Person;

    fn run(p: &PersonalParams, input: PersonalInput, _: &Ctx<'_>) -> Result<Person, Stop> {
        let entry = |files: &Arc<Files>| {
            let entry = files.entries.iter().find(|e| e.name == "capture.toml");
            entry.map(|e| files.read(e)).transpose()
        };
        let text = input.files.as_ref().map(entry).transpose()?;
        let text = text.flatten().unwrap_or_default();
        Ok(described(&String::from_utf8_lossy(&text), &p.facts)?)
    }
}

/// The person of a file, and what is given beside it, which wins.
fn described(text: &str, facts: &Facts) -> Result<Person, RigError> {
    facts.read_over(text, read_person)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Sex;
    use stage::Value;
    use std::collections::BTreeMap;

    fn read(text: &str) -> Result<Person, RigError> {
        described(text, &Facts::default())
    }

    #[test]
    fn sex_and_age_are_read_and_slips_are_refused() {
        let person = read("[subject]\nsex = \"female\"\nborn = 2016-05-01").unwrap();
        assert_eq!(person.sex, Some(Sex::Female));
        assert_eq!(person.born.as_deref(), Some("2016-05-01"));
        let person = read("[subject]\nage_years = 9.5").unwrap();
        assert_eq!(person.age_months, Some(114.0));
        for (text, part) in [
            ("sex = \"f\"", "`subject.sex` wants \"female\" or \"male\""),
            ("sex = 1", "`subject.sex` wants"),
            ("born = \"2016-02-30\"", "`subject.born` wants a day"),
            (
                "age_years = 131",
                "`subject.age_years` wants a number from 0 to 130",
            ),
            (
                "age_years = 9\nborn = \"2016-05-01\"",
                "leave one of them out",
            ),
        ] {
            let error = read(&format!("[subject]\n{text}")).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn an_age_that_is_given_beside_the_file_wins_over_a_day_of_birth() {
        let age = BTreeMap::from([("age_years".to_owned(), Value::Int(9))]);
        let facts = Facts(BTreeMap::from([("subject".to_owned(), Value::Table(age))]));
        let person = described("[subject]\nborn = \"2016-05-01\"", &facts).unwrap();
        assert_eq!((person.age_months, person.born), (Some(108.0), None));
    }
}
