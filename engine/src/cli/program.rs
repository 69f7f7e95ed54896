//! A program: a trade's catalog, and what it adds to the engine's command line.

use super::arguments::GlobalArgs;
use super::fault::Fault;
use crate::graph::Graph;
use crate::kind::Catalog;
use crate::session::Outcome;
use clap::{ArgMatches, Command};
use stage::Metric;
use std::path::Path;

/// A program. [`Program::new`] has the engine's verbs and nothing else.
pub struct Program {
    /// What it is called on the command line.
    pub name: &'static str,
    /// Its version.
    pub version: &'static str,
    /// What it does, in a sentence.
    pub about: &'static str,
    /// Its stages and kinds.
    pub catalog: &'static Catalog,
    /// The variable of the environment that says where results are kept.
    pub cache_env: &'static str,
    /// The variable of the environment that says how much the cache may hold.
    pub size_env: &'static str,
    /// The built-in pipeline that is meant where none is said.
    pub pipeline: Option<&'static str>,
    /// Verbs of its own, before the engine's.
    pub verbs: &'static [Verb],
    /// What a page in HTML that a run writes gets from the run: its warnings, how it was made.
    pub complete: fn(&[u8], &Outcome, &Graph) -> Vec<u8>,
    /// Errors of results against a folder of ground truth, for `sweep --truth`.
    pub errors: fn(&Graph, &Outcome, &Path) -> Result<Vec<Metric>, String>,
}

/// A verb of a program's own.
pub struct Verb {
    /// The word.
    pub name: &'static str,
    /// Adds its arguments and its help.
    pub arguments: fn(Command) -> Command,
    /// Does it.
    pub run: fn(&ArgMatches, &GlobalArgs) -> Result<(), Fault>,
    /// Whether it runs stages: then the cache is swept after it if it is over its size.
    pub runs: bool,
}

impl Program {
    /// With the engine's verbs alone.
    pub const fn new(
        name: &'static str,
        version: &'static str,
        about: &'static str,
        catalog: &'static Catalog,
    ) -> Program {
        Program {
            name,
            version,
            about,
            catalog,
            cache_env: "STAGE_CACHE",
            size_env: "STAGE_MAX_SIZE",
            pipeline: None,
            verbs: &[],
            complete: |page, _, _| page.to_vec(),
            errors: |_, _, _| Err("this program has no ground truth".into()),
        }
    }
}
