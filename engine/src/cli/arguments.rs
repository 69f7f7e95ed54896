//! Arguments that many verbs take.

use super::budget::bytes;
use super::program::Program;
use crate::kind::Catalog;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// What every verb takes.
#[derive(Args, Clone)]
pub struct GlobalArgs {
    /// Answer in JSON
    #[arg(long, global = true)]
    pub json: bool,
    /// Where results are kept
    #[arg(long, global = true, default_value = "cache")]
    pub cache: PathBuf,
    /// How many threads work; one a core if not said, four a core at most
    #[arg(long, global = true)]
    pub threads: Option<NonZeroUsize>,
    /// What the cache may hold, such as 500M or 20G: what is worth least goes at the end of a run
    #[arg(long, global = true, value_parser = bytes)]
    pub max_size: Option<u64>,
    /// Say nothing but results and errors
    #[arg(long, global = true)]
    pub quiet: bool,
    /// The program whose command line it is.
    #[arg(skip)]
    pub program: Option<&'static Program>,
}

impl GlobalArgs {
    /// The program whose command line it is.
    pub fn program(&self) -> &'static Program {
        self.program.expect("bug: arguments of no program")
    }

    /// Its stages and kinds.
    pub fn catalog(&self) -> &'static Catalog {
        self.program().catalog
    }
}

/// What is to be run, and with what changed.
#[derive(Args, Clone)]
pub struct Wanted {
    /// The pipeline file, or the name of a built-in one
    pub pipeline: PathBuf,
    /// Nodes that are wanted instead of the pipeline's goal
    pub nodes: Vec<String>,
    #[command(flatten)]
    /// What is changed in it.
    pub change: Change,
}

/// What is changed on the command line.
#[derive(Args, Clone)]
pub struct Change {
    /// Hand over an input: NAME=FOLDER
    #[arg(long)]
    pub input: Vec<String>,
    /// A variant of the pipeline; several separated by commas
    #[arg(long)]
    pub variant: Option<String>,
    /// Another value for a param: NODE.PARAM=VALUE
    #[arg(long)]
    pub set: Vec<String>,
}

impl Change {
    /// Whether the pipeline is changed.
    pub fn changes(&self) -> bool {
        self.variant.is_some() || !self.set.is_empty()
    }
}
