//! `[params]`: values that several nodes share. `voxel_mm = "$cell_mm"` reads one.

use super::mistake::Mistake;
use super::written::{Node, Recipe, Spanned};
use crate::graph::SHARED;
use stage::{Value, unknown};
use std::collections::{HashMap, HashSet};

/// The shared param that a value names; `$$` begins a text with a `$` of its own.
fn named(value: &Value) -> Option<&str> {
    match value {
        Value::Text(text) => text.strip_prefix('$').filter(|name| !name.starts_with('$')),
        _ => None,
    }
}

/// Which node reads which shared param.
pub(super) fn references(recipe: &Recipe) -> impl Iterator<Item = (&Node, &str)> {
    let nodes = recipe.nodes.iter();
    nodes.flat_map(|node| {
        let spanned = node.with.iter();
        spanned.filter_map(move |(_, v)| Some((node, named(&v.value)?)))
    })
}

/// The params of nodes that read a shared one.
pub(super) fn readers<'a>(
    recipe: &'a Recipe,
    shared: &'a str,
) -> impl Iterator<Item = (&'a Node, &'a Spanned<String>)> {
    let of = move |node: &'a Node| {
        let reads = move |(_, v): &&(_, Spanned<Value>)| named(&v.value) == Some(shared);
        node.with
            .iter()
            .filter(reads)
            .map(move |(param, _)| (node, param))
    };
    recipe.nodes.iter().flat_map(of)
}

/// Puts the values of shared params where they are read. A value has the place where it was written, so
/// that a mistake in it is found there. With the pipeline as it is written there may be none that nobody reads, there or here:
/// `--set` may take the last reader away.
pub(super) fn resolve(recipe: &mut Recipe, strict: Option<&Recipe>, mistakes: &mut Vec<Mistake>) {
    let names: Vec<&str> = recipe
        .params
        .iter()
        .map(|(n, _)| n.value.as_str())
        .collect();
    let places: HashMap<&str, usize> = names.iter().enumerate().map(|(i, n)| (*n, i)).collect();
    let written: HashSet<&str> = strict
        .into_iter()
        .flat_map(references)
        .map(|(_, name)| name)
        .collect();
    let mut read: Vec<bool> = names.iter().map(|name| written.contains(name)).collect();
    for node in &mut recipe.nodes {
        if node.name.value == SHARED {
            let what = "`params` means the shared params: call the node otherwise";
            mistakes.push(Mistake::at(&node.name.span, what));
        }
        for (_, value) in &mut node.with {
            if let Value::Text(text) = &mut value.value
                && text.starts_with("$$")
            {
                text.remove(0);
                continue;
            }
            let Some(name) = named(&value.value) else {
                continue;
            };
            match places.get(name).copied() {
                Some(at) => {
                    read[at] = true;
                    *value = recipe.params[at].1.clone();
                }
                None => {
                    let what = unknown("shared param", name, &names);
                    mistakes.push(Mistake::at(&value.span, what));
                }
            }
        }
    }
    if strict.is_some() {
        for ((name, _), _) in recipe.params.iter().zip(read).filter(|(_, read)| !*read) {
            let what = format!("no node reads the shared param `{}`", name.value);
            mistakes.push(Mistake::at(&name.span, what));
        }
    }
}
