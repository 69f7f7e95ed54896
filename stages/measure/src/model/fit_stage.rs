//! The stage that fits a level model on tables and writes its file.

use super::fit::fit;
use super::fit_error::FitError;
use super::held_out::held_out;
use super::law::Place;
use super::law_fit::{LawSample, fit_law, folds, law_held_out, samples};
use super::necks::{Neck, larynx_held_out, necks};
use super::samples::{Made, Person, made, people};
use super::table::{Table, TableError};
use super::write::model_to_toml;
use shape::Document;
use stage::{Ctx, Files, FilesError, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Tables to fit on.
    pub struct FitInput {
        /// `ansur2.csv` (measured people), `made-bodies.csv`, `strangers.csv`, `neck.csv` and `arms.csv` (what our
        /// program reads on made bodies).
        tables: Arc<Files>,
    }
}

/// Why no model is fitted.
#[derive(Debug, thiserror::Error)]
pub enum NoModel {
    /// A table that cannot be used.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Too little in it.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A file that cannot be read.
    #[error(transparent)]
    Files(#[from] FilesError),
}

/// `measure.fit_levels`: tables → model file.
pub struct FitLevels;

const PEOPLE: &str = "ansur2.csv";
const MADE: [&str; 2] = ["made-bodies.csv", "strangers.csv"];

impl Stage for FitLevels {
    const NAME: &'static str = "measure.fit_levels";
    const VERSION: u32 = 9;
    const ABOUT: &'static str = "Fits the model of levels on measured people and made bodies, with its errors on those left out.";
    type Params = ();
    type Input = FitInput;
    type Output = Document;

    fn run(_: &(), input: FitInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let Samples {
            people,
            made,
            laws,
            necks,
            hashes,
        } = read(&input.tables)?;
        ctx.check()?;
        let fitted = laws
            .iter()
            .map(|(law, rows)| fit_law(*law, &rows.iter().collect::<Vec<_>>()));
        let fitted = fitted.collect::<Result<_, _>>().map_err(NoModel::from)?;
        let all = fit(
            &people.iter().collect::<Vec<_>>(),
            &made.iter().collect::<Vec<_>>(),
            fitted,
        )
        .map_err(NoModel::from)?;
        ctx.check()?;
        let mut held_out = held_out(&people, &made).map_err(NoModel::from)?;
        for (law, rows) in &laws {
            let folds = folds(*law, rows).map_err(NoModel::from)?;
            held_out.extend(law_held_out(&folds));
            if *law == Place::Notch {
                held_out.extend(larynx_held_out(&folds, &necks));
            }
        }
        Ok(Document {
            media: "application/toml".into(),
            bytes: model_to_toml(&all, &hashes, &held_out).into_bytes(),
        })
    }
}

/// What the tables hold.
struct Samples {
    people: Vec<Person>,
    made: Vec<Made>,
    laws: Vec<(Place, Vec<LawSample>)>,
    necks: Vec<Neck>,
    /// Names and hashes of the tables.
    hashes: Vec<(String, String)>,
}

fn read(files: &Files) -> Result<Samples, NoModel> {
    let mut hashes: Vec<(String, String)> = Vec::new();
    let mut table = |name: &str| -> Result<Table, NoModel> {
        let entry = files.entries.iter().find(|e| e.name.ends_with(name));
        let entry = entry.ok_or_else(|| TableError::Missing(name.into()))?;
        let bytes = files.read(entry)?;
        hashes.push((name.into(), blake3::hash(&bytes).to_hex().to_string()));
        Ok(Table::read(name, &bytes)?)
    };
    let people = people(&table(PEOPLE)?)?;
    let mut all = Vec::new();
    for name in MADE {
        all.extend(made(&table(name)?)?);
    }
    // Several laws are fitted on one table.
    let mut own: Vec<Table> = Vec::new();
    let mut laws = Vec::new();
    for law in Place::ALL {
        let known = own.iter().position(|t| t.name == law.table());
        let at = match known {
            Some(at) => at,
            None => {
                own.push(table(law.table())?);
                own.len() - 1
            }
        };
        laws.push((law, samples(law, &own[at])?));
    }
    let neck = own.iter().find(|t| t.name == Place::Notch.table());
    let necks = necks(neck.expect("bug: the notch has a law"))?;
    Ok(Samples {
        people,
        made: all,
        laws,
        necks,
        hashes,
    })
}
