//! Whether a declared sweep can be: its nodes, params, values, variants and what is to be told.

use super::{Mistake, Over, Overrides, Recipe, Said, Sweep, vary};
use crate::kind::Catalog;
use crate::tells::{entries, untellable};
use stage::{Value, unknown};

/// Whether every sweep means something: nodes, params, values, variants, what is told.
pub(super) fn check(recipe: &Recipe, catalog: &'static Catalog) -> Result<(), Vec<Mistake>> {
    let mut mistakes = Vec::new();
    for sweep in &recipe.sweeps {
        one(recipe, sweep, catalog, &mut mistakes);
    }
    match mistakes.is_empty() {
        true => Ok(()),
        false => Err(mistakes),
    }
}

fn one(recipe: &Recipe, sweep: &Sweep, catalog: &'static Catalog, mistakes: &mut Vec<Mistake>) {
    let mut wrong = |at: &Said<String>, what: String| mistakes.push(Mistake::at(&at.span, what));
    let names: Vec<&str> = recipe.nodes.iter().map(|n| n.name.value.as_str()).collect();
    let variants: Vec<&str> = recipe
        .variants
        .iter()
        .map(|v| v.name.value.as_str())
        .collect();
    if sweep.over.is_empty() && sweep.csv.is_none() && sweep.with.is_empty() {
        let what = "a sweep needs `over`, `csv` or `with`";
        wrong(&sweep.name, format!("`{}`: {what}", sweep.name.value));
    }
    let mut recipes = Vec::new();
    for said in &sweep.with {
        if !variants.contains(&said.value.as_str()) {
            wrong(said, unknown("variant", &said.value, &variants));
            continue;
        }
        let variant = Some(said.value.clone());
        let sets = vec![];
        recipes.extend(vary(recipe, &Overrides { variant, sets }).ok());
    }
    if sweep.with.is_empty() {
        recipes.push(recipe.clone());
    }
    let params: Vec<String> = sweep
        .over
        .iter()
        .map(|(n, p, _)| format!("{}.{}", n.value, p.value))
        .collect();
    for (node, param, over) in &sweep.over {
        if !names.contains(&node.value.as_str()) {
            wrong(node, unknown("node", &node.value, &names));
            continue;
        }
        let values: Vec<Said<Value>> = match over {
            Over::List(list) => list.clone(),
            Over::Range(said) => {
                if said.value.steps.is_none() && sweep.sample.is_none() {
                    let at = Said {
                        value: String::new(),
                        span: said.span.clone(),
                    };
                    wrong(&at, "a range needs `steps`, or the sweep a `sample`".into());
                }
                let values = super::stretch::values(&said.value);
                let here = |value| Said {
                    value,
                    span: said.span.clone(),
                };
                values.into_iter().map(here).collect()
            }
        };
        if values.is_empty() {
            wrong(param, format!("`{}` takes no value", param.value));
        }
        for recipe in &recipes {
            // A variant may leave the node out: then it is told that it takes no part.
            let Some(there) = recipe.nodes.iter().find(|n| n.name.value == node.value) else {
                wrong(
                    node,
                    format!("a variant of this sweep leaves `{}` out", node.value),
                );
                continue;
            };
            let Some(stage) = catalog.find(&there.stage.value) else {
                continue;
            };
            for value in &values {
                let said = [(param.value.clone(), value.value.clone())].into();
                for w in stage.check(&said).err().into_iter().flatten() {
                    let known = stage.params().iter().any(|p| p.name == param.value);
                    let span = if known { &value.span } else { &param.span };
                    let at = Said {
                        value: String::new(),
                        span: span.clone(),
                    };
                    match known {
                        true => wrong(&at, format!("`{}` {}", param.value, w.what)),
                        false => wrong(&at, format!("{}: {}", stage.name(), w.what)),
                    }
                }
            }
        }
    }
    for said in sweep.zip.iter().flatten() {
        if !params.contains(&said.value) {
            let known: Vec<&str> = params.iter().map(String::as_str).collect();
            wrong(said, unknown("param of this sweep", &said.value, &known));
        }
    }
    for said in sweep
        .goal
        .iter()
        .filter(|g| !names.contains(&g.value.as_str()))
    {
        wrong(said, unknown("node", &said.value, &names));
    }
    for said in &sweep.tell {
        let node = said.value.split_once('.').map(|(node, _)| node);
        match node {
            None => wrong(said, "say node.metric, such as \"hull.volume\"".into()),
            Some("error") => {}
            Some(node) if !names.contains(&node) => wrong(said, unknown("node", node, &names)),
            Some(node) => {
                let all = recipes
                    .iter()
                    .map(|recipe| untold(recipe, node, said, catalog));
                // It is enough that one variant tells it.
                let all: Option<Vec<String>> = all.collect();
                all.and_then(|all| all.into_iter().next())
                    .into_iter()
                    .for_each(|what| wrong(said, what));
            }
        }
    }
}

/// What is wrong with asking a node of a recipe for a number.
fn untold(
    recipe: &Recipe,
    node: &str,
    said: &Said<String>,
    catalog: &'static Catalog,
) -> Option<String> {
    let metric = &said.value[node.len() + 1..];
    let at = recipe.nodes.iter().find(|n| n.name.value == node)?;
    let params = recipe.nodes.iter().flat_map(|n| &n.with);
    let mut declared = entries(params.map(|(_, said)| &said.value));
    declared.extend(recipe.sections.iter().map(|s| s.name.value.clone()));
    untellable(
        node,
        catalog.find(&at.stage.value)?,
        metric,
        &declared,
        catalog,
    )
}
