//! The records of earlier runs, read back: what a node was the last time, what stays, what goes.
//!
//! A record is lines of JSON: what the run was, its files, then one line a node. So what is asked
//! is read, and not the whole. A run that found all that an earlier one had is the first line only.
//! Runs have numbers of their own: no clock says which was the last.

use crate::graph::Graph;
use crate::own;
use crate::system::{FileKind, nofollow};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use stage::{Files, Message};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader, Lines};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

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

/// What a record says of the run as a whole.
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

/// A node's line, as it is read back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NodeLine {
    /// Its name in the pipeline.
    pub node: String,
    /// The content of its result.
    pub content: Option<String>,
    /// Its stage.
    pub stage: String,
    /// The stage's version.
    pub version: u32,
    /// What became of it.
    #[serde(alias = "fate")]
    pub status: String,
    /// Why it failed.
    pub why: Option<Message>,
    /// The key of its result.
    pub key: Option<String>,
    /// What the key was made of.
    #[serde(alias = "story")]
    pub provenance: Vec<(String, String)>,
    /// How long it took: now, or when it was made. \[s\]
    pub seconds: f64,
    /// Size of the result. \[bytes\]
    pub bytes: u64,
    /// Numbers beside the result.
    pub metrics: Vec<Value>,
    /// What the user should know.
    pub warnings: Vec<Message>,
}

/// The files of each input: name and hash.
pub type FileLists = BTreeMap<String, Vec<(String, String)>>;

/// The record of a run.
pub fn run_file(store: &Path, id: &str) -> PathBuf {
    store.join("runs").join(format!("{id}.json"))
}

/// `last`, `last~1`, …: how many runs ago.
pub fn ago(text: &str) -> Option<usize> {
    match text.strip_prefix("last")? {
        "" => Some(0),
        rest => rest.strip_prefix('~')?.parse().ok(),
    }
}

/// A run's own number.
fn number(id: &str) -> u64 {
    let digits = id.split('-').next().unwrap_or("");
    digits.parse().unwrap_or(0)
}

/// The ids of all runs, the newest first.
pub fn ids(store: &Path) -> Vec<String> {
    let names = own::files(store, "runs", own::is_run).into_iter();
    let id = |name: String| Some(name.strip_suffix(".json")?.to_owned());
    let mut ids: Vec<String> = names.filter_map(id).collect();
    ids.reverse();
    ids
}

/// An id after all that there are.
pub fn next_id(store: &Path) -> String {
    static LAST: AtomicU64 = AtomicU64::new(0);
    let newest = nofollow::folder(store, &["runs"]).map_or(0, |at| {
        let names = nofollow::inside(&at, FileKind::File, own::is_run);
        names.last().map_or(0, |name| number(name))
    });
    let next = |last: u64| Some(last.max(newest) + 1);
    let last = LAST.fetch_update(Ordering::Relaxed, Ordering::Relaxed, next);
    let now = last.unwrap_or(0).max(newest) + 1;
    format!("{now:020}-{}", std::process::id())
}

fn lines(store: &Path, id: &str) -> Option<Lines<BufReader<File>>> {
    Some(BufReader::new(File::open(run_file(store, id)).ok()?).lines())
}

/// What a record says of the run as a whole.
pub fn head(store: &Path, id: &str) -> Option<Head> {
    serde_json::from_str(&lines(store, id)?.next()?.ok()?).ok()
}

/// The nodes of a run, one by one; those of the run that made them where it found all.
pub fn nodes(store: &Path, id: &str) -> Option<impl Iterator<Item = NodeLine> + use<>> {
    let (found, nodes) = nodes_as::<NodeLine>(store, id)?;
    Some(nodes.map(move |mut node| {
        if found {
            node.status = "found".into();
        }
        node
    }))
}

/// As [`nodes`], what somebody asks of them; and whether all were found, whatever their lines say.
pub fn nodes_as<T: DeserializeOwned>(
    store: &Path,
    id: &str,
) -> Option<(bool, impl Iterator<Item = T> + use<T>)> {
    let head = head(store, id)?;
    let found = head.same_as.is_some();
    let mut lines = lines(store, head.same_as.as_deref().unwrap_or(id))?;
    let first = lines.next()?.ok()?;
    // Before runs were lines, all nodes stood in the first.
    let old = serde_json::from_str::<Old<T>>(&first).map_or(vec![], |old| old.nodes);
    let node = |line: std::io::Result<String>| serde_json::from_str::<T>(&line.ok()?).ok();
    Some((found, old.into_iter().chain(lines.skip(1).filter_map(node))))
}

#[derive(Deserialize)]
struct Old<T> {
    nodes: Vec<T>,
}

/// A node of a run, found without reading the others.
pub fn node(store: &Path, id: &str, name: &str) -> Option<NodeLine> {
    let head = head(store, id)?;
    let found = head.same_as.is_some();
    let begin = format!("{{\"node\":{},", json!(name));
    let mut lines = lines(store, head.same_as.as_deref().unwrap_or(id))?.skip(2);
    let line = lines.find(|line| line.as_ref().is_ok_and(|l| l.starts_with(&begin)))?;
    let mut node: NodeLine = serde_json::from_str(&line.ok()?).ok()?;
    if found {
        node.status = "found".into();
    }
    Some(node)
}

/// The files that a run read.
pub fn file_lists(store: &Path, id: &str) -> Option<FileLists> {
    let head = head(store, id)?;
    let mut lines = lines(store, head.same_as.as_deref().unwrap_or(id))?;
    serde_json::from_str(&lines.nth(1)?.ok()?).ok()
}

/// The record of a run as one value.
pub fn run(store: &Path, id: &str) -> Option<Value> {
    let head = head(store, id)?;
    let nodes: Vec<NodeLine> = nodes(store, id)?.collect();
    Some(json!({
        "program": head.program, "about": head.about, "seconds": head.seconds, "nodes": nodes,
    }))
}

/// The records of earlier runs in a store, the newest first, with their ids.
pub fn runs(store: &Path) -> impl Iterator<Item = (String, Value)> + use<> {
    let root = store.to_owned();
    ids(store)
        .into_iter()
        .filter_map(move |id| Some((id.clone(), run(&root, &id)?)))
}

/// The contents of all results of the last so many runs, and of those that are named.
pub fn contents(store: &Path, last: usize, named: &BTreeSet<String>) -> BTreeSet<String> {
    let ids = ids(store);
    let named = named
        .iter()
        .filter(|id| !ids[..last.min(ids.len())].contains(id));
    let mut contents = BTreeSet::new();
    for id in ids.iter().take(last).chain(named) {
        let nodes = nodes(store, id).into_iter().flatten();
        contents.extend(nodes.filter_map(|node| node.content));
    }
    contents
}

/// Removes the records and logs of all but the last so many runs, of those that are named, and of
/// those that another one refers to. Returns how many went, or would go.
pub fn prune(store: &Path, keep: usize, named: &BTreeSet<String>, dry_run: bool) -> usize {
    let ids = ids(store);
    let mut stays: BTreeSet<String> = ids.iter().take(keep.max(1)).cloned().collect();
    let oldest = stays.first().map_or(0, |id| number(id));
    stays.extend(named.iter().cloned());
    let base = |id: &String| head(store, id)?.same_as;
    let bases: Vec<String> = stays.iter().filter_map(base).collect();
    stays.extend(bases);
    let going: Vec<&String> = ids.iter().filter(|id| !stays.contains(*id)).collect();
    if dry_run {
        return going.len();
    }
    for id in &going {
        own::remove(store, &["runs"], &format!("{id}.json"));
    }
    // Logs also of runs that were killed, and left no record.
    for name in own::files(store, "runs", own::is_run) {
        let log = name.strip_suffix(".jsonl");
        if log.is_some_and(|id| !stays.contains(id) && number(id) < oldest) {
            own::remove(store, &["runs"], &name);
        }
    }
    going.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_grow_whatever_there_is() {
        let folder = tempfile::tempdir().unwrap();
        let runs = folder.path().join("runs");
        std::fs::create_dir(&runs).unwrap();
        let far = format!("{:020}-7", 2_208_988_800_000_000_000u64);
        std::fs::write(runs.join(format!("{far}.json")), "{}").unwrap();
        std::fs::write(runs.join("99999999999999999999-1.json"), "{}").unwrap();
        let next = next_id(folder.path());
        assert!(next > far && next_id(folder.path()) > next, "{next}");
        assert_eq!(ids(folder.path()), [far]);
    }
}
