//! `extends`: a pipeline as another one with changes.

use super::mistake::Mistake;
use super::shared::references;
use super::variant::leave_out;
use super::written::{From, Node, Recipe, Section, Spanned, Sweep, Variant, With};
use crate::graph::SHARED;
use stage::unknown;
use std::collections::HashSet;

/// The pipeline `under` as `over` changes it. A node of both keeps what `over` does not set; one
/// that gets another stage starts anew. Inputs, variants, sweeps and entries of sections are
/// replaced whole, shared params one by one.
pub(super) fn extended(under: Recipe, over: Recipe, mistakes: &mut Vec<Mistake>) -> Recipe {
    let mut all = under;
    if !over.about.is_empty() {
        all.about = over.about;
    }
    if !over.goal.is_empty() {
        all.goal = over.goal;
    }
    for node in over.nodes.iter().filter(|n| !n.stage.value.is_empty()) {
        forget(&mut all, &node.name.value);
    }
    put(&mut all.inputs, over.inputs, |i| &i.name);
    put(&mut all.variants, over.variants, |v| &v.name);
    put(&mut all.sweeps, over.sweeps, |s| &s.name);
    put(&mut all.searches, over.searches, |s| &s.sweep.name);
    put(&mut all.params, over.params, |(name, _)| name);
    for section in over.sections {
        let same = |s: &Section| {
            (&s.kind.value, &s.name.value) == (&section.kind.value, &section.name.value)
        };
        all.sections.retain(|s| !same(s));
        all.sections.push(section);
    }
    for name in &over.without {
        let known: Vec<&str> = all.nodes.iter().map(|n| n.name.value.as_str()).collect();
        match known.contains(&name.value.as_str()) {
            true => leave_out(&mut all, name, mistakes),
            false => mistakes.push(Mistake::at(
                &name.span,
                unknown("node", &name.value, &known),
            )),
        }
    }
    for node in over.nodes {
        let at = all
            .nodes
            .iter()
            .position(|n| n.name.value == node.name.value);
        match at {
            Some(at) if node.stage.value.is_empty() => change(&mut all.nodes[at], node),
            Some(at) => all.nodes[at] = node,
            None => all.nodes.push(node),
        }
    }
    all
}

/// Takes back what variants and sweeps set of a node: it gets another stage, with other params and
/// other metrics.
fn forget(recipe: &mut Recipe, node: &str) {
    for variant in &mut recipe.variants {
        variant.with.retain(|(n, _)| n.value != node);
        variant.stage.retain(|(n, _)| n.value != node);
        variant.from.retain(|(n, _)| n.value != node);
    }
    let asks = |s: &Sweep| {
        let of_node = |t: &Spanned<String>| t.value.split('.').next() == Some(node);
        s.over.iter().any(|(n, ..)| n.value == node) || s.tell.iter().any(of_node)
    };
    recipe.sweeps.retain(|s| !asks(s));
    recipe.searches.retain(|s| !asks(&s.sweep));
}

/// Puts entries over those of the same name, or behind all.
fn put<T>(under: &mut Vec<T>, over: Vec<T>, name: impl Fn(&T) -> &Spanned<String>) {
    for entry in over {
        let same = under
            .iter()
            .position(|u| name(u).value == name(&entry).value);
        match same {
            Some(at) => under[at] = entry,
            None => under.push(entry),
        }
    }
}

/// A node with the keys of another of its name.
fn change(node: &mut Node, over: Node) {
    node.name = over.name;
    match (&mut node.from, over.from) {
        (_, From::List(list)) if list.is_empty() => {}
        (From::Table(under), From::Table(over)) => put(under, over, |(port, _)| port),
        // In a list each port is called like what it reads.
        (From::List(under), From::Table(over)) => {
            let own = |s: &Spanned<String>| {
                let mut port = s.clone();
                port.value = port.value.trim_start_matches('@').to_owned();
                (port, s.clone())
            };
            let mut table = under.iter().map(own).collect();
            put(&mut table, over, |(port, _)| port);
            node.from = From::Table(table);
        }
        (from, list) => *from = list,
    }
    put(&mut node.with, over.with, |(param, _)| param);
    node.exec.change(over.exec);
}

/// Without what was inherited (not by `own`) and the goal does not need: nodes, inputs,
/// shared params, and what variants and sweeps set of them.
pub(super) fn trimmed(recipe: &mut Recipe, own: &dyn Fn(&Spanned<String>) -> bool) {
    let needed = needed(recipe);
    recipe
        .nodes
        .retain(|n| own(&n.name) || needed.contains(&n.name.value));
    let of_input = |name: &str| needed.contains(&format!("@{name}"));
    recipe
        .inputs
        .retain(|i| own(&i.name) || of_input(&i.name.value));
    let read: HashSet<String> = references(recipe)
        .map(|(_, name)| name.to_owned())
        .collect();
    let params = &mut recipe.params;
    params.retain(|(name, _)| own(name) || read.contains(&name.value));
    let params: HashSet<String> = params.iter().map(|(name, _)| name.value.clone()).collect();
    let nodes: HashSet<String> = recipe.nodes.iter().map(|n| n.name.value.clone()).collect();
    let there = |name: &str| nodes.contains(name);
    for variant in recipe.variants.iter_mut().filter(|v| !own(&v.name)) {
        for (_, with) in variant.with.iter_mut().filter(|(n, _)| n.value == SHARED) {
            with.retain(|(param, _)| params.contains(&param.value));
        }
        let sets = |n: &Spanned<String>, with: &With| !with.is_empty() && there(&n.value);
        let shares = |n: &Spanned<String>, with: &With| !with.is_empty() && n.value == SHARED;
        variant
            .with
            .retain(|(n, with)| sets(n, with) || shares(n, with));
        variant.stage.retain(|(n, _)| there(&n.value));
        variant.from.retain(|(n, _)| there(&n.value));
        variant.without.retain(|n| there(&n.value));
    }
    let changes = |v: &Variant| {
        !(v.with.is_empty() && v.stage.is_empty() && v.from.is_empty() && v.without.is_empty())
    };
    recipe.variants.retain(|v| own(&v.name) || changes(v));
    let variants = recipe.variants.iter().map(|v| v.name.value.clone());
    let variants: HashSet<String> = variants.collect();
    let whole = |s: &Sweep| {
        let varies = |(n, p, _): &(Spanned<String>, Spanned<String>, _)| match n.value == SHARED {
            true => read.contains(&p.value),
            false => there(&n.value),
        };
        s.over.iter().all(varies)
            && s.goal.iter().all(|n| there(&n.value))
            && s.with.iter().all(|v| variants.contains(&v.value))
            && s.tell.iter().all(|t| {
                let node = t.value.split('.').next().unwrap_or_default();
                node == "error" || there(node)
            })
    };
    recipe.sweeps.retain(|s| own(&s.name) || whole(s));
}

/// The names of nodes and (`@`) inputs that the goal needs.
fn needed(recipe: &Recipe) -> HashSet<String> {
    let mut needed = HashSet::new();
    let mut open: Vec<&str> = recipe.goal.iter().map(|g| g.value.as_str()).collect();
    while let Some(name) = open.pop() {
        if !needed.insert(name.to_owned()) {
            continue;
        }
        let Some(node) = recipe.nodes.iter().find(|n| n.name.value == name) else {
            continue;
        };
        match &node.from {
            From::List(list) => open.extend(list.iter().map(|s| s.value.as_str())),
            From::Table(table) => open.extend(table.iter().map(|(_, s)| s.value.as_str())),
        }
    }
    needed
}
