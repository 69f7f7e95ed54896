//! Recipe → Recipe: variants, `--set`, and nodes left out.

use super::mistake::Mistake;
use super::values::{merged, nested, parse_value};
use super::written::{From, Overrides, Recipe, Spanned, Variant};
use crate::graph::SHARED;
use stage::{Message, Value, message, unknown};
use std::ops::Range;

stage::messages! {
    SET = "recipe-set": "`--set {set}`: {what}";
    SET_FORM = "recipe-set-form": "give NODE.PARAM=VALUE, such as hull.voxel_mm=2";
}

/// What is wrong with the variants of a recipe, chosen or not: every node or param that is not there.
pub(super) fn wrong_variants(recipe: &Recipe) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    for variant in &recipe.variants {
        apply(&mut bare(recipe), variant, &mut mistakes);
    }
    mistakes
}

/// What variants change: the recipe without variants and sweeps.
fn bare(recipe: &Recipe) -> Recipe {
    Recipe {
        about: recipe.about.clone(),
        goal: recipe.goal.clone(),
        inputs: recipe.inputs.clone(),
        nodes: recipe.nodes.clone(),
        extends: recipe.extends.clone(),
        without: recipe.without.clone(),
        params: recipe.params.clone(),
        sections: recipe.sections.clone(),
        variants: vec![],
        sweeps: vec![],
        searches: vec![],
    }
}

/// The recipe with the chosen variants and sets applied, without variants and sweeps of its own.
///
/// # Errors
///
/// Every variant, node or param that is named and is not there.
pub fn vary(recipe: &Recipe, overrides: &Overrides) -> Result<Recipe, Vec<Mistake>> {
    let mut varied = bare(recipe);
    let mut mistakes = Vec::new();
    for name in overrides.variant.iter().flat_map(|names| names.split(',')) {
        match recipe.variants.iter().find(|v| v.name.value == name) {
            Some(variant) => apply(&mut varied, variant, &mut vec![]),
            None => {
                let known: Vec<&str> = recipe
                    .variants
                    .iter()
                    .map(|v| v.name.value.as_str())
                    .collect();
                mistakes.push(Mistake::spanned(unknown("variant", name, &known)));
            }
        }
    }
    for (i, set) in overrides.sets.iter().enumerate() {
        if let Err(what) = apply_set(&mut varied, set, i) {
            mistakes.push(Mistake::spanned(message!(SET, set = set, what = what)));
        }
    }
    if mistakes.is_empty() {
        Ok(varied)
    } else {
        Err(mistakes)
    }
}

fn apply(recipe: &mut Recipe, variant: &Variant, mistakes: &mut Vec<Mistake>) {
    let names: Vec<String> = recipe.nodes.iter().map(|n| n.name.value.clone()).collect();
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let find = |name: &Spanned<String>, mistakes: &mut Vec<Mistake>| {
        let at = names.iter().position(|n| *n == name.value);
        if at.is_none() {
            mistakes.push(Mistake::at(
                &name.span,
                unknown("node", &name.value, &known),
            ));
        }
        at
    };
    for (node, stage) in &variant.stage {
        if let Some(i) = find(node, mistakes) {
            recipe.nodes[i].stage = stage.clone();
        }
    }
    for (node, from) in &variant.from {
        if let Some(i) = find(node, mistakes) {
            recipe.nodes[i].from = from.clone();
        }
    }
    for (node, with) in &variant.with {
        if node.value == SHARED {
            for (param, value) in with {
                if let Err(what) = set_shared(recipe, param.clone(), value.clone()) {
                    mistakes.push(Mistake::at(&param.span, what));
                }
            }
        } else if let Some(i) = find(node, mistakes) {
            for (param, value) in with {
                set(recipe, i, param.clone(), value.clone());
            }
        }
    }
    let gone: Vec<Spanned<String>> = variant
        .without
        .iter()
        .filter(|n| find(n, mistakes).is_some())
        .cloned()
        .collect();
    for node in gone {
        leave_out(recipe, &node, mistakes);
    }
}

fn set(recipe: &mut Recipe, node: usize, param: Spanned<String>, value: Spanned<Value>) {
    let with = &mut recipe.nodes[node].with;
    with.retain(|(name, _)| name.value != param.value);
    with.push((param, value));
}

/// Gives a shared param another value.
fn set_shared(
    recipe: &mut Recipe,
    name: Spanned<String>,
    value: Spanned<Value>,
) -> Result<(), Message> {
    let names: Vec<&str> = recipe
        .params
        .iter()
        .map(|(n, _)| n.value.as_str())
        .collect();
    let at = names.iter().position(|n| *n == name.value);
    let at = at.ok_or_else(|| unknown("shared param", &name.value, &names))?;
    recipe.params[at].1 = value;
    Ok(())
}

/// Takes a node out: who read it reads what it read first.
pub(super) fn leave_out(recipe: &mut Recipe, name: &Spanned<String>, mistakes: &mut Vec<Mistake>) {
    let Some(at) = recipe.nodes.iter().position(|n| n.name.value == name.value) else {
        return;
    };
    let node = recipe.nodes.remove(at);
    let first = match &node.from {
        From::List(list) => list.first().cloned(),
        From::Table(table) => table.first().map(|(_, source)| source.clone()),
    };
    let Some(first) = first else {
        let what = format!("`{}` reads nothing, so nothing can replace it", name.value);
        mistakes.push(Mistake::at(&name.span, what));
        return;
    };
    for reader in &mut recipe.nodes {
        if let From::List(list) = &reader.from
            && list.iter().any(|s| s.value == name.value)
        {
            // The port is called like the node that goes: keep the port's name.
            let pairs = list.iter().map(|s| (s.clone(), s.clone())).collect();
            reader.from = From::Table(pairs);
        }
        if let From::Table(table) = &mut reader.from {
            for (_, source) in table.iter_mut().filter(|(_, s)| s.value == name.value) {
                source.value = first.value.clone();
            }
        }
    }
    for goal in recipe.goal.iter_mut().filter(|g| g.value == name.value) {
        goal.value = first.value.clone();
    }
}

/// The place of what the command line sets: behind all files.
fn on_command_line(set: usize) -> Range<usize> {
    COMMAND_LINE + set..COMMAND_LINE + set + 1
}

const COMMAND_LINE: usize = usize::MAX / 2;

/// The mistakes with those of `--set`s reported as such, and not at a place of the file.
pub(super) fn of_sets(mistakes: Vec<Mistake>, sets: &[String]) -> Vec<Mistake> {
    let spanned = |mistake: Mistake| {
        let at = mistake.span.as_ref().map_or(0, |span| span.start);
        match at.checked_sub(COMMAND_LINE).and_then(|i| sets.get(i)) {
            Some(set) => Mistake::spanned(message!(SET, set = set, what = mistake.what)),
            None => mistake,
        }
    };
    mistakes.into_iter().map(spanned).collect()
}

/// `NODE.PARAM=VALUE`, or `NODE.SECTION.ENTRY.KEY=VALUE`; a bare word is a text.
fn apply_set(recipe: &mut Recipe, text: &str, i: usize) -> Result<(), Message> {
    let shape = || message!(SET_FORM);
    let (place, value) = text.split_once('=').ok_or_else(shape)?;
    let (node, param) = place.trim().split_once('.').ok_or_else(shape)?;
    let here = on_command_line(i);
    let spanned = |value: &str| Spanned {
        value: value.to_owned(),
        span: here.clone(),
    };
    if node == SHARED {
        let value = Spanned {
            value: parse_value(value.trim()),
            span: here.clone(),
        };
        return set_shared(recipe, spanned(param), value);
    }
    let names: Vec<&str> = recipe.nodes.iter().map(|n| n.name.value.as_str()).collect();
    let at = names.iter().position(|n| *n == node);
    let at = at.ok_or_else(|| unknown("node", node, &names))?;
    let path: Vec<&str> = param.split('.').collect();
    let mut value = nested(&path[1..], parse_value(value.trim()));
    let mut with = recipe.nodes[at].with.iter();
    if let Some((_, old)) = with.find(|(name, _)| path.len() > 1 && name.value == path[0]) {
        value = merged(old.value.clone(), value);
    }
    let value = Spanned {
        value,
        span: here.clone(),
    };
    set(recipe, at, spanned(path[0]), value);
    Ok(())
}
