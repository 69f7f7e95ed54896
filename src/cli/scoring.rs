//! `tailor score`: results against ground truth.

use super::{Fault, House};
use crate::score::{iso_table, paper_tables, score, text};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `tailor score`.
#[derive(Args)]
pub(crate) struct Scoring {
    /// Folders that `measure` wrote; several are repeated runs of one capture
    #[arg(required = true)]
    results: Vec<PathBuf>,
    /// The folder with the truth
    #[arg(long)]
    truth: PathBuf,
    /// Fail unless a girth is measured and its tape is within so many percent: NAME=PERCENT
    #[arg(long)]
    require: Vec<String>,
}

/// Does it.
pub(crate) fn scoring(args: &Scoring, house: &House) -> Result<(), Fault> {
    let scores: Result<Vec<_>, _> = args.results.iter().map(|r| score(r, &args.truth)).collect();
    let scores = scores.map_err(Fault::input)?;
    if house.json {
        super::outln!(
            "{}",
            serde_json::to_string_pretty(&scores).expect("bug: JSON")
        );
    } else {
        scores.iter().for_each(|s| super::out!("{}", text(s)));
        if scores
            .iter()
            .any(|s| s.girths.values().flatten().next().is_some())
        {
            super::out!("\n{}", paper_tables(&scores));
            if scores.len() > 1 {
                super::out!("\n{}", iso_table(&scores));
            }
        }
    }
    let mut bad = Vec::new();
    for wanted in &args.require {
        let shape = || {
            Fault::input(format!(
                "`--require {wanted}`: say NAME=PERCENT, such as WC=1"
            ))
        };
        let (name, most) = wanted.split_once('=').ok_or_else(shape)?;
        let most: f64 = most.parse().map_err(|_| shape())?;
        for score in &scores {
            let girth = score.girths.get(name).and_then(|g| g.as_ref());
            match girth.and_then(|g| g.tape_error_pct) {
                None => bad.push(format!(
                    "{name} was not measured, or its truth is not known"
                )),
                Some(e) if e.abs() > most => {
                    bad.push(format!("{name} is {e:+.2} % off, not within {most} %"))
                }
                Some(_) => {}
            }
        }
    }
    if bad.is_empty() {
        Ok(())
    } else {
        Err(Fault::stage(bad.join("\n")))
    }
}
