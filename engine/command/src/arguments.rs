//! Arguments that many verbs take.

use super::program::GlobalArgs;
use clap::Args;
use engine::recipe::Pipeline;
use std::path::{Path, PathBuf};

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
#[derive(Args, Clone, Default)]
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

/// What `plan` and `why` are asked of, in any order.
#[derive(Args, Clone)]
pub(crate) struct Words {
    /// A pipeline file or the name of a built-in one (default: the program's own), and names of nodes
    #[arg(value_name = "PIPELINE|NODE")]
    words: Vec<String>,
    #[command(flatten)]
    change: Change,
}

impl Words {
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty() && !self.change.changes() && self.change.input.is_empty()
    }

    /// A verb of the program's own among them that should come first: nothing here is a pipeline.
    pub(crate) fn verb(&self, global: &GlobalArgs) -> Option<&'static str> {
        let file = |word: &String| word.ends_with(".toml") || Path::new(word).is_file();
        let known = |word: &String| file(word) || global.catalog().pipeline(word).is_some();
        let mut jobs = global.program().jobs.iter().map(|(verb, _)| *verb);
        let verb = jobs.find(|verb| self.words.iter().any(|word| word == verb));
        verb.filter(|_| !self.words.iter().any(known))
    }

    /// The pipeline, and the nodes of it that are named.
    pub(crate) fn wanted(&self, global: &GlobalArgs) -> Wanted {
        let is_file = |word: &String| word.ends_with(".toml") || Path::new(word).is_file();
        let built_in = |word: &String| global.catalog().pipeline(word).is_some();
        // A node may have a built-in pipeline's name: meant is the pipeline whose nodes the other words are.
        let whole = |word: &String| built_in(word) && self.are_nodes(word, Some(word), global);
        let at = |is: &dyn Fn(&String) -> bool| self.words.iter().position(is);
        let mut nodes = self.words.clone();
        let own = global.program().pipeline;
        let at = at(&is_file)
            .or_else(|| at(&whole))
            .or_else(|| at(&built_in));
        let pipeline = match (at, own) {
            (Some(at), _) => nodes.remove(at),
            (None, Some(own)) if self.are_nodes(own, None, global) => own.to_owned(),
            (None, _) if !nodes.is_empty() => nodes.remove(0),
            (None, own) => own.unwrap_or_default().to_owned(),
        };
        Wanted {
            pipeline: pipeline.into(),
            nodes,
            change: self.change.clone(),
        }
    }

    /// Whether all words but one are nodes of a built-in pipeline.
    fn are_nodes(&self, pipeline: &str, but: Option<&String>, global: &GlobalArgs) -> bool {
        let pipeline = Pipeline::built_in(pipeline, global.catalog());
        let nodes = pipeline.map_or(vec![], |p| p.recipe().nodes.clone());
        let known = |word: &String| nodes.iter().any(|n| n.name.value == *word);
        let words = self.words.iter();
        let mut words = words.filter(|word| but.is_none_or(|but| !std::ptr::eq(*word, but)));
        words.all(known)
    }
}
