//! The record of a run: what its first line has, where it is, and which there are.

use crate::graph::Graph;
use crate::own;
use serde::{Deserialize, Serialize};
use stage::Files;
use std::collections::BTreeMap;
use std::io::Result;
use std::path::{Path, PathBuf};

/// What a run was of: another one of the same is its past.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Of {
    /// The pipeline's file.
    pub pipeline: String,
    /// Its variants.
    pub variant: Option<String>,
    /// Each input's folder.
    pub inputs: BTreeMap<String, String>,
}

impl Of {
    /// A pipeline with the files of each input.
    pub fn new(graph: &Graph, files: &[Files]) -> Of {
        let folder = |files: &Files| files.root.display().to_string();
        let inputs = graph.inputs.iter().zip(files);
        Of {
            pipeline: graph.origin.pipeline.clone(),
            variant: graph.origin.variant.clone(),
            inputs: inputs.map(|(i, f)| (i.name.clone(), folder(f))).collect(),
        }
    }
}

/// What a record has of the run as a whole.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Head {
    /// The program that wrote it.
    pub program: String,
    /// What the pipeline is for.
    #[serde(default)]
    pub about: String,
    /// What it was of.
    #[serde(default)]
    pub of: Of,
    /// How long it took. \[s\]
    pub seconds: f64,
    /// How many nodes were made.
    #[serde(default)]
    pub made: usize,
    /// How many nodes were found.
    #[serde(default)]
    pub found: usize,
    /// How many nodes failed.
    #[serde(default)]
    pub failed: usize,
    /// The run that made all that this one found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub same_as: Option<String>,
}

/// The files of each input: name and hash.
pub type FileLists = BTreeMap<String, Vec<(String, String)>>;

/// The record of a run.
pub fn run_file(store: &Path, id: &str) -> PathBuf {
    store.join("runs").join(format!("{id}.json"))
}

/// A run's own number.
pub(super) fn number(id: &str) -> u64 {
    let digits = id.split('-').next().unwrap_or("");
    digits.parse().unwrap_or(0)
}

/// The ids of all runs, the newest first.
///
/// # Errors
///
/// They cannot be listed.
pub(crate) fn all_ids(store: &Path) -> Result<Vec<String>> {
    let names = own::files(store, "runs", own::is_run)?.into_iter();
    let id = |name: String| Some(name.strip_suffix(".json")?.to_owned());
    let mut ids: Vec<String> = names.filter_map(id).collect();
    ids.reverse();
    Ok(ids)
}

/// Before runs were lines, all nodes were in the first.
#[derive(Deserialize)]
pub(super) struct Old<T> {
    pub(super) nodes: Vec<T>,
}
