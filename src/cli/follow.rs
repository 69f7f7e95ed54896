//! `tailor follow`: one person over time.

use super::compare::known_errors;
use crate::delivery;
use crate::over_time::{csv, follow, json, markdown, page, series};
use clap::Args;
use command::{Fault, GlobalArgs};
use std::path::PathBuf;

/// Arguments of `tailor follow`.
#[derive(Args)]
pub(crate) struct Following {
    /// What the person is called
    name: String,
    /// Captures of the person that were measured, in any order where their days are known: folders that `measure` wrote
    #[arg(required = true)]
    captures: Vec<PathBuf>,
    /// A repeat.json of `tailor repeat`: its technical errors tell what repetition alone gives; else the captures do
    #[arg(long)]
    repeat: Option<PathBuf>,
    /// Write follow.md, follow.json, follow.csv, follow.html and a coloured surface a capture into this folder
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Follows a person through captures.
pub(crate) fn following(args: &Following, global: &GlobalArgs) -> Result<(), Fault> {
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    let known = known_errors(args.repeat.as_deref())?;
    let series = series(&args.captures).map_err(Fault::input)?;
    let reported = follow(&args.name, &series, &known);
    let pretty = serde_json::to_string_pretty(&json(&reported)).expect("bug: JSON");
    if let Some(out) = &args.out {
        let (page, surfaces) = page(&reported, &series);
        let mut files = vec![
            ("follow.md".to_owned(), markdown(&reported).into_bytes()),
            ("follow.json".to_owned(), pretty.clone().into_bytes()),
            ("follow.csv".to_owned(), csv(&reported).into_bytes()),
            ("follow.html".to_owned(), page.into_bytes()),
        ];
        files.extend(surfaces);
        delivery::write(out, &files).map_err(Fault::stage)?;
    }
    match global.json {
        true => command::outln!("{pretty}"),
        false => command::out!("{}", markdown(&reported)),
    }
    Ok(())
}
