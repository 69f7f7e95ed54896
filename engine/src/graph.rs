//! A pipeline whose every name means something: what the walk runs.

use programs::Catalog;
use programs::Program;
use stage::{AnyStage, Checked, PortSpec};
use std::sync::Arc;

/// Where a port gets its artifact from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// From a node, by its place in [`Graph::nodes`].
    Node(usize),
    /// From the user, by its place in [`Graph::inputs`].
    Input(usize),
}

/// A node whose stage, ports and params were found good.
#[derive(Clone)]
pub struct Bound {
    /// Its name in the pipeline.
    pub name: String,
    /// What it does.
    pub stage: &'static dyn AnyStage,
    /// The stage's ports.
    pub ports: Arc<[PortSpec]>,
    /// With what params.
    pub params: Checked,
    /// From where: one entry a port, in the stage's order; `None` where an optional port is open.
    pub from: Vec<Option<Source>>,
    /// The program that it runs, where its stage is `exec`.
    pub program: Option<Arc<Program>>,
}

/// Files that the user hands over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputDecl {
    /// Its name, without the `@`.
    pub name: String,
    /// What it is.
    pub about: String,
    /// Patterns of the files that belong to it, relative to its folder: `images/*.jpg`.
    pub files: Vec<String>,
}

/// The word in place of a node where shared params are changed: `--set params.cell_mm=2`.
pub const SHARED: &str = "params";

/// A pipeline that can run. Made by binding a recipe; nodes are in topological order.
#[derive(Clone)]
pub struct Graph {
    /// The nodes, each after all that it reads.
    pub nodes: Vec<Bound>,
    /// The user's files.
    pub inputs: Vec<InputDecl>,
    /// The nodes that are wanted by default.
    pub goal: Vec<usize>,
    /// What the pipeline is for.
    pub about: String,
    /// Where it comes from; no part of any key.
    pub origin: Origin,
    /// Shared params, each with a node that reads it.
    pub shared: Vec<(String, String)>,
    /// The stages that it is made of, and the kinds that flow.
    pub catalog: &'static Catalog,
}

/// Where a pipeline comes from.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Origin {
    /// Its file, or the name of its text.
    pub pipeline: String,
    /// Its variants, as they were asked for.
    pub variant: Option<String>,
}

impl Graph {
    /// The place of the node of a name.
    pub fn node(&self, name: &str) -> Option<usize> {
        self.nodes.iter().position(|node| node.name == name)
    }

    /// The node whose result it takes to write results of this node: the first of the kind beside.
    pub fn beside(&self, node: usize) -> Option<usize> {
        let kind = self.catalog.kind(self.nodes[node].stage.yields())?;
        let of_kind = |beside| self.nodes.iter().position(|n| n.stage.yields() == beside);
        kind.beside.and_then(of_kind)
    }

    /// The places of the nodes that a param reaches at once: the node that has it, or with
    /// `params` for a node all that share it.
    pub fn holders(&self, node: &str, param: &str) -> Vec<usize> {
        if node != SHARED {
            return self.node(node).into_iter().collect();
        }
        let readers = self.shared.iter().filter(|(shared, _)| shared == param);
        readers.filter_map(|(_, node)| self.node(node)).collect()
    }
}
