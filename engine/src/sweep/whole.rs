//! The graphs of many points as one: what has one recipe and reads the same is one node.

use crate::graph::{Bound, Graph, InputDecl, Source};
use crate::key::{self, Digest, Ledger};
use crate::session::{self, EngineError};
use crate::store::Store;
use stage::{Files, Hash};
use std::collections::HashMap;
use std::path::PathBuf;

/// A point's graph, and where its nodes and inputs are in the whole.
pub(crate) struct Member {
    pub(crate) graph: Graph,
    /// The nodes that are asked.
    pub(crate) wanted: Vec<usize>,
    /// One entry a node; `None` for those that are not needed.
    pub(crate) places: Vec<Option<usize>>,
    /// One entry an input.
    pub(crate) inputs: Vec<usize>,
}

/// All graphs together.
#[derive(Default)]
pub(crate) struct Whole {
    nodes: Vec<Bound>,
    /// The place of a node by its recipe and what it reads.
    known: HashMap<Hash, usize>,
    /// Each with its folder, as it was given.
    inputs: Vec<(InputDecl, PathBuf)>,
    /// The files of each input.
    pub(crate) files: Vec<Files>,
    /// Their content.
    pub(crate) contents: Vec<Hash>,
    like: Option<Graph>,
}

impl Whole {
    /// Adds a graph with all that the wanted nodes need, and reads its inputs that are not read yet.
    ///
    /// # Errors
    ///
    /// An input has no folder, is unknown, or cannot be read.
    pub(crate) fn add(
        &mut self,
        graph: Graph,
        wanted: Vec<usize>,
        folders: &[(String, PathBuf)],
        store: &Store,
    ) -> Result<Member, EngineError> {
        let inputs = self.inputs_of(&graph, folders, store)?;
        Ok(self.put(graph, wanted, inputs))
    }

    /// The places of a graph's inputs, which are read if they are not yet.
    fn inputs_of(
        &mut self,
        graph: &Graph,
        folders: &[(String, PathBuf)],
        store: &Store,
    ) -> Result<Vec<usize>, EngineError> {
        let given = |input: &InputDecl| {
            let given = folders.iter().find(|(name, _)| *name == input.name);
            given.map(|(_, folder)| folder.clone()).unwrap_or_default()
        };
        let all: Vec<(InputDecl, PathBuf)> =
            graph.inputs.iter().map(|i| (i.clone(), given(i))).collect();
        let is_known = |one: &(InputDecl, PathBuf)| self.inputs.contains(one);
        // The first graph's folders are looked at even if it reads none: some may be unknown.
        if self.like.is_none() || !all.iter().all(is_known) {
            let files = session::inputs(graph, folders, store)?;
            for (one, files) in all.iter().zip(files) {
                if !self.inputs.contains(one) {
                    let content = stage::content(&files);
                    store.note_capture(content, &files);
                    self.inputs.push(one.clone());
                    self.contents.push(content);
                    self.files.push(files);
                }
            }
        }
        let place = |one: &(InputDecl, PathBuf)| self.inputs.iter().position(|i| i == one);
        let places = all.iter().map(place);
        Ok(places
            .map(|p| p.expect("bug: an input that was not read"))
            .collect())
    }

    /// Adds a graph whose inputs are read.
    fn put(&mut self, graph: Graph, wanted: Vec<usize>, inputs: Vec<usize>) -> Member {
        let needed = crate::walk::needed(&graph, &wanted);
        let mut places: Vec<Option<usize>> = vec![None; graph.nodes.len()];
        for (i, node) in graph.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
            let source = |source: &Option<Source>| {
                Some(match source.as_ref()? {
                    Source::Input(j) => Source::Input(inputs[*j]),
                    Source::Node(j) => Source::Node(places[*j].expect("bug: read, not needed")),
                })
            };
            let from: Vec<Option<Source>> = node.from.iter().map(source).collect();
            let recipe = recipe(node, &from);
            let at = *self.known.entry(recipe).or_insert_with(|| {
                let node = node.clone();
                self.nodes.push(Bound { from, ..node });
                self.nodes.len() - 1
            });
            places[i] = Some(at);
        }
        if self.like.is_none() {
            let nodes = vec![];
            self.like = Some(Graph {
                nodes,
                ..graph.clone()
            });
        }
        Member {
            graph,
            wanted,
            places,
            inputs,
        }
    }

    /// All that was added as one graph, if there is any, with the inputs' files and their content.
    pub(crate) fn graph(self) -> (Option<Graph>, Vec<Files>, Vec<Hash>) {
        let graph = self.like.map(|like| Graph {
            goal: (0..self.nodes.len()).collect(),
            nodes: self.nodes,
            inputs: self.inputs.into_iter().map(|(input, _)| input).collect(),
            shared: vec![],
            ..like
        });
        (graph, self.files, self.contents)
    }
}

/// What a node does and from where it reads, as one hash.
fn recipe(node: &Bound, from: &[Option<Source>]) -> Hash {
    let mut digest = Digest::default();
    key::describe_recipe(node, &mut digest);
    for (port, source) in node.ports.iter().zip(from) {
        let (what, at) = match source {
            None => ("nothing", 0),
            Some(Source::Input(at)) => ("input", *at),
            Some(Source::Node(at)) => ("node", *at),
        };
        digest.line(port.name, &format!("{what} {at}"));
    }
    digest.finish()
}
