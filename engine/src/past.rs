//! The records of earlier runs, read back: what a node was the last time, what stays, what goes.
//!
//! A record is lines of JSON: what the run was, its files, then one line a node. So what is asked
//! is read, and not the whole. A run that found all that an earlier one had is the first line only.
//! Runs have numbers of their own: no clock decides which was the last.

mod read;
mod record;

use crate::own;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use stage::Message;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Lines, Result};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

pub use read::contents;
pub(crate) use read::{read_file_lists, read_head};
pub(crate) use record::all_ids;
pub use record::{FileLists, Head, Of, run_file};
use record::{Old, number};

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

/// `last`, `last~1`, …: how many runs ago.
pub fn ago(text: &str) -> Option<usize> {
    match text.strip_prefix("last")? {
        "" => Some(0),
        rest => rest.strip_prefix('~')?.parse().ok(),
    }
}

/// The ids of all runs, the newest first; none if they cannot be listed.
pub fn ids(store: &Path) -> Vec<String> {
    all_ids(store).unwrap_or_default()
}

/// An id after all that there are.
///
/// # Errors
///
/// They cannot be listed: another run may have any number.
pub(crate) fn next_id(store: &Path) -> Result<String> {
    static LAST: AtomicU64 = AtomicU64::new(0);
    let names = own::files(store, "runs", own::is_run)?;
    let newest = names.last().map_or(0, |name| number(name));
    let next = |last: u64| Some(last.max(newest) + 1);
    let last = LAST.fetch_update(Ordering::Relaxed, Ordering::Relaxed, next);
    let now = last.unwrap_or(0).max(newest) + 1;
    Ok(format!("{now:020}-{}", std::process::id()))
}

fn lines(store: &Path, id: &str) -> Option<Lines<BufReader<File>>> {
    read::all_lines(store, id).ok()?
}

/// What a record has of the run as a whole.
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

/// As [`nodes`], what somebody asks of them; and whether all were found, whatever status their lines have.
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
    let node = |line: Result<String>| serde_json::from_str::<T>(&line.ok()?).ok();
    Some((found, old.into_iter().chain(lines.skip(1).filter_map(node))))
}

/// A node of a run, found without reading the rest.
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

/// Removes the records and logs of all but the last so many runs, of those that are named, and of
/// those that another one refers to. Returns how many went, or would go.
///
/// # Errors
///
/// The disk refuses before anything went.
pub fn prune(store: &Path, keep: usize, named: &BTreeSet<String>, dry_run: bool) -> Result<usize> {
    let ids = all_ids(store)?;
    let mut stays: BTreeSet<String> = ids.iter().take(keep.max(1)).cloned().collect();
    let oldest = stays.first().map_or(0, |id| number(id));
    stays.extend(named.iter().cloned());
    let mut bases = Vec::new();
    for id in &stays {
        bases.extend(read_head(store, id)?.and_then(|head| head.same_as));
    }
    stays.extend(bases);
    let going: Vec<&String> = ids.iter().filter(|id| !stays.contains(*id)).collect();
    let logs = own::files(store, "runs", own::is_run)?;
    if dry_run {
        return Ok(going.len());
    }
    for id in &going {
        own::remove(store, &["runs"], &format!("{id}.json"));
    }
    // Logs also of runs that were killed, and left no record.
    for name in logs {
        let log = name.strip_suffix(".jsonl");
        if log.is_some_and(|id| !stays.contains(id) && number(id) < oldest) {
            own::remove(store, &["runs"], &name);
        }
    }
    Ok(going.len())
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
        let next = next_id(folder.path()).unwrap();
        assert!(
            next > far && next_id(folder.path()).unwrap() > next,
            "{next}"
        );
        assert_eq!(ids(folder.path()), [far]);
    }
}
