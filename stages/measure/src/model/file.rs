//! The file of a level model (TOML): read, and refused with what is wrong and what would fit.

use super::normal::Normal;
use crate::features::readings::{READINGS_VERSION, Reading};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;

/// The format that this program reads and writes.
pub(crate) const FORMAT: u32 = 1;

/// What is wrong with a model file.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// Not TOML, cut short, or of another layout.
    #[error("{name} is no level model: {why}")]
    Syntax {
        /// The file.
        name: String,
        /// What the reader says, with the line.
        why: String,
    },
    /// Another format or other readings.
    #[error(
        "{name} has {what} {got}, but this program knows {want}: refit it with pipelines/fit-levels.toml"
    )]
    Version {
        /// The file.
        name: String,
        /// `format` or `readings_version`.
        what: &'static str,
        /// What the file says.
        got: u32,
        /// What would fit.
        want: u32,
    },
    /// A variable that nobody knows.
    #[error("{name}: `{variable}` is neither a reading nor a level; known: {known}")]
    Variable {
        /// The file.
        name: String,
        /// The variable.
        variable: String,
        /// What there is.
        known: String,
    },
    /// A distribution that is none.
    #[error("{name}: the distribution of `{population}` {why}")]
    Distribution {
        /// The file.
        name: String,
        /// The population.
        population: String,
        /// What is wrong.
        why: &'static str,
    },
    /// Not one file.
    #[error("one model file is wanted, but {0} are there")]
    Count(usize),
}

/// A level that the model tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Midway between lowest rib and iliac crest (ISO 8559-1 5.3.10).
    Waist,
    /// The navel (omphalion).
    Navel,
    /// The side of the iliac crest (NIH).
    HipBone,
    /// The nipples, or the bust point (ISO 8559-1 5.3.4).
    Chest,
}

impl Level {
    /// All of them, in the order of a model file.
    pub const ALL: [Level; 4] = [Level::Waist, Level::Navel, Level::HipBone, Level::Chest];

    /// What a model file calls it.
    pub fn name(self) -> &'static str {
        match self {
            Level::Waist => "waist",
            Level::Navel => "navel",
            Level::HipBone => "hip_bone",
            Level::Chest => "chest",
        }
    }
}

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
    /// Squared distances beyond which a body is not one of a scope's: 99 in 100 lie within, for each
    /// number of readings.
    pub(crate) limit: Vec<f64>,
    /// Standard deviation of each reading against the definition that it is lined up with.
    pub(crate) reading_sigma: Vec<f64>,
    /// Covariance of readings of one body between two captures of it; unknown without such pairs.
    pub(crate) repeat: Option<DMatrix<f64>>,
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
    #[serde(rename = "table")]
    _table: toml::Value,
    #[serde(rename = "held_out")]
    _held_out: toml::Value,
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
        let readings = named(name, &raw.readings, &Reading::ALL, Reading::name)?;
        let levels = named(name, &raw.levels, &Level::ALL, Level::name)?;
        let width = readings.len() + levels.len();
        let populations = raw
            .population
            .into_iter()
            .map(|p| population(name, p, width));
        let populations: Vec<Population> = populations.collect::<Result<_, _>>()?;
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
        Ok(())
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

/// A symmetric matrix from the rows of its lower triangle.
fn symmetric(rows: &[Vec<f64>], width: usize) -> Option<DMatrix<f64>> {
    let triangle = rows.iter().enumerate().all(|(i, row)| row.len() == i + 1);
    let finite = rows.iter().flatten().all(|x| x.is_finite());
    let at = |i: usize, j: usize| rows[i.max(j)][i.min(j)];
    (rows.len() == width && triangle && finite).then(|| DMatrix::from_fn(width, width, at))
}
