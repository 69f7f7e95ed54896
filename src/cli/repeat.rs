//! `tailor repeat`: how near captures of the same people come to each other.

use crate::delivery;
use crate::over_time::repeated;
use crate::repeat::{By, bland_altman_svg, captures, csv, json, markdown, page, study, study_of};
use clap::Args;
use command::{Fault, GlobalArgs};
use std::path::PathBuf;

/// Arguments of `tailor repeat`.
#[derive(Args)]
pub(crate) struct Repeating {
    /// Captures that were measured, each person's in the order in which they were taken: folders that `measure` wrote,
    /// their girths.json, or captures with such a folder beside them
    #[arg(required = true)]
    captures: Vec<PathBuf>,
    /// By what it is known whose they are
    #[arg(long, value_enum, default_value = "name")]
    by: By,
    /// Take each person's girths at the levels of the first capture, carried to the rest as `follow` does: how near changes
    /// come, where levels are not found anew
    #[arg(long)]
    same_level: bool,
    /// Write repeat.md, repeat.json, repeat.csv, repeat.html and a Bland–Altman plot a girth into this folder
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Tells the repeatability of each girth.
pub(crate) fn repeating(args: &Repeating, global: &GlobalArgs) -> Result<(), Fault> {
    if let Some(out) = &args.out {
        delivery::check(out).map_err(Fault::input)?;
    }
    let captures = captures(&args.captures, args.by).map_err(Fault::input)?;
    let study = match args.same_level {
        true => study_of(&repeated(captures).map_err(Fault::input)?),
        false => study(&captures),
    };
    let study = study.map_err(Fault::input)?;
    let pretty = serde_json::to_string_pretty(&json(&study)).expect("bug: JSON");
    if let Some(out) = &args.out {
        let mut files = vec![
            ("repeat.md".to_owned(), markdown(&study)),
            ("repeat.json".to_owned(), pretty.clone()),
            ("repeat.csv".to_owned(), csv(&study)),
            ("repeat.html".to_owned(), page(&study)),
        ];
        let plots = study.girths.iter();
        files.extend(plots.map(|g| (format!("bland-altman-{}.svg", g.name), bland_altman_svg(g))));
        let files: Vec<(String, Vec<u8>)> = files
            .into_iter()
            .map(|(n, t)| (n, t.into_bytes()))
            .collect();
        delivery::write(out, &files).map_err(Fault::stage)?;
    }
    match global.json {
        true => command::outln!("{pretty}"),
        false => command::out!("{}", markdown(&study)),
    }
    Ok(())
}
