//! Why a node would run, or ran: its lines against those of the last run of the same pipeline,
//! variant and input, and likewise all that it reads, back to every root cause.

use crate::graph::{Graph, Source};
use crate::key;
use crate::past::NodeLine;
use crate::past::{self, FileLists, Of};
use crate::plan::{Planned, State, changes};
use stage::{FileEntry, Files, Hash};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

/// A line that changed: what, old, new.
pub type Change = (String, String, String);

/// A node on the way to the causes.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// The node.
    pub node: usize,
    /// What a run would do with it.
    pub state: &'static str,
    /// What changed.
    pub changes: Vec<Change>,
}

/// Runs of the same, the newest first.
struct Past {
    store: PathBuf,
    same: Vec<String>,
}

impl Past {
    /// The node in the newest run that has a result of it and fits, and the run.
    fn find(&self, node: &str, fits: impl Fn(&NodeLine) -> bool) -> Option<(usize, NodeLine)> {
        let read = |(i, id): (usize, &String)| {
            let line = past::node(&self.store, id, node)?;
            (line.content.is_some() && fits(&line)).then_some((i, line))
        };
        self.same.iter().enumerate().find_map(read)
    }

    fn files(&self, run: Option<usize>) -> FileLists {
        let lists = run.and_then(|i| past::file_lists(&self.store, &self.same[i]));
        lists.unwrap_or_default()
    }
}

/// The node first, then what it reads and is to blame, each once.
pub fn causes(
    graph: &Graph,
    plan: &[Option<Planned>],
    files: &[Files],
    store: &Path,
    node: usize,
) -> Vec<Cause> {
    let of = Of::new(graph, files);
    let is_same = |id: &String| past::head(store, id).is_some_and(|head| head.of == of);
    let past = Past {
        store: store.into(),
        same: past::ids(store).into_iter().filter(is_same).collect(),
    };
    let (mut open, mut seen) = (VecDeque::from([node]), vec![false; graph.nodes.len()]);
    let mut causes = Vec::new();
    while let Some(at) = open.pop_front() {
        if std::mem::replace(&mut seen[at], true) {
            continue;
        }
        let node = &graph.nodes[at];
        let (state, mut changes, run) = stated(graph, plan, &past, at);
        let changed =
            |changes: &[Change], port: &str| changes.iter().any(|c| c.0 == format!("from {port}"));
        let wired = node.ports.iter().zip(&node.from);
        let mut named = Vec::new();
        for (port, source) in wired {
            match source {
                Some(Source::Node(j)) => {
                    let waits = |p: &Planned| p.state != State::Cached;
                    let to_blame = plan[*j].as_ref().is_some_and(waits);
                    if to_blame || changed(&changes, port.name) {
                        open.push_back(*j);
                    }
                }
                Some(Source::Input(j)) if changed(&changes, port.name) => {
                    let old = past.files(run).remove(&graph.inputs[*j].name);
                    named.extend(old.map_or(vec![], |old| differing(&old, &files[*j].entries)));
                }
                _ => {}
            }
        }
        changes.extend(named);
        causes.push(Cause {
            node: at,
            state,
            changes,
        });
    }
    causes
}

/// As [`causes`], against a run of another machine: the lines of its nodes, as a `run.json` has them. Nodes that are alike
/// there and here are left out, but for the node that is asked after; one that does not run here yet, for what it reads is not
/// known, is named by its stage and params.
pub fn against(
    graph: &Graph,
    plan: &[Option<Planned>],
    theirs: &[NodeLine],
    node: usize,
) -> Vec<Cause> {
    let (mut open, mut seen) = (VecDeque::from([node]), vec![false; graph.nodes.len()]);
    let mut causes = Vec::new();
    while let Some(at) = open.pop_front() {
        if std::mem::replace(&mut seen[at], true) {
            continue;
        }
        let bound = &graph.nodes[at];
        let inputs = plan[at].as_ref().and_then(|p| p.inputs.clone());
        let known = inputs.is_some();
        let inputs = inputs.unwrap_or_else(|| vec![None; bound.ports.len()]);
        let ours = key::provenance(bound, &inputs).0;
        let line = theirs.iter().find(|line| line.node == bound.name);
        let own = |line: &NodeLine| {
            let kept = line.provenance.iter();
            let kept = kept.filter(|(what, _)| known || !what.starts_with("from "));
            kept.cloned().collect::<Vec<_>>()
        };
        let ours: Vec<_> = ours
            .into_iter()
            .filter(|(what, _)| known || !what.starts_with("from "))
            .collect();
        let changes = match line {
            None => vec![("node".into(), "none in that run".into(), "there".into())],
            Some(line) if own(line) == ours => vec![],
            Some(line) => {
                let provenance = own(line);
                changes(
                    &ours,
                    Some(&NodeLine {
                        provenance,
                        ..line.clone()
                    }),
                )
            }
        };
        let read = |what: &str| changes.iter().any(|c| c.0 == format!("from {what}"));
        for (port, source) in bound.ports.iter().zip(&bound.from) {
            if let Some(Source::Node(j)) = source
                && (!known || read(port.name))
            {
                open.push_back(*j);
            }
        }
        if at == node || !changes.is_empty() {
            let state = if changes.is_empty() {
                "alike"
            } else {
                "differs"
            };
            causes.push(Cause {
                node: at,
                state,
                changes,
            });
        }
    }
    causes
}

/// A node's state, what changed, and against which run.
fn stated(
    graph: &Graph,
    plan: &[Option<Planned>],
    past: &Past,
    at: usize,
) -> (&'static str, Vec<Change>, Option<usize>) {
    let name = &graph.nodes[at].name;
    let last = || past.find(name, |_| true);
    let Some(planned) = &plan[at] else {
        return ("not wanted", vec![], None);
    };
    match &planned.state {
        State::Stale(lines) => ("will run", lines.clone(), last().map(|(i, _)| i)),
        State::May => ("may run", vec![], None),
        State::Cached => {
            let (changes, run) = since(graph, planned, past, at).unwrap_or_default();
            ("cached", changes, run)
        }
    }
}

/// What is otherwise now than in the last run; or, where that made the result as it is now, than in
/// the run before.
fn since(
    graph: &Graph,
    planned: &Planned,
    past: &Past,
    at: usize,
) -> Option<(Vec<Change>, Option<usize>)> {
    let node = &graph.nodes[at];
    let inputs: &[Option<Hash>] = planned.inputs.as_deref()?;
    let provenance = key::provenance(node, inputs);
    let key = provenance.key().to_hex().to_string();
    let is_now = |line: &NodeLine| line.key.as_ref() == Some(&key);
    let (run, last) = past.find(&node.name, |_| true)?;
    if !is_now(&last) {
        return Some((changes(&provenance.0, Some(&last)), Some(run)));
    }
    if last.status != "made" {
        return None;
    }
    let (before, line) = past.find(&node.name, |line| !is_now(line))?;
    Some((changes(&provenance.0, Some(&line)), Some(before)))
}

/// The files that differ: changed, new, gone.
fn differing(old: &[(String, String)], now: &[FileEntry]) -> Vec<Change> {
    let line = |name: &str, old: &str, new: &str| (format!("file {name}"), old.into(), new.into());
    let mut lines = Vec::new();
    for entry in now {
        let new = entry.content.to_hex();
        match old.iter().find(|(name, _)| *name == entry.name) {
            None => lines.push(line(&entry.name, "none", "new")),
            Some((_, old)) if old != new.as_str() => lines.push(line(&entry.name, old, &new)),
            Some(_) => {}
        }
    }
    let gone = |name: &str| !now.iter().any(|e| e.name == name);
    let gone = old.iter().filter(|(name, _)| gone(name));
    lines.extend(gone.map(|(name, _)| line(name, "there", "gone")));
    lines
}
