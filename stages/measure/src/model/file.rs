//! The file of a level model (TOML): read, and refused with what is wrong and what would fit.

use super::error::ModelError;
use super::law::{Law, Place, RawLaw};
use super::level::Level;
use super::normal::{Normal, symmetric};
use crate::features::readings::{READINGS_VERSION, Reading};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

/// The format that this program reads and writes.
pub(crate) const FORMAT: u32 = 1;

/// What a population is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Scope {
    /// Measured people.
    People,
    /// Made bodies, used where no measured people are near.
    Made,
}

impl Scope {
    /// What a model file calls it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Scope::People => "people",
            Scope::Made => "made",
        }
    }
}

/// One population of a model: a normal distribution over readings and levels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Population {
    /// Its name.
    pub name: String,
    /// What it is for.
    pub scope: Scope,
    /// Prior weight.
    pub weight: f64,
    /// Over the model's variables, in their order.
    pub normal: Normal,
}

/// Levels as joint normal distributions over [`Reading`]s and [`Level`]s, as shares of stature.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelModel {
    pub(crate) readings: Vec<Reading>,
    pub(crate) levels: Vec<Level>,
    pub(crate) populations: Vec<Population>,
    /// Squared distances beyond which a body is not one of a scope's: 99 in 100 are within, for each
    /// number of readings.
    pub(crate) limit: Vec<f64>,
    /// Standard deviation of each reading against the definition that it is lined up with.
    pub(crate) reading_sigma: Vec<f64>,
    /// Covariance of readings of one body between two captures of it; unknown without such pairs.
    pub(crate) repeat: Option<DMatrix<f64>>,
    /// What single features tell of one place each.
    pub(crate) laws: Vec<Law>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    format: u32,
    readings_version: u32,
    #[serde(rename = "about")]
    _about: String,
    readings: Vec<String>,
    levels: Vec<String>,
    limit: Vec<f64>,
    reading_sigma: Vec<f64>,
    repeat: Option<Vec<Vec<f64>>>,
    population: Vec<RawPopulation>,
    law: Vec<RawLaw>,
    #[serde(rename = "table")]
    _table: toml::Value,
    held_out: Vec<toml::Table>,
    end: End,
}

/// The last of a file: without it, or with another count, the file was cut short.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    held_out: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPopulation {
    name: String,
    scope: Scope,
    weight: f64,
    mean: Vec<f64>,
    covariance: Vec<Vec<f64>>,
}

impl LevelModel {
    /// The model that ships with the program.
    pub fn built_in() -> LevelModel {
        let text = include_str!("../../../../models/levels-1.toml");
        LevelModel::read("models/levels-1.toml", text).expect("bug: the built-in model is unsound")
    }

    /// Reads a model file; `name` is what errors call it.
    ///
    /// # Errors
    ///
    /// The text is no model of levels, or is cut short.
    pub fn read(name: &str, text: &str) -> Result<LevelModel, ModelError> {
        let raw: Raw = toml::from_str(text).map_err(|e| ModelError::Syntax {
            name: name.into(),
            why: e.to_string(),
        })?;
        let versions = [
            ("format", raw.format, FORMAT),
            ("readings_version", raw.readings_version, READINGS_VERSION),
        ];
        for (what, got, want) in versions {
            if got != want {
                let name = name.into();
                return Err(ModelError::Version {
                    name,
                    what,
                    got,
                    want,
                });
            }
        }
        if raw.held_out.len() != raw.end.held_out {
            return Err(ModelError::Syntax {
                name: name.into(),
                why: format!(
                    "it was cut short: {} of {} entries of [[held_out]] are there",
                    raw.held_out.len(),
                    raw.end.held_out
                ),
            });
        }
        let readings = named(name, &raw.readings, &Reading::ALL, Reading::name)?;
        let levels = named(name, &raw.levels, &Level::ALL, Level::name)?;
        let width = readings.len() + levels.len();
        let populations = raw
            .population
            .into_iter()
            .map(|p| population(name, p, width));
        let populations: Vec<Population> = populations.collect::<Result<_, _>>()?;
        let laws: Result<_, _> = raw.law.into_iter().map(|law| law.sound(name)).collect();
        let repeat = raw.repeat.map(|rows| {
            symmetric(&rows, readings.len()).ok_or_else(|| ModelError::Distribution {
                name: name.into(),
                population: "repeat".into(),
                why: "is no lower triangle of finite numbers, a row for each reading",
            })
        });
        let model = LevelModel {
            readings,
            levels,
            populations,
            limit: raw.limit,
            reading_sigma: raw.reading_sigma,
            repeat: repeat.transpose()?,
            laws: laws?,
        };
        model.sound(name)?;
        Ok(model)
    }

    /// Populations for measured people, and limits of distance for every number of readings.
    fn sound(&self, name: &str) -> Result<(), ModelError> {
        let wrong = |why| ModelError::Distribution {
            name: name.into(),
            population: "all".into(),
            why,
        };
        if self.populations.is_empty() {
            return Err(wrong("is missing: no [[population]]"));
        }
        let whole = |list: &[f64]| {
            let positive = list.iter().all(|x| x.is_finite() && *x > 0.0);
            positive && list.len() == self.readings.len()
        };
        if !whole(&self.limit) || !whole(&self.reading_sigma) {
            let why = "needs a positive `limit` and `reading_sigma` for each reading";
            return Err(wrong(why));
        }
        for place in Place::ALL {
            if self.laws.iter().filter(|l| l.place == place).count() != 1 {
                return Err(ModelError::Law {
                    name: name.into(),
                    why: format!("not one law of `{}`", place.name()),
                    known: Place::ALL.map(Place::name).join(", "),
                });
            }
        }
        Ok(())
    }

    /// The law of a place.
    pub fn law(&self, place: Place) -> &Law {
        let own = self.laws.iter().find(|l| l.place == place);
        own.expect("bug: a model without a law, which reading and fitting refuse")
    }
}

/// Names as what they mean.
fn named<T: Copy>(
    file: &str,
    names: &[String],
    all: &[T],
    name: impl Fn(T) -> &'static str,
) -> Result<Vec<T>, ModelError> {
    let one = |word: &String| {
        let found = all.iter().copied().find(|t| name(*t) == word);
        found.ok_or_else(|| ModelError::Variable {
            name: file.into(),
            variable: word.clone(),
            known: all.iter().map(|t| name(*t)).collect::<Vec<_>>().join(", "),
        })
    };
    names.iter().map(one).collect()
}

/// A population whose numbers make a distribution over `width` variables. Covariances are written as
/// the rows of a lower triangle.
fn population(file: &str, raw: RawPopulation, width: usize) -> Result<Population, ModelError> {
    let wrong = |why| ModelError::Distribution {
        name: file.into(),
        population: raw.name.clone(),
        why,
    };
    let finite = raw.mean.iter().chain([&raw.weight]).all(|x| x.is_finite());
    if raw.mean.len() != width || !finite || raw.weight <= 0.0 {
        return Err(wrong(
            "has not one finite mean for each variable and a positive weight",
        ));
    }
    let Some(covariance) = symmetric(&raw.covariance, width) else {
        return Err(wrong(
            "has not one row of finite covariances for each variable",
        ));
    };
    if covariance.clone().cholesky().is_none() {
        return Err(wrong("has covariances that are not positive definite"));
    }
    Ok(Population {
        normal: Normal {
            mean: DVector::from_vec(raw.mean),
            covariance,
        },
        name: raw.name,
        scope: raw.scope,
        weight: raw.weight,
    })
}
