//! A recipe on its way to a graph.

use super::mistake::Mistake;
use super::written::{Node, Recipe, Spanned};
use crate::graph::Source;
use programs::{Catalog, Importer};
use programs::{EXEC, Identities};
use stage::{AnyStage, ParamSpec, PortSpec, unknown};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// What is around a pipeline: for programs and their files.
pub struct Beside<'a> {
    /// The folder of the file in which something is written.
    pub folder: &'a dyn Fn(&Spanned<String>) -> PathBuf,
    /// Identities that were read for it already.
    pub identities: Arc<Identities>,
}

/// A recipe on its way to a graph, and what is wrong with it.
pub(super) struct Binder<'a> {
    pub(super) beside: &'a Beside<'a>,
    pub(super) recipe: &'a Recipe,
    pub(super) catalog: &'static Catalog,
    pub(super) mistakes: Vec<Mistake>,
    pub(super) places: HashMap<&'a str, Source>,
    pub(super) inputs: HashMap<&'a str, Source>,
    /// What stages' names mean: many nodes have the same.
    pub(super) known: HashMap<&'a str, Option<Known>>,
}

/// A stage with its ports.
#[derive(Clone)]
pub(super) struct Known {
    pub(super) stage: &'static dyn AnyStage,
    pub(super) ports: Arc<[PortSpec]>,
    /// The sections that it takes.
    pub(super) sections: Arc<[&'static str]>,
    /// Whether it runs a program: then its ports and params are the node's own.
    pub(super) program: bool,
}

impl<'a> Binder<'a> {
    pub(super) fn stage(&mut self, node: &'a Node) -> Option<Known> {
        let catalog = self.catalog;
        if node.stage.value == EXEC {
            return self.importer(node);
        }
        if let Some(key) = &node.exec.key {
            let what = format!("only a node with `stage = \"{EXEC}\"` has `{}`", key.value);
            self.mistakes.push(Mistake::at(&key.span, what));
        }
        let known = self.known.entry(&node.stage.value).or_insert_with(|| {
            let stage = catalog.find(&node.stage.value)?;
            let ports = stage.ports().into();
            let sections = sections_of(&stage.params()).into();
            Some(Known {
                stage,
                ports,
                sections,
                program: false,
            })
        });
        if known.is_none() && !node.stage.value.is_empty() {
            let stages = self.catalog.stages().map(|s| s.name());
            let known: Vec<&str> = stages.chain([EXEC]).collect();
            self.mistakes.push(Mistake::at(
                &node.stage.span,
                unknown("stage", &node.stage.value, &known),
            ));
            return None;
        }
        known.clone()
    }

    /// Whether a node's stage is one that there is.
    pub(super) fn is_known(&self, node: usize) -> bool {
        let node = &self.recipe.nodes[node];
        let known = || self.known.get(node.stage.value.as_str());
        importer_of(node, self.catalog).is_some() || matches!(known(), Some(Some(_)))
    }
}

/// How the result of a node's program is read, if the node runs one and there is a way.
pub(super) fn importer_of(node: &Node, catalog: &'static Catalog) -> Option<&'static Importer> {
    let kind = node
        .exec
        .out
        .as_ref()
        .filter(|_| node.stage.value == EXEC)?;
    catalog.importer(&kind.value)
}

/// The names of the sections among params.
pub(super) fn sections_of(specs: &[ParamSpec]) -> Vec<&'static str> {
    let sections = specs.iter().filter(|p| p.entry.is_some());
    sections.map(|p| p.name).collect()
}
