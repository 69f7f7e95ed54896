//! Who is measured and when: what results are called after, and what indices and growth references ask for. Personal: apart
//! from the capture's other facts, so that only stages that ask for it have it in their keys, and run again when it changes.

use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// The sex whose references are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sex {
    /// Women and girls.
    Female,
    /// Men and boys.
    Male,
}

impl Sex {
    /// By its word in `capture.toml`: `female`, `male`.
    pub fn read(word: &str) -> Option<Self> {
        match word {
            "female" => Some(Sex::Female),
            "male" => Some(Sex::Male),
            _ => None,
        }
    }
}

/// Who is measured and when; all of it may be unknown.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Person {
    /// What the user calls the capture.
    pub capture: Option<String>,
    /// The day of the capture as it was given, `YYYY-MM-DD`.
    pub date: Option<String>,
    /// The sex whose references are meant.
    pub sex: Option<Sex>,
    /// The day of birth, `YYYY-MM-DD`.
    pub born: Option<String>,
    /// The age on the day of the capture, where it was given itself. \[months\]
    pub age_months: Option<f64>,
    /// The weight. \[kg\]
    pub weight_kg: Option<f64>,
}

/// Days of a month on average: 365.25 / 12, as the WHO's programs count (derived).
const DAYS: f64 = 30.4375;

impl Person {
    /// The age on the day of the capture, negative for one before birth; `None` where it does not follow. \[months\]
    pub fn age_on(&self, day: Option<&str>) -> Option<f64> {
        let lived = || Some(stage::day_number(day?)? - stage::day_number(self.born.as_deref()?)?);
        self.age_months.or_else(|| Some(lived()? as f64 / DAYS))
    }
}

impl Artifact for Person {
    const KIND: &'static str = "person";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        to.meta(self);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        from.meta()
    }
}

/// The place of a number in a reference for sex and age.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// Standard deviations from the median.
    pub z: f64,
    /// Of a hundred of the reference, so many are below.
    pub centile: f64,
}

/// A child beside the WHO's growth reference of 2007 (5 to 19 years). No diagnosis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Body mass index for age.
    pub bmi: Option<Score>,
    /// Height for age.
    pub height: Option<Score>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_age_follows_from_two_days_or_is_given() {
        let born = Person {
            born: Some("2016-05-01".into()),
            ..Person::default()
        };
        proof::near(born.age_on(Some("2026-05-01")).unwrap(), 120.0, 0.03);
        assert!(born.age_on(Some("2015-05-01")).unwrap() < 0.0);
        assert_eq!(born.age_on(None), None);
        let person = Person {
            age_months: Some(114.0),
            ..Person::default()
        };
        assert_eq!(person.age_on(None), Some(114.0));
        assert_eq!(Person::default().age_on(Some("2026-05-01")), None);
    }
}
