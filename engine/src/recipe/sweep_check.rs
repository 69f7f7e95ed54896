//! Whether a declared sweep can be: its nodes, params, values, variants and which metrics are reported.

use super::binder::importer_of;
use super::mistake::Mistake;
use super::sections::{of_param, of_stage};
use super::shared;
use super::variant::vary;
use super::written::{Node, Over, Overrides, Recipe, Spanned, Sweep};
use crate::graph::SHARED;
use crate::numbers::{entries, missing_number};
use programs::Catalog;
use stage::{Message, Value, unknown};

/// Whether every sweep means something: nodes, params, values, variants, metrics.
/// Where variants are not `sound`, what a sweep comes to in them is not checked.
pub(super) fn check(recipe: &Recipe, sound: bool, catalog: &'static Catalog) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    for sweep in &recipe.sweeps {
        one(recipe, sweep, sound, catalog, &mut mistakes);
    }
    for search in &recipe.searches {
        let of = &search.sweep;
        one(recipe, of, sound, catalog, &mut mistakes);
        if of.over.is_empty() {
            let what = format!("`{}`: a search needs `over`", of.name.value);
            wrong(&mut mistakes, &of.name, what);
        }
    }
    mistakes
}

fn wrong(mistakes: &mut Vec<Mistake>, at: &Spanned<String>, what: impl Into<Message>) {
    mistakes.push(Mistake::at(&at.span, what));
}

fn one(
    recipe: &Recipe,
    sweep: &Sweep,
    sound: bool,
    catalog: &'static Catalog,
    mistakes: &mut Vec<Mistake>,
) {
    let empty = sweep.over.is_empty() && sweep.csv.is_none() && sweep.with.is_empty();
    if empty && sweep.replicate.is_none() {
        let what = "a sweep needs `over`, `csv`, `with` or `replicate`";
        let what = format!("`{}`: {what}", sweep.name.value);
        wrong(mistakes, &sweep.name, what);
    }
    let recipes = varied(recipe, sweep, sound, mistakes);
    let names: Vec<&str> = recipe.nodes.iter().map(|n| n.name.value.as_str()).collect();
    for (node, param, over) in &sweep.over {
        if node.value != SHARED && !names.contains(&node.value.as_str()) {
            wrong(mistakes, node, unknown("node", &node.value, &names));
            continue;
        }
        let values = values_of(over, sweep, mistakes);
        if values.is_empty() {
            wrong(mistakes, param, format!("`{}` takes no value", param.value));
        }
        for recipe in &recipes {
            over_one(recipe, (node, param, &values), catalog, mistakes);
        }
    }
    let full =
        |(n, p, _): &(Spanned<String>, Spanned<String>, Over)| format!("{}.{}", n.value, p.value);
    let params: Vec<String> = sweep.over.iter().map(full).collect();
    for spanned in sweep.zip.iter().flatten() {
        if !params.contains(&spanned.value) {
            let known: Vec<&str> = params.iter().map(String::as_str).collect();
            let what = unknown("param of this sweep", &spanned.value, &known);
            wrong(mistakes, spanned, what);
        }
    }
    for spanned in &sweep.goal {
        if !names.contains(&spanned.value.as_str()) {
            wrong(mistakes, spanned, unknown("node", &spanned.value, &names));
        }
    }
    if let Some(spanned) = &sweep.replicate {
        let by_chance = |recipe: &Recipe| recipe.nodes.iter().any(|n| has_seed(n, catalog));
        if !recipes.iter().all(by_chance) {
            mistakes.push(Mistake::at(&spanned.span, no_seed(catalog)));
        }
    }
    for spanned in &sweep.tell {
        if let Some(what) = reported_by_none(&recipes, spanned, &names, catalog) {
            wrong(mistakes, spanned, what);
        }
    }
}

/// Whether a node's stage draws what a method is given by a seed; of a program, whether it has a param `seed`.
fn has_seed(node: &Node, catalog: &'static Catalog) -> bool {
    match importer_of(node, catalog) {
        Some(_) => node.with.iter().any(|(name, _)| name.value == "seed"),
        None => {
            let stage = catalog.find(&node.stage.value);
            stage.is_some_and(|s| s.params().iter().any(|p| p.seed))
        }
    }
}

/// Why replicates would all be the same, and which stages have a seed.
pub(crate) fn no_seed(catalog: &Catalog) -> String {
    let seeds = catalog.stages().filter_map(|stage| {
        let seed = stage.params().into_iter().find(|p| p.seed)?;
        Some(format!("{}.{}", stage.name(), seed.name))
    });
    let seeds: Vec<String> = seeds.collect();
    let which = match seeds.is_empty() {
        true => "no stage has one".to_owned(),
        false => format!("stages that have one: {}", seeds.join(", ")),
    };
    format!(
        "`replicate`: nothing that runs here has a seed of what is by chance, so all replicates would be the same; {which}"
    )
}

/// The recipe in each of the sweep's variants; as it is, where it names none.
fn varied(recipe: &Recipe, sweep: &Sweep, sound: bool, mistakes: &mut Vec<Mistake>) -> Vec<Recipe> {
    if sweep.with.is_empty() {
        return vec![recipe.clone()];
    }
    let variants = recipe.variants.iter();
    let variants: Vec<&str> = variants.map(|v| v.name.value.as_str()).collect();
    let mut recipes = Vec::new();
    for spanned in &sweep.with {
        if !variants.contains(&spanned.value.as_str()) {
            wrong(
                mistakes,
                spanned,
                unknown("variant", &spanned.value, &variants),
            );
            continue;
        }
        let variant = Some(spanned.value.clone());
        let sets = vec![];
        if sound {
            recipes.extend(vary(recipe, &Overrides { variant, sets }).ok());
        }
    }
    recipes
}

/// The values that a param takes, each with its place.
fn values_of(over: &Over, sweep: &Sweep, mistakes: &mut Vec<Mistake>) -> Vec<Spanned<Value>> {
    match over {
        Over::List(list) => list.clone(),
        Over::Range(spanned) => {
            if spanned.value.steps.is_none() && sweep.sample.is_none() {
                let what = "a range needs `steps`, or the sweep a `sample`";
                mistakes.push(Mistake::at(&spanned.span, what));
            }
            let here = |value| Spanned {
                value,
                span: spanned.span.clone(),
            };
            let values = super::stretch::values(&spanned.value);
            values.into_iter().map(here).collect()
        }
    }
}

/// Whether a recipe has the param, and it can take the values.
fn over_one(
    recipe: &Recipe,
    (node, param, values): (&Spanned<String>, &Spanned<String>, &[Spanned<Value>]),
    catalog: &'static Catalog,
    mistakes: &mut Vec<Mistake>,
) {
    let shared = node.value == SHARED;
    let holders: Vec<(&Node, &Spanned<String>)> = match shared {
        true => shared::readers(recipe, &param.value).collect(),
        false => {
            let nodes = recipe.nodes.iter().filter(|n| n.name.value == node.value);
            nodes.map(|n| (n, param)).collect()
        }
    };
    // A variant may leave the node out: then it takes no part.
    if holders.is_empty() {
        let what = match shared {
            true => format!("no node reads the shared param `{}`", param.value),
            false => format!("a variant of this sweep leaves `{}` out", node.value),
        };
        wrong(mistakes, node, what);
    }
    for (holder, name) in holders {
        mistakes.extend(unfit(holder, name, param, values, catalog));
    }
}

/// Why a metric is there in none of the variants.
fn reported_by_none(
    recipes: &[Recipe],
    spanned: &Spanned<String>,
    names: &[&str],
    catalog: &'static Catalog,
) -> Option<String> {
    match spanned.value.split_once('.').map(|(node, _)| node) {
        None => Some("give node.metric, such as \"hull.volume\"".into()),
        Some("error") => None,
        Some(node) if !names.contains(&node) => Some(unknown("node", node, names).into()),
        Some(node) => {
            let all = recipes
                .iter()
                .map(|r| missing_metric(r, node, spanned, catalog));
            // It is enough that one variant has it.
            let all: Option<Vec<String>> = all.collect();
            all?.into_iter().next()
        }
    }
}

/// What is wrong with the values that a sweep gives to the param `name` of a node; they are written
/// for `param`.
fn unfit(
    holder: &Node,
    name: &Spanned<String>,
    param: &Spanned<String>,
    values: &[Spanned<Value>],
    catalog: &'static Catalog,
) -> Vec<Mistake> {
    if importer_of(holder, catalog).is_some() {
        return match holder
            .with
            .iter()
            .any(|(known, _)| known.value == name.value)
        {
            true => vec![],
            false => {
                let known: Vec<&str> = holder.with.iter().map(|(n, _)| n.value.as_str()).collect();
                vec![Mistake::at(
                    &param.span,
                    unknown("param", &name.value, &known),
                )]
            }
        };
    }
    let Some(stage) = catalog.find(&holder.stage.value) else {
        return vec![];
    };
    let known = stage.params().iter().any(|p| p.name == name.value);
    let one = |value: &Spanned<Value>| {
        let spanned = [(name.value.clone(), value.value.clone())].into();
        let wrong = stage.check(&spanned).err().unwrap_or_default();
        let reasons = wrong.into_iter().map(|w| match known {
            true => Mistake::at(&value.span, of_param(&name.value, w.what)),
            false => Mistake::at(&param.span, of_stage(stage.name(), w.what)),
        });
        reasons.collect::<Vec<_>>()
    };
    values.iter().flat_map(one).collect()
}

/// What is wrong with asking a node of a recipe for a number.
fn missing_metric(
    recipe: &Recipe,
    node: &str,
    spanned: &Spanned<String>,
    catalog: &'static Catalog,
) -> Option<String> {
    let metric = &spanned.value[node.len() + 1..];
    let at = recipe.nodes.iter().find(|n| n.name.value == node)?;
    let params = recipe.nodes.iter().flat_map(|n| &n.with);
    let mut declared = entries(params.map(|(_, spanned)| &spanned.value));
    declared.extend(recipe.sections.iter().map(|s| s.name.value.clone()));
    let stage = match importer_of(at, catalog) {
        Some(importer) => importer,
        None => catalog.find(&at.stage.value)?,
    };
    missing_number(node, stage, metric, &declared, catalog)
}
