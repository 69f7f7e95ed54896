//! `tailor score`: results against ground truth.

use super::spoken::Spoken;
use crate::score::{iso_table, paper_tables, score, text};
use crate::words::messages::in_words;
use clap::Args;
use command::{Fault, GlobalArgs};
use stage::{Message, message};
use std::path::PathBuf;

stage::messages! {
    BEYOND = "cli-score-beyond": "{name} is {error:+.2} % off, not within {most} %";
    BEYOND_SURFACE = "cli-score-beyond-surface": "{name} is {error:+.2} % off at the plane that was measured, not within {most} %";
    NO_PERCENT = "cli-score-percent": "`{flag} {wanted}`: give NAME=PERCENT, such as WC=1";
    UNMEASURED = "cli-score-unmeasured": "{name} was not measured, or its truth is not known";
}

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
    /// Fail unless a girth's tape is within so many percent of the true surface's at the plane that was
    /// measured: NAME=PERCENT
    #[arg(long)]
    require_surface: Vec<String>,
    #[command(flatten)]
    spoken: Spoken,
}

/// Scores a result against ground truth.
pub(crate) fn scoring(args: &Scoring, global: &GlobalArgs) -> Result<(), Fault> {
    args.spoken.read(scored(args, global))
}

fn scored(args: &Scoring, global: &GlobalArgs) -> Result<(), Fault> {
    let words = args.spoken.words();
    let scores: Result<Vec<_>, _> = args.results.iter().map(|r| score(r, &args.truth)).collect();
    let scores = scores.map_err(Fault::of)?;
    if global.json {
        command::outln!(
            "{}",
            serde_json::to_string_pretty(&scores).expect("bug: JSON")
        );
    } else {
        scores
            .iter()
            .for_each(|s| command::out!("{}", text(s, &words)));
        if scores
            .iter()
            .any(|s| s.girths.values().flatten().next().is_some())
        {
            command::out!("\n{}", paper_tables(&scores, &words));
            if scores.len() > 1 {
                command::out!("\n{}", iso_table(&scores, &words));
            }
        }
    }
    let mut bad = Vec::new();
    for (name, most) in wanted("--require", &args.require)? {
        for score in &scores {
            let girth = score.girths.get(name).and_then(|g| g.as_ref());
            bad.extend(beyond(
                name,
                most,
                girth.and_then(|g| g.tape_error_pct),
                false,
            ));
        }
    }
    for (name, most) in wanted("--require-surface", &args.require_surface)? {
        for score in &scores {
            let share = score.girths_at_measured_planes.get(name);
            let share = share.and_then(|t| t.as_ref()).map(|t| t.tape_pct);
            bad.extend(beyond(name, most, share, true));
        }
    }
    match bad.is_empty() {
        true => Ok(()),
        false => {
            let bad: Vec<String> = bad.iter().map(|why| in_words(words, why)).collect();
            Err(Fault::stage(bad.join("\n")))
        }
    }
}

/// What is asked for: names and percents.
fn wanted<'a>(flag: &str, all: &'a [String]) -> Result<Vec<(&'a str, f64)>, Fault> {
    let one = |wanted: &'a String| {
        let parts = wanted.split_once('=');
        let parts = parts.and_then(|(name, most)| Some((name, most.parse().ok()?)));
        parts.ok_or_else(|| Fault::coded(&message!(NO_PERCENT, flag = flag, wanted = wanted)))
    };
    all.iter().map(one).collect()
}

/// What is wrong with an error in percent that must not be greater; `None` if nothing is.
fn beyond(name: &str, most: f64, error: Option<f64>, surface: bool) -> Option<Message> {
    match error {
        None => Some(message!(UNMEASURED, name = name)),
        Some(e) if e.is_nan() || e.abs() > most => Some(match surface {
            true => message!(BEYOND_SURFACE, name = name, error = e, most = most),
            false => message!(BEYOND, name = name, error = e, most = most),
        }),
        Some(_) => None,
    }
}
