//! `tailor score`: results against ground truth.

use super::{Fault, House};
use crate::score::{paper_tables, score, text};
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
    /// Fail unless every true girth is measured and its tape is within so many percent
    #[arg(long)]
    require_girths_pct: Option<f64>,
}

/// Does it.
pub(crate) fn scoring(args: &Scoring, house: &House) -> Result<(), Fault> {
    let scores: Result<Vec<_>, _> = args.results.iter().map(|r| score(r, &args.truth)).collect();
    let scores = scores.map_err(Fault::input)?;
    if house.json {
        println!(
            "{}",
            serde_json::to_string_pretty(&scores).expect("bug: JSON")
        );
    } else {
        scores.iter().for_each(|s| print!("{}", text(s)));
        if scores
            .iter()
            .any(|s| s.girths.values().flatten().next().is_some())
        {
            print!("\n{}", paper_tables(&scores));
        }
    }
    let Some(most) = args.require_girths_pct else {
        return Ok(());
    };
    let mut bad = Vec::new();
    for (name, girth) in scores
        .iter()
        .flat_map(|s| &s.girths)
        .filter(|(name, _)| *name != "HC_max")
    {
        match girth.as_ref().and_then(|g| g.tape_error_pct) {
            None => bad.push(format!("{name} was not measured")),
            Some(e) if e.abs() > most => bad.push(format!("{name} is {e:+.2} % off")),
            Some(_) => {}
        }
    }
    if scores.iter().all(|s| s.girths.is_empty()) {
        bad.push("the truth holds no girths".into());
    }
    if bad.is_empty() {
        Ok(())
    } else {
        Err(Fault::stage(bad.join("\n")))
    }
}
