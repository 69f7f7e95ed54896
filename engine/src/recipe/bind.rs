//! Recipe → Graph: names mean something, or every mistake with its place.

use super::arrange::arranged;
pub use super::binder::Beside;
use super::binder::{Binder, Known};
use super::mistake::Mistake;
use super::written::{Node, Recipe};
use crate::graph::{Bound, Graph, Source};
use petgraph::algo::{tarjan_scc, toposort};
use petgraph::graph::DiGraph;
use programs::Catalog;
use stage::unknown;
use std::collections::HashMap;

/// Binds a recipe to the stages of a catalog. A `strict` one may hold no node that its goal
/// does not need.
///
/// # Errors
///
/// All mistakes at once.
pub fn bind(
    recipe: &Recipe,
    catalog: &'static Catalog,
    strict: bool,
    beside: &Beside<'_>,
) -> Result<Graph, Vec<Mistake>> {
    let mut binder = Binder {
        recipe,
        catalog,
        beside,
        mistakes: vec![],
        places: HashMap::with_capacity(recipe.nodes.len()),
        inputs: HashMap::with_capacity(recipe.inputs.len()),
        known: HashMap::new(),
    };
    for (i, input) in recipe.inputs.iter().enumerate() {
        binder
            .inputs
            .insert(input.name.value.as_str(), Source::Input(i));
    }
    for (i, node) in recipe.nodes.iter().enumerate() {
        binder
            .places
            .insert(node.name.value.as_str(), Source::Node(i));
    }
    let nodes = recipe.nodes.iter();
    let stages: Vec<_> = nodes.map(|node| binder.stage(node)).collect();
    let mut bound: Vec<Option<Bound>> = Vec::with_capacity(stages.len());
    for (node, known) in recipe.nodes.iter().zip(&stages) {
        let known = known.as_ref();
        bound.push(known.and_then(|known| binder.node(node, known, &stages)));
    }
    binder.idle_sections(&stages, &bound, strict);
    let goal = binder.goal();
    let order = binder.order(&bound);
    if strict && binder.mistakes.is_empty() {
        binder.unused(&bound, &goal);
    }
    if !binder.mistakes.is_empty() {
        return Err(binder.mistakes);
    }
    Ok(arranged(recipe, catalog, bound, &goal, &order))
}

impl<'a> Binder<'a> {
    fn node(&mut self, node: &'a Node, known: &Known, stages: &[Option<Known>]) -> Option<Bound> {
        if known.program {
            return self.program(node, known, stages);
        }
        let Known { stage, ports, .. } = known;
        let mut from: Vec<Option<Source>> = vec![None; ports.len()];
        let before = self.mistakes.len();
        for (port, spanned) in self.wires(node, ports, stages) {
            let Some(source) = self.source(spanned) else {
                continue;
            };
            let kind = self.kind(source, stages);
            let spec = &ports[port];
            if kind.is_some_and(|kind| kind != spec.kind) {
                let (what, kind) = (&spanned.value, kind.unwrap_or_default());
                self.mistakes.push(Mistake::at(
                    &spanned.span,
                    format!(
                        "port `{}` wants {}, but `{what}` makes {kind}",
                        spec.name, spec.kind
                    ),
                ));
            }
            from[port] = Some(source);
        }
        // A port that was wired wrong is no open one.
        let wired = self.mistakes.len() == before && self.known_sources(node);
        for (spec, source) in ports.iter().zip(&from) {
            if source.is_none() && !spec.optional && wired {
                let (port, kind) = (spec.name, spec.kind);
                let what =
                    format!("port `{port}` wants {kind}; write `from = {{ {port} = \"...\" }}`");
                self.mistakes.push(Mistake::at(
                    &node.name.span,
                    format!("node `{}`: {what}", node.name.value),
                ));
            }
        }
        match stage.check(&self.entries(node, known)) {
            Ok(params) => Some(Bound {
                name: node.name.value.clone(),
                stage: *stage,
                ports: ports.clone(),
                params,
                from,
                program: None,
            }),
            Err(wrong) => {
                let specs = stage.params();
                for w in wrong {
                    let mistake = self.misread(node, stage.name(), &specs, w);
                    self.mistakes.push(mistake);
                }
                None
            }
        }
    }

    fn goal(&mut self) -> Vec<usize> {
        if self.recipe.goal.is_empty() {
            let what = "name what is wanted: `goal = \"girths\"`";
            self.mistakes.push(Mistake::at(&(0..0), what));
        }
        let mut goal = Vec::new();
        for spanned in &self.recipe.goal {
            match self.places.get(spanned.value.as_str()) {
                Some(Source::Node(i)) => goal.push(*i),
                _ => {
                    let nodes = self.recipe.nodes.iter();
                    let names: Vec<&str> = nodes.map(|n| n.name.value.as_str()).collect();
                    let what = unknown("node", &spanned.value, &names);
                    self.mistakes.push(Mistake::at(&spanned.span, what));
                }
            }
        }
        goal
    }

    /// Nodes in an order in which each comes after what it reads.
    fn order(&mut self, bound: &[Option<Bound>]) -> Vec<usize> {
        let mut graph = DiGraph::<usize, ()>::new();
        let at: Vec<_> = (0..bound.len()).map(|i| graph.add_node(i)).collect();
        for (i, node) in bound.iter().enumerate() {
            for source in node.iter().flat_map(|n| n.from.iter().flatten()) {
                if let Source::Node(j) = source {
                    graph.add_edge(at[*j], at[i], ());
                }
            }
        }
        if let Ok(order) = toposort(&graph, None) {
            return order.into_iter().map(|i| graph[i]).collect();
        }
        for ring in tarjan_scc(&graph) {
            let mut nodes: Vec<usize> = ring.iter().map(|i| graph[*i]).collect();
            nodes.sort_unstable();
            let itself = ring.len() == 1 && graph.contains_edge(ring[0], ring[0]);
            if ring.len() > 1 || itself {
                let names: Vec<&str> = nodes
                    .iter()
                    .map(|i| self.recipe.nodes[*i].name.value.as_str())
                    .collect();
                let what = format!(
                    "these nodes read each other in a circle: {}",
                    names.join(", ")
                );
                self.mistakes
                    .push(Mistake::at(&self.recipe.nodes[nodes[0]].name.span, what));
            }
        }
        vec![]
    }
}
