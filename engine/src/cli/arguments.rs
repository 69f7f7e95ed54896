//! Arguments that many verbs take.

use clap::Args;
use std::path::PathBuf;

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
