//! What models are fitted on: measured people and made bodies, as numbers by name.

use super::level::Level;
use super::table::{Table, TableError};
use super::tapes::Tapes;
use crate::features::readings::{Reading, Readings};

/// Measures of a body that tie what a surface shows to the levels of measured people: heights and
/// girths as shares of stature, and the logarithm of stature against 1700 mm.
pub(crate) const ANATOMY: [&str; 10] = [
    "ln_stature",
    "crotch",
    "buttock",
    "navel",
    "cervicale",
    "chest",
    "neck_girth",
    "hip_girth",
    "navel_girth",
    "chest_girth",
];

/// The survey's columns for [`ANATOMY`] after the stature.
const SURVEY: [&str; 9] = [
    "crotchheight",
    "buttockheight",
    "waistheightomphalion",
    "cervicaleheight",
    "chestheight",
    "neckcircumference",
    "buttockcircumference",
    "waistcircumference",
    "chestcircumference",
];

/// One measured person.
#[derive(Debug, Clone)]
pub(crate) struct Person {
    /// Row in the survey's table, 0 for the first.
    pub row: usize,
    /// Whether a woman.
    pub woman: bool,
    /// [`ANATOMY`].
    pub anatomy: [f64; ANATOMY.len()],
    /// Levels, as shares of stature, in the order of [`Level::ALL`].
    pub levels: [f64; Level::ALL.len()],
}

/// The people of a survey.
pub(crate) fn people(table: &Table) -> Result<Vec<Person>, TableError> {
    let sex = table.text("sex")?;
    let stature = table.numbers("stature")?;
    let columns = SURVEY.map(|c| table.numbers(c));
    let columns: Vec<Vec<f64>> = columns.into_iter().collect::<Result<_, _>>()?;
    let (rib, crest) = (
        table.numbers("tenthribheight")?,
        table.numbers("iliocristaleheight")?,
    );
    let (navel, chest) = (
        table.numbers("waistheightomphalion")?,
        table.numbers("chestheight")?,
    );
    let one = |i: usize| {
        let s = stature[i];
        let mut anatomy = [libm::log(s / 1700.0); ANATOMY.len()];
        for (k, column) in columns.iter().enumerate() {
            anatomy[k + 1] = column[i] / s;
        }
        let waist = (rib[i] + crest[i]) / 2.0;
        Person {
            row: i,
            woman: sex[i].to_ascii_lowercase().starts_with('f'),
            anatomy,
            levels: [waist, navel[i], crest[i], chest[i]].map(|z| z / s),
        }
    };
    Ok((0..table.len()).map(one).collect())
}

/// One made body: what our program reads on its surface, and what is true of it.
#[derive(Debug, Clone)]
pub(crate) struct Made {
    /// Row in the table, 0 for the first.
    pub row: usize,
    /// Its own name in the table.
    pub id: String,
    /// The family that it is of.
    pub family: String,
    /// The body that this is another capture of.
    pub repeats: Option<String>,
    /// Row of the survey whose person it was driven to.
    pub person: Option<usize>,
    /// Whether it is grown up.
    pub grown: bool,
    /// True stature. \[mm\]
    pub stature: f64,
    /// What is read on its surface.
    pub readings: Readings,
    /// True [`ANATOMY`], where known.
    pub anatomy: [Option<f64>; ANATOMY.len()],
    /// True levels as shares of stature, in the order of [`Level::ALL`], where known.
    pub levels: [Option<f64>; Level::ALL.len()],
    /// Tape around the trunk over height, both as shares of stature, from [`LOWEST`] on in steps of
    /// [`STEP`].
    pub tapes: Tapes,
}

/// Height of the first tape of a profile, as a share of stature (structural: the model file's form).
pub(crate) const LOWEST: f64 = 0.45;
/// Step between two tapes of a profile, as a share of stature (structural: the model file's form).
pub(crate) const STEP: f64 = 0.005;
/// How many tapes a profile has (structural: the model file's form).
pub(crate) const TAPES: usize = 71;

impl Made {
    /// Tape around the trunk at a height, both as shares of stature.
    pub(crate) fn tape(&self, share: f64) -> Option<f64> {
        self.tapes.at(share)
    }
}

/// Bodies to which no mean, slope or law is fitted: they show how far levels are from where a fit expects them.
pub(crate) const STRANGERS: &str = "strangers";
/// Families not to fit on: those that show one body in many poses, and strangers.
const TESTED: [&str; 2] = ["poses", STRANGERS];

/// Whether a fit may use a family.
pub(crate) fn fitted(family: &str) -> bool {
    !TESTED.contains(&family)
}

impl Made {
    /// Whether a fit may use it.
    pub(crate) fn fitted(&self) -> bool {
        self.repeats.is_none() && fitted(&self.family)
    }
}

/// Made bodies of a table that `examples/feature_table.rs` wrote.
pub(crate) fn made(table: &Table) -> Result<Vec<Made>, TableError> {
    let all = |names: Vec<String>| -> Result<Vec<Vec<Option<f64>>>, TableError> {
        names.iter().map(|n| table.optional(n)).collect()
    };
    let family = table.text("family")?;
    let (id, repeats) = (table.text("id")?, table.text("repeats")?);
    let person = table.optional("person")?;
    let grown = table.numbers("grown")?;
    let stature = table.numbers("stature")?;
    let readings = all(Reading::ALL
        .iter()
        .map(|r| format!("r.{}", r.name()))
        .collect())?;
    let anatomy = all(ANATOMY.iter().map(|a| format!("a.{a}")).collect())?;
    let levels = all(Level::ALL
        .iter()
        .map(|l| format!("l.{}", l.name()))
        .collect())?;
    let tapes = all((0..TAPES).map(|k| format!("t{k:02}")).collect())?;
    let one = |i: usize| {
        let read = Reading::ALL.into_iter().zip(&readings);
        Made {
            row: i,
            id: id[i].to_owned(),
            repeats: Some(repeats[i])
                .filter(|r| !r.is_empty())
                .map(str::to_owned),
            family: family[i].to_owned(),
            person: person[i].map(|p| p as usize),
            grown: grown[i] > 0.5,
            stature: stature[i],
            readings: read.fold(Readings::default(), |all, (r, column)| {
                all.with(r, column[i])
            }),
            anatomy: std::array::from_fn(|k| anatomy[k][i]),
            levels: std::array::from_fn(|k| levels[k][i]),
            tapes: Tapes {
                from: LOWEST,
                step: STEP,
                all: tapes.iter().map(|t| t[i]).collect(),
            },
        }
    };
    Ok((0..table.len()).map(one).collect())
}
