//! The stage that fits a level model on tables and writes its file.

use super::fit::{FitError, fit};
use super::held_out::held_out;
use super::samples::{Made, Person, made, people};
use super::table::{Table, TableError};
use super::write::model_to_toml;
use shape::Document;
use stage::{Ctx, Files, FilesError, Stage, Stop};
use std::sync::Arc;

stage::inputs! {
    /// Tables to fit on.
    pub struct FitInput {
        /// `ansur2.csv` (measured people) and `made-bodies.csv` (what our program reads on made bodies).
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
const MADE: &str = "made-bodies.csv";

impl Stage for FitLevels {
    const NAME: &'static str = "measure.fit_levels";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Fits the model of levels on measured people and made bodies, and says how it does on those left out.";
    type Params = ();
    type Input = FitInput;
    type Output = Document;

    fn run(_: &(), input: FitInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let (people, made, hashes) = read(&input.tables)?;
        ctx.check()?;
        let all = fit(
            &people.iter().collect::<Vec<_>>(),
            &made.iter().collect::<Vec<_>>(),
        )
        .map_err(NoModel::from)?;
        ctx.check()?;
        let held_out = held_out(&people, &made).map_err(NoModel::from)?;
        Ok(Document {
            media: "application/toml".into(),
            bytes: model_to_toml(&all, &hashes, &held_out).into_bytes(),
        })
    }
}

/// People, made bodies, and the hashes of both tables.
type Samples = (Vec<Person>, Vec<Made>, Vec<(String, String)>);

fn read(files: &Files) -> Result<Samples, NoModel> {
    let table = |name: &str| -> Result<(Table, String), NoModel> {
        let entry = files.entries.iter().find(|e| e.name.ends_with(name));
        let entry = entry.ok_or_else(|| TableError::Missing(name.into()))?;
        let bytes = files.read(entry)?;
        let hash = blake3::hash(&bytes).to_hex().to_string();
        Ok((Table::read(name, &bytes)?, hash))
    };
    let (survey, survey_hash) = table(PEOPLE)?;
    let (bodies, bodies_hash) = table(MADE)?;
    let hashes = vec![(PEOPLE.into(), survey_hash), (MADE.into(), bodies_hash)];
    Ok((people(&survey)?, made(&bodies)?, hashes))
}
