//! What is known of a capture, as it is given on the page: checked, then the words of `tailor measure`.

use crate::catalog::{KNOWN, Known, Quantity};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// What is known of a capture; all may be left out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Facts {
    /// The known numbers that are given.
    #[serde(flatten)]
    pub(super) numbers: Numbers,
    /// Whose growth reference is meant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sex: Option<Sex>,
    /// Into how many even steps the turn was divided; negative if it went clockwise seen from above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) steps: Option<i64>,
    /// Which photo is of the empty scene.
    #[serde(skip_serializing_if = "Plate::is_by_name")]
    pub(super) plate: Plate,
    /// Whether the camera was walked around.
    pub(super) walk: bool,
    /// Whether a first, coarser look is enough.
    pub(super) quick: bool,
    /// Whether the report shows inches.
    pub(super) inches: bool,
}

/// Numbers by the names of their fields, each in its key's unit. What is no field of the page is refused.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Numbers(pub(super) BTreeMap<&'static str, f64>);

impl Numbers {
    /// A number, if it is given.
    pub(super) fn get(&self, field: &str) -> Option<f64> {
        self.0.get(field).copied()
    }
}

impl<'de> Deserialize<'de> for Numbers {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Numbers, D::Error> {
        let given = BTreeMap::<String, serde_json::Value>::deserialize(from)?;
        let mut numbers = BTreeMap::new();
        for (name, value) in given {
            let unknown = || D::Error::custom(format!("unknown field `{name}`"));
            let (field, _) = fields().find(|(f, _)| *f == name).ok_or_else(unknown)?;
            match value.as_f64() {
                Some(number) => numbers.insert(field, number),
                None if value.is_null() => continue,
                None => return Err(D::Error::custom(format!("{name}: {value} is no number"))),
            };
        }
        Ok(Numbers(numbers))
    }
}

/// The numbers that have a field on the page, by its name.
pub(super) fn fields() -> impl Iterator<Item = (&'static str, &'static Known)> {
    KNOWN.iter().filter_map(|known| Some((known.field?, known)))
}

/// Which photo is of the empty scene: a number, `null` for none, and left out for the one by its name.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Option<u32>", into = "Option<u32>")]
pub(super) enum Plate {
    #[default]
    ByName,
    Nothing,
    Photo(u32),
}

impl Plate {
    fn is_by_name(&self) -> bool {
        *self == Plate::ByName
    }
}

impl From<Option<u32>> for Plate {
    fn from(given: Option<u32>) -> Plate {
        given.map_or(Plate::Nothing, Plate::Photo)
    }
}

impl From<Plate> for Option<u32> {
    fn from(plate: Plate) -> Option<u32> {
        match plate {
            Plate::Photo(number) => Some(number),
            Plate::ByName | Plate::Nothing => None,
        }
    }
}

/// Whose growth reference is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Sex {
    Female,
    Male,
}

impl Sex {
    pub(super) const ALL: [Sex; 2] = [Sex::Female, Sex::Male];

    /// As `--sex` has it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Sex::Female => "female",
            Sex::Male => "male",
        }
    }
}

/// Fewer steps of a turn are no turn (structural), and more than this are a slip of the keyboard (by hand: no capture had more
/// than 100).
const STEPS: [f64; 2] = [3.0, 400.0];

/// A fact that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{field}: {given} is not between {least} and {most}")]
pub(super) struct Unlikely {
    /// Its name.
    pub(super) field: &'static str,
    /// What was given.
    pub(super) given: f64,
    /// The least that is believed.
    pub(super) least: f64,
    /// The most that is believed.
    pub(super) most: f64,
}

impl Facts {
    /// Whether they can be.
    ///
    /// # Errors
    ///
    /// The first that cannot.
    pub(super) fn check(&self) -> Result<(), Unlikely> {
        let number = |(field, known): (_, &Known)| {
            let given = self.numbers.get(field);
            (field, given, known.least, known.most)
        };
        let steps = self.steps.map(|steps| steps.abs() as f64);
        let steps = ("steps", steps, STEPS[0], STEPS[1]);
        for (field, given, least, most) in fields().map(number).chain([steps]) {
            if let Some(given) = given.filter(|n| !(*n >= least && *n <= most)) {
                return Err(Unlikely {
                    field,
                    given,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }

    /// As flags of `tailor measure` and `tailor doctor`; `plate` is the file of that number.
    pub(super) fn words(&self, plate: Option<&str>) -> Vec<String> {
        let number = |(field, known): (_, &Known)| {
            let unit = match known.of {
                Quantity::Age => "y",
                // Flags of these have a plain number.
                Quantity::Number(_) | Quantity::Count => "",
                of => of.unit(),
            };
            Some(format!(
                "--{}={}{unit}",
                known.flag,
                self.numbers.get(field)?
            ))
        };
        let more = [
            self.sex.map(|sex| format!("--sex={}", sex.word())),
            self.steps.map(|steps| format!("--steps={steps}")),
            plate.map(|plate| format!("--plate={plate}")),
        ];
        fields()
            .filter_map(number)
            .chain(more.into_iter().flatten())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(field: &'static str, number: f64) -> Facts {
        Facts {
            numbers: Numbers([(field, number)].into()),
            ..Facts::default()
        }
    }

    #[test]
    fn what_is_given_becomes_flags_and_slips_are_refused() {
        let facts = Facts {
            steps: Some(-18),
            ..of("stature_cm", 171.5)
        };
        let words = facts.words(Some("0019.jpg"));
        assert_eq!(
            words,
            ["--stature=171.5cm", "--steps=-18", "--plate=0019.jpg"]
        );
        assert_eq!(facts.check(), Ok(()));
        for bad in [1.71, 1715.0, f64::NAN, -171.0] {
            let facts = of("stature_cm", bad);
            assert_eq!(facts.check().unwrap_err().field, "stature_cm", "{bad}");
        }
        let read = |text| serde_json::from_str::<Facts>(text);
        assert_eq!(read(r#"{"steps":-18,"stature_cm":171.5}"#).unwrap(), facts);
        let wrong = read(r#"{"set":"photos.stop=false"}"#).unwrap_err();
        assert!(wrong.to_string().contains("unknown field `set`"), "{wrong}");
        assert!(read(r#"{"weight_kg":"80"}"#).is_err());
    }

    #[test]
    fn the_documented_limits_are_those_of_the_page() {
        let api: serde_json::Value = serde_json::from_str(super::super::handed::OPENAPI).unwrap();
        let documented = &api["components"]["schemas"]["Facts"]["properties"];
        for (field, known) in fields() {
            let limits = ["minimum", "maximum"].map(|end| documented[field][end].as_f64());
            assert_eq!(limits, [Some(known.least), Some(known.most)], "{field}");
        }
    }
}
