//! What the goal needs, and in which order.

use super::binder::Binder;
use super::mistake::Mistake;
use super::written::{Input, Recipe};
use crate::graph::{Bound, Graph, InputDecl, Origin, Source};
use programs::Catalog;

impl Binder<'_> {
    /// Reports nodes and inputs that the goal does not need.
    pub(super) fn unused(&mut self, bound: &[Option<Bound>], goal: &[usize]) {
        let mut used = vec![false; bound.len()];
        let mut inputs = vec![false; self.recipe.inputs.len()];
        let mut open = goal.to_vec();
        while let Some(i) = open.pop() {
            if std::mem::replace(&mut used[i], true) {
                continue;
            }
            for source in bound[i].iter().flat_map(|n| n.from.iter().flatten()) {
                match source {
                    Source::Node(j) => open.push(*j),
                    Source::Input(j) => inputs[*j] = true,
                }
            }
        }
        for (node, _) in self
            .recipe
            .nodes
            .iter()
            .zip(&used)
            .filter(|(_, used)| !**used)
        {
            let what = format!(
                "the goal does not need node `{}`: read it, add it to `goal`, or remove it",
                node.name.value
            );
            self.mistakes.push(Mistake::at(&node.name.span, what));
        }
        for (input, _) in self
            .recipe
            .inputs
            .iter()
            .zip(&inputs)
            .filter(|(_, used)| !**used)
        {
            let what = format!("nobody reads input `{}`", input.name.value);
            self.mistakes.push(Mistake::at(&input.name.span, what));
        }
    }
}

/// The graph with its nodes in topological order.
pub(super) fn arranged(
    recipe: &Recipe,
    catalog: &'static Catalog,
    mut nodes: Vec<Option<Bound>>,
    goal: &[usize],
    order: &[usize],
) -> Graph {
    let mut place = vec![0; nodes.len()];
    order
        .iter()
        .enumerate()
        .for_each(|(new, old)| place[*old] = new);
    let moved = |source: &Option<Source>| match source {
        Some(Source::Node(i)) => Some(Source::Node(place[*i])),
        other => *other,
    };
    let arrange = |old: &usize| {
        let mut node = nodes[*old].take()?;
        node.from = node.from.iter().map(moved).collect();
        Some(node)
    };
    let arranged = order.iter().filter_map(arrange).collect();
    let input = |i: &Input| InputDecl {
        name: i.name.value.clone(),
        about: i.about.clone(),
        files: i.files.clone(),
    };
    Graph {
        nodes: arranged,
        inputs: recipe.inputs.iter().map(input).collect(),
        goal: goal.iter().map(|g| place[*g]).collect(),
        about: recipe.about.clone(),
        origin: Origin::default(),
        shared: vec![],
        catalog,
    }
}
