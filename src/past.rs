//! The records of earlier runs, read back: what a node was the last time, what stays, what goes.

use serde_json::Value;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The record of a run.
pub(crate) fn run_file(store: &Path, id: &str) -> PathBuf {
    store.join("runs").join(format!("{id}.json"))
}

/// The ids of all runs, the newest first.
pub(crate) fn ids(store: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(store.join("runs")).into_iter().flatten();
    let id = |e: std::fs::DirEntry| Some(e.file_name().to_str()?.strip_suffix(".json")?.to_owned());
    let mut ids: Vec<String> = entries.filter_map(|e| id(e.ok()?)).collect();
    ids.sort_by(|a, b| b.cmp(a));
    ids
}

fn load(store: &Path, id: &str) -> Option<Value> {
    serde_json::from_slice(&std::fs::read(run_file(store, id)).ok()?).ok()
}

/// The contents of all results of the last so many runs, and of those that are named.
pub(crate) fn contents(store: &Path, last: usize, named: &BTreeSet<String>) -> BTreeSet<String> {
    let ids = ids(store);
    let named = named
        .iter()
        .filter(|id| !ids[..last.min(ids.len())].contains(id));
    let mut contents = BTreeSet::new();
    for id in ids.iter().take(last).chain(named) {
        let run = load(store, id).unwrap_or_default();
        let base = run["same_as"].as_str().and_then(|base| load(store, base));
        let nodes = base.as_ref().unwrap_or(&run)["nodes"].as_array();
        let content = |node: &Value| node["content"].as_str().map(str::to_owned);
        contents.extend(nodes.into_iter().flatten().filter_map(content));
    }
    contents
}

/// Removes the records and logs of all but the last so many runs, of those that are named, and of
/// those that another one refers to. Returns how many went, or would go.
pub(crate) fn prune(store: &Path, keep: usize, named: &BTreeSet<String>, dry_run: bool) -> usize {
    let ids = ids(store);
    let mut stays: BTreeSet<String> = ids.iter().take(keep.max(1)).cloned().collect();
    stays.extend(named.iter().cloned());
    let base = |id: &String| load(store, id)?["same_as"].as_str().map(str::to_owned);
    let bases: Vec<String> = stays.iter().filter_map(base).collect();
    stays.extend(bases);
    let going: Vec<&String> = ids.iter().filter(|id| !stays.contains(*id)).collect();
    for id in going.iter().filter(|_| !dry_run) {
        let log = store.join("runs").join(format!("{id}.jsonl"));
        let _ = std::fs::remove_file(log);
        let _ = std::fs::remove_file(run_file(store, id));
    }
    going.len()
}

/// The records of earlier runs in a store, the newest first, with their ids.
pub fn runs(store: &Path) -> Vec<(String, Value)> {
    let mut bases: BTreeMap<String, Value> = BTreeMap::new();
    let mut read = |id: String| {
        let run = load(store, &id)?;
        let Some(base) = run["same_as"].as_str() else {
            return Some((id, run));
        };
        if !bases.contains_key(base) {
            bases.insert(base.to_owned(), load(store, base)?);
        }
        let mut whole = bases[base].clone();
        whole["seconds"] = run["seconds"].clone();
        for node in whole["nodes"].as_array_mut()? {
            node["fate"] = "found".into();
        }
        Some((id, whole))
    };
    ids(store).into_iter().filter_map(&mut read).collect()
}

/// Earlier runs, read one by one as far back as somebody asks.
pub struct History {
    store: PathBuf,
    state: RefCell<Read>,
}

#[derive(Default)]
struct Read {
    left: Vec<String>,
    /// Nodes with a result of each run that was read, the newest first.
    runs: Vec<BTreeMap<String, Value>>,
}

/// As far back as it goes.
const MOST_RUNS: usize = 64;

impl History {
    /// Of a store.
    pub fn of(store: &Path) -> History {
        let mut left = ids(store);
        left.reverse();
        let runs = vec![];
        History {
            store: store.into(),
            state: RefCell::new(Read { left, runs }),
        }
    }

    /// The node's entry in the newest run that has one with a result.
    pub fn last(&self, node: &str) -> Option<Value> {
        let mut state = self.state.borrow_mut();
        let mut at = 0;
        loop {
            if at == state.runs.len() && !self.read_one(&mut state) {
                return None;
            }
            if let Some(entry) = state.runs[at].get(node) {
                return Some(entry.clone());
            }
            at += 1;
        }
    }

    /// Reads one run further back.
    fn read_one(&self, state: &mut Read) -> bool {
        while let Some(id) = state.left.pop().filter(|_| state.runs.len() < MOST_RUNS) {
            let Some(mut run) = load(&self.store, &id) else {
                continue;
            };
            // A run that found all of an earlier one has nothing that the earlier one has not.
            let Some(nodes) = run["nodes"].as_array_mut() else {
                continue;
            };
            let named = |node: Value| Some((node["node"].as_str()?.to_owned(), node));
            let with_result = nodes.drain(..).filter(|n| !n["content"].is_null());
            state.runs.push(with_result.filter_map(named).collect());
            return true;
        }
        false
    }
}
