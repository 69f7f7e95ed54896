//! What is known of a capture, as it is given on the page: checked, then the words of `tailor measure`.

use serde::{Deserialize, Serialize};

/// What is known of a capture; all may be left out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Facts {
    /// \[cm\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) stature_cm: Option<f64>,
    /// \[kg\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) weight_kg: Option<f64>,
    /// Whose growth reference is meant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sex: Option<Sex>,
    /// On the day of the capture. \[years\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) age_years: Option<f64>,
    /// Edge length of a mat tag's black square. \[mm\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mat_tag_mm: Option<f64>,
    /// \[cm\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) disk_diameter_cm: Option<f64>,
    /// As if on 36 × 24 mm film. \[mm\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) focal_mm: Option<f64>,
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
    /// The numbers with the limits that are believed: a slip of the keyboard is refused at once.
    fn numbers(&self) -> [(&'static str, Option<f64>, f64, f64); 7] {
        [
            ("stature_cm", self.stature_cm, 40.0, 260.0),
            ("weight_kg", self.weight_kg, 2.0, 400.0),
            ("age_years", self.age_years, 0.0, 130.0),
            ("mat_tag_mm", self.mat_tag_mm, 5.0, 500.0),
            ("disk_diameter_cm", self.disk_diameter_cm, 20.0, 300.0),
            ("focal_mm", self.focal_mm, 5.0, 1000.0),
            ("steps", self.steps.map(|s| s.abs() as f64), 3.0, 400.0),
        ]
    }

    /// Whether they can be.
    ///
    /// # Errors
    ///
    /// The first that cannot.
    pub(super) fn check(&self) -> Result<(), Unlikely> {
        for (field, given, least, most) in self.numbers() {
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
        let number = |flag: &str, given: Option<f64>, unit: &str| {
            given.map(|given| format!("--{flag}={given}{unit}"))
        };
        let given = [
            number("stature", self.stature_cm, "cm"),
            number("weight", self.weight_kg, "kg"),
            self.sex.map(|sex| format!("--sex={}", sex.word())),
            number("age", self.age_years, "y"),
            number("mat-tag", self.mat_tag_mm, "mm"),
            number("disk-diameter", self.disk_diameter_cm, "cm"),
            number("focal", self.focal_mm, ""),
            self.steps.map(|steps| format!("--steps={steps}")),
            plate.map(|plate| format!("--plate={plate}")),
        ];
        given.into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_given_becomes_flags_and_slips_are_refused() {
        let facts = Facts {
            stature_cm: Some(171.5),
            steps: Some(-18),
            ..Facts::default()
        };
        let words = facts.words(Some("0019.jpg"));
        assert_eq!(
            words,
            ["--stature=171.5cm", "--steps=-18", "--plate=0019.jpg"]
        );
        assert_eq!(facts.check(), Ok(()));
        for bad in [1.71, 1715.0, f64::NAN, -171.0] {
            let facts = Facts {
                stature_cm: Some(bad),
                ..Facts::default()
            };
            assert_eq!(facts.check().unwrap_err().field, "stature_cm", "{bad}");
        }
        assert!(serde_json::from_str::<Facts>(r#"{"set":"photos.stop=false"}"#).is_err());
    }
}
