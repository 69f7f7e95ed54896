//! A run as a program's own texts are given it: one that has just ended, or one that was recorded.

use engine::Outcome;
use engine::graph::Graph;
use serde_json::Value;
use stage::{AnyArtifact, Artifact, Message};
use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

/// Reads the result of a node by its name.
type Read<'a> = Box<dyn Fn(&str) -> Option<AnyArtifact> + 'a>;

/// A run with its results.
pub struct Ran<'a> {
    /// Its pipeline.
    pub graph: &'a Graph,
    /// The folder of each input.
    pub folders: Cow<'a, [(String, PathBuf)]>,
    from: From<'a>,
}

enum From<'a> {
    Outcome(&'a Outcome),
    Record(Value, Read<'a>),
}

impl<'a> Ran<'a> {
    /// A run that has just ended.
    pub fn of(graph: &'a Graph, outcome: &'a Outcome, folders: &'a [(String, PathBuf)]) -> Self {
        Ran {
            graph,
            folders: folders.into(),
            from: From::Outcome(outcome),
        }
    }

    /// A run that was recorded, and who reads its results.
    pub(super) fn recorded(
        graph: &'a Graph,
        folders: Vec<(String, PathBuf)>,
        record: Value,
        read: Read<'a>,
    ) -> Self {
        Ran {
            graph,
            folders: folders.into(),
            from: From::Record(record, read),
        }
    }

    /// As `run.json` has it.
    pub fn record(&self) -> Cow<'_, Value> {
        match &self.from {
            From::Outcome(outcome) => Cow::Owned(outcome.json(self.graph)),
            From::Record(record, _) => Cow::Borrowed(record),
        }
    }

    /// The result of a node, if there is one of this kind.
    pub fn get<A: Artifact>(&self, node: &str) -> Option<Arc<A>> {
        let read = match &self.from {
            From::Outcome(outcome) => outcome.artifact(self.graph, self.graph.node(node)?),
            From::Record(_, read) => read(node),
        };
        read?.downcast()
    }

    /// The last result of a kind.
    pub fn last<A: Artifact>(&self) -> Option<Arc<A>> {
        let nodes = self.graph.nodes.iter().rev();
        let mut of_kind = nodes.filter(|node| node.stage.yields() == A::KIND);
        of_kind.find_map(|node| self.get(&node.name))
    }

    /// What its nodes warned of, each with the node's name.
    pub fn warnings(&self) -> Vec<(String, Message)> {
        let record = self.record();
        let nodes = record["nodes"].as_array().into_iter().flatten();
        let of = |node: &Value| {
            let name = node["node"].as_str().unwrap_or_default().to_owned();
            let all = node["warnings"].as_array().cloned().unwrap_or_default();
            let all = all
                .into_iter()
                .filter_map(|w| serde_json::from_value(w).ok());
            all.map(|message| (name.clone(), message))
                .collect::<Vec<_>>()
        };
        nodes.flat_map(of).collect()
    }
}
