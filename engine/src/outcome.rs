//! What came of a run: results by node, failures, the record of the run.

use crate::done::{Done, Status};
use crate::graph::{Bound, Graph};
use crate::history::RunSummary;
use crate::store::{Blob, InUse, Store};
use serde_json::Value;
use stage::{AnyArtifact, AnyStage, Artifact, Corrupt, Hash, Message};
use std::sync::Arc;

/// A run that came to an end.
pub struct Outcome {
    /// One entry a node, in the graph's order; `None` for those that were not wanted.
    pub nodes: Vec<Option<Done>>,
    /// The whole run took so long. \[s\]
    pub seconds: f64,
    /// The name and the stage of each node.
    pub(crate) names: Vec<(String, &'static dyn AnyStage)>,
    /// The content of each input.
    pub(crate) inputs: Vec<Hash>,
    pub(crate) store: Store,
    /// Results stay as long as somebody may read them.
    pub(crate) _using: InUse,
}

/// Why there is no result of a node to be read.
#[derive(Debug, thiserror::Error)]
pub enum ResultError {
    /// No node of that name.
    #[error("{0}")]
    Unknown(String),
    /// It was not wanted, failed, or was not reached.
    #[error("`{0}` has no result: it was not wanted, or it did not come to its end")]
    Missing(String),
    /// Not in the store any more.
    #[error("the result of `{0}` went out of the cache; run it again")]
    Gone(String),
    /// Not whole.
    #[error("the result of `{node}` cannot be read")]
    Corrupt {
        /// The node.
        node: String,
        /// What is wrong with it.
        source: Corrupt,
    },
    /// Another kind than was asked for.
    #[error("`{node}` makes {kind}, not {asked}")]
    Kind {
        /// The node.
        node: String,
        /// What it makes.
        kind: &'static str,
        /// What was asked for.
        asked: &'static str,
    },
}

impl Outcome {
    /// The bytes of the result of the node of a name, verified, and its stage.
    ///
    /// # Errors
    ///
    /// Where there is no such node, or no result of it.
    pub fn blob(&self, name: &str) -> Result<(Blob, &'static dyn AnyStage), ResultError> {
        let Some(at) = self.names.iter().position(|(node, _)| node == name) else {
            let known: Vec<&str> = self.names.iter().map(|(node, _)| node.as_str()).collect();
            return Err(ResultError::Unknown(
                stage::unknown("node", name, &known).into(),
            ));
        };
        let (node, stage) = (name.to_owned(), self.names[at].1);
        let Some(content) = self.nodes[at].as_ref().and_then(|done| done.content) else {
            return Err(ResultError::Missing(node));
        };
        match self.store.blob(content) {
            Some(blob) => Ok((blob, stage)),
            None => Err(ResultError::Gone(node)),
        }
    }

    /// The result of the node of a name.
    ///
    /// # Errors
    ///
    /// As [`Outcome::blob`], and where it is of another kind.
    pub fn read<A: Artifact>(&self, name: &str) -> Result<Arc<A>, ResultError> {
        let (blob, stage) = self.blob(name)?;
        let node = name.to_owned();
        let artifact = match stage.read(&blob) {
            Ok(artifact) => artifact,
            Err(source) => return Err(ResultError::Corrupt { node, source }),
        };
        let (kind, asked) = (stage.yields(), A::KIND);
        artifact
            .downcast()
            .ok_or(ResultError::Kind { node, kind, asked })
    }

    /// The result of a node, out of the store.
    pub fn artifact(&self, graph: &Graph, node: usize) -> Option<AnyArtifact> {
        let content = self.nodes[node].as_ref()?.content?;
        graph.nodes[node]
            .stage
            .read(&self.store.blob(content)?)
            .ok()
    }

    /// The bytes of a node's result, out of the store.
    pub fn bytes(&self, node: usize) -> Option<Vec<u8>> {
        let content = self.nodes[node].as_ref()?.content?;
        Some(self.store.blob(content)?.to_vec())
    }

    /// The first failure: node and why.
    pub fn failure<'a>(&'a self, graph: &'a Graph) -> Option<(&'a str, &'a Message)> {
        self.failures(graph).into_iter().next()
    }

    /// All failures: node and why.
    pub fn failures<'a>(&'a self, graph: &'a Graph) -> Vec<(&'a str, &'a Message)> {
        let nodes = self.nodes.iter().zip(&graph.nodes);
        let why = |(done, node): (&'a Option<Done>, &'a Bound)| match &done.as_ref()?.status {
            Status::Failed(why) => Some((node.name.as_str(), why)),
            _ => None,
        };
        nodes.filter_map(why).collect()
    }

    /// Whether the user asked to stop before all was done.
    pub fn cancelled(&self) -> bool {
        self.nodes
            .iter()
            .flatten()
            .any(|done| done.status == Status::Cancelled)
    }

    /// The run with its provenance, for `run.json`.
    pub fn json(&self, graph: &Graph) -> Value {
        let summary = RunSummary {
            graph,
            nodes: &self.nodes,
            inputs: &self.inputs,
            seconds: self.seconds,
        };
        serde_json::to_value(summary.record()).expect("bug: JSON")
    }
}
