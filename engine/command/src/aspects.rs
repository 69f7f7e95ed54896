//! What `plan` answers beside what would run: why a node would, what a param reaches, a drawing, mistakes.

use super::arguments::{Wanted, Words};
use super::fault::Fault;
use super::open::open;
use super::planned::{Answer, of_verb, of_words, planned};
use super::program::GlobalArgs;
use super::why::why_of;
use super::{answers, impact};
use clap::{ArgMatches, Args};
use std::path::PathBuf;

/// The flags of `plan` for it, one at a time.
#[derive(Args)]
pub(super) struct Aspects {
    /// Which lines of what NODE depends on changed: old, new, back to the root cause
    #[arg(long, value_name = "NODE", conflicts_with_all = ["reach", "format", "check", "strands"])]
    why: Option<String>,
    /// With --why: against the run of this run.json, of this machine or another, instead of the last run of the same here
    #[arg(long, value_name = "RUN.JSON", requires = "why")]
    against: Option<PathBuf>,
    /// Which nodes a param reaches (PARAM or NODE.PARAM; `all` is every param), and what changing it costs
    #[arg(long, value_name = "PARAM", conflicts_with_all = ["format", "check", "strands"])]
    reach: Vec<String>,
    /// The pipeline as a drawing: dot or mermaid
    #[arg(long = "as", value_name = "FORMAT", conflicts_with_all = ["check", "strands"])]
    format: Option<String>,
    /// All mistakes of the pipeline at once
    #[arg(long, conflicts_with = "strands")]
    check: bool,
}

/// Verb of the program's own, with its words.
type OfVerb<'a> = Option<(&'a str, &'a ArgMatches)>;

impl Aspects {
    /// Answers, where one of them is asked for.
    pub(super) fn answer(
        &self,
        words: &Words,
        verb: OfVerb,
        global: &GlobalArgs,
    ) -> Option<Result<(), Fault>> {
        if let Some(node) = &self.why {
            return Some(self.why(node, (words, verb), global));
        }
        if let Some(format) = &self.format {
            return Some(answers::drawn(format, (words, verb), global));
        }
        if self.check {
            return Some(checked((words, verb), global));
        }
        match self.reach.is_empty() {
            true => None,
            false => Some(self.reached((words, verb), global)),
        }
    }

    fn why(
        &self,
        node: &str,
        (words, verb): (&Words, OfVerb),
        global: &GlobalArgs,
    ) -> Result<(), Fault> {
        let answer = match verb {
            Some(verb) => Answer::of_job(of_verb(verb, global, words)?, global)?,
            None => {
                let wanted = of_words(words, global)?;
                if let Some(more) = wanted.nodes.first() {
                    let what = format!("--why asks after `{node}`; `{more}` is one too many");
                    return Err(Fault::input(what));
                }
                planned(&wanted, global)?
            }
        };
        why_of(&answer, node, self.against.as_deref(), global)
    }

    fn reached(&self, (words, verb): (&Words, OfVerb), global: &GlobalArgs) -> Result<(), Fault> {
        let graph = match verb {
            Some(verb) => of_verb(verb, global, words)?.graph,
            None => {
                let whole = Wanted {
                    nodes: vec![],
                    ..of_words(words, global)?
                };
                open(&whole, global)?.0
            }
        };
        let asked = self.reach.iter().filter(|name| *name != "all");
        impact::reached(&graph, &asked.collect::<Vec<_>>(), global)
    }
}

fn checked((words, verb): (&Words, OfVerb), global: &GlobalArgs) -> Result<(), Fault> {
    if let Some((verb, _)) = verb {
        let what = format!("--check reads a pipeline: give its file or its name, not `{verb}`");
        return Err(Fault::input(what));
    }
    answers::check(&of_words(words, global)?.pipeline, global)
}
