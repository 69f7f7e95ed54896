//! `graph`, `stages`, `pipelines`, `check`: answers that run nothing.

use super::arguments::Words;
use super::fault::Fault;
use super::open::open;
use super::planned::{Answer, of_verb, of_words, planned};
use super::program::GlobalArgs;
use super::programs::listed;
use super::{drawing, reference, text};
use clap::{ArgMatches, Args};
use engine::key;
use engine::permission::listing;
use engine::recipe::{self, Overrides, Pipeline};
use programs::EXEC;
use serde_json::{Value, json};
use std::path::Path;
use tables::aligned;

/// Arguments of `graph`.
#[derive(Args)]
pub(crate) struct Drawing {
    #[command(flatten)]
    words: Words,
    /// dot or mermaid
    #[arg(long = "as", default_value = "dot")]
    format: String,
}

/// `graph`.
pub(crate) fn graph(
    drawing: &Drawing,
    verb: Option<(&str, &ArgMatches)>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    drawn(&drawing.format, (&drawing.words, verb), global)
}

/// The pipeline, or what a verb of the program's own would run, as a drawing.
pub(super) fn drawn(
    format: &str,
    (words, verb): (&Words, Option<(&str, &ArgMatches)>),
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let (graph, plan) = match verb {
        Some(verb) => {
            let answer = Answer::of_job(of_verb(verb, global, words)?, global)?;
            (answer.graph, answer.plan)
        }
        None => {
            let wanted = of_words(words, global)?;
            let (graph, _) = open(&wanted, global)?;
            // Without its inputs nobody knows what would run.
            let plan = match wanted.change.input.is_empty() && !graph.inputs.is_empty() {
                true => vec![None; graph.nodes.len()],
                false => planned(&wanted, global)?.plan,
            };
            (graph, plan)
        }
    };
    let drawn = drawing::draw(&graph, &plan, format).map_err(Fault::input)?;
    match global.json {
        true => crate::outln!("{}", drawing::json(&graph, &plan)),
        false => crate::out!("{drawn}"),
    }
    Ok(())
}

/// `stages --json-schema`.
pub(crate) fn schema(global: &GlobalArgs) -> Result<(), Fault> {
    let schema = super::schema::schema(global.catalog().stages());
    let text = serde_json::to_string_pretty(&schema).expect("bug: JSON");
    crate::outln!("{text}");
    Ok(())
}

/// `stages`.
pub(crate) fn stages(
    name: Option<&str>,
    provenance: bool,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let fits = |s: &dyn stage::AnyStage| {
        name.is_none_or(|n| s.name() == n || s.name().split('.').next() == Some(n))
    };
    let found: Vec<_> = global.catalog().stages().filter(|s| fits(*s)).collect();
    let program = name.is_none_or(|name| name == EXEC);
    if found.is_empty() && !program {
        let known = global.catalog().stages().map(|s| s.name());
        let known: Vec<&str> = known.chain([EXEC]).collect();
        return Err(Fault::coded(&stage::unknown(
            "stage",
            name.unwrap_or(""),
            &known,
        )));
    }
    if global.json {
        crate::outln!(
            "{}",
            found.iter().map(|s| reference::json(*s)).collect::<Value>()
        );
    } else if provenance {
        crate::out!("{}", reference::provenance(&found));
    } else {
        found
            .iter()
            .for_each(|s| crate::out!("{}", reference::text(*s)));
        if program {
            crate::out!("{}", listing::reference(global.catalog()));
        }
    }
    Ok(())
}

/// `pipelines`: all with what they are for, or the text of one.
pub(crate) fn pipelines(name: Option<&str>, global: &GlobalArgs) -> Result<(), Fault> {
    let catalog = global.catalog();
    if let Some(name) = name {
        let known: Vec<&str> = catalog.pipelines.iter().map(|(n, _)| *n).collect();
        let found = catalog.pipeline(name);
        let (name, text) =
            found.ok_or_else(|| Fault::coded(&stage::unknown("pipeline", name, &known)))?;
        match global.json {
            true => crate::outln!("{}", json!({ "name": name, "text": text })),
            false => crate::out!("{text}"),
        }
        return Ok(());
    }
    let mut all = Vec::new();
    for (name, _) in catalog.pipelines {
        let pipeline = Pipeline::built_in(name, catalog).map_err(Fault::mistakes)?;
        all.push((*name, pipeline.recipe().about.clone()));
    }
    if global.json {
        let one = |(name, about): &(&str, String)| json!({ "name": name, "about": about });
        crate::outln!("{}", all.iter().map(one).collect::<Value>());
        return Ok(());
    }
    let mut table = aligned::table();
    for (name, about) in all {
        table.add_row([name, &about]);
    }
    crate::outln!("{}", aligned::lines(&mut table));
    Ok(())
}

/// `check`.
pub(crate) fn check(pipeline: &Path, global: &GlobalArgs) -> Result<(), Fault> {
    match recipe::open(pipeline, &Overrides::default(), global.catalog()) {
        Ok(graph) => {
            let recipes: Vec<String> = graph
                .nodes
                .iter()
                .map(|n| key::provenance(n, &[]).0.len().to_string())
                .collect();
            if global.json {
                crate::outln!("{}", json!({ "mistakes": [], "nodes": recipes.len() }));
            } else if !global.quiet {
                crate::outln!(
                    "{}: {}, no mistakes",
                    pipeline.display(),
                    text::count(graph.nodes.len(), "node")
                );
            }
            listed(&graph, global)
        }
        Err(mistakes) => Err(Fault::mistakes(mistakes)),
    }
}
