//! `plan`, `why`, `graph`, `stages`, `check`: answers that run nothing.

use super::arguments::Wanted;
use super::fault::Fault;
use super::open::{folders, node, open, prefetch};
use super::program::GlobalArgs;
use super::programs::listed;
use super::strands;
use super::text;
use crate::foreign::{EXEC, listing};
use crate::graph::Graph;
use crate::plan::{self, Planned, State};
use crate::recipe::{self, Overrides, Pipeline};
use crate::store::Store;
use crate::{drawing, key, session, why};
use clap::Args;
use serde_json::{Value, json};
use stage::Files;
use std::path::Path;

/// Arguments of `plan`.
#[derive(Args)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    wanted: Wanted,
    /// Cut it into strands for a cluster instead; the plan lies in the cache, its name is told
    #[arg(long)]
    strands: bool,
    /// With --strands: one run for every folder in FOLDER, as the input NAME: NAME=FOLDER
    #[arg(long, requires = "strands")]
    each: Vec<String>,
}

/// Arguments of `why`.
#[derive(Args)]
pub(crate) struct Why {
    /// The node
    node: String,
    #[command(flatten)]
    wanted: Wanted,
}

/// Arguments of `graph`.
#[derive(Args)]
pub(crate) struct Drawing {
    #[command(flatten)]
    wanted: Wanted,
    /// dot, mermaid or svg
    #[arg(long = "as", default_value = "dot")]
    format: String,
}

/// What would run, and of which files.
struct Answer {
    graph: Graph,
    plan: Vec<Option<Planned>>,
    files: Vec<Files>,
    store: Store,
}

fn planned(wanted: &Wanted, global: &GlobalArgs) -> Result<Answer, Fault> {
    let prefetch = prefetch(wanted, global);
    let (graph, goal) = open(wanted, global)?;
    let store = Store::open_after(&global.cache, prefetch).map_err(Fault::input)?;
    let files = session::inputs(&graph, &folders(&wanted.change)?, &store).map_err(Fault::input)?;
    let plan = plan::plan(&graph, &files, &goal, &store);
    Ok(Answer {
        graph,
        plan,
        files,
        store,
    })
}

/// `plan`.
pub(crate) fn plan(args: &PlanArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let wanted = &args.wanted;
    if args.strands {
        return strands::plan(wanted, &args.each, global);
    }
    let Answer { graph, plan, .. } = planned(wanted, global)?;
    let (mut lines, mut seconds, mut unknown) = (Vec::new(), [0.0; 2], 0);
    for (node, planned) in graph.nodes.iter().zip(&plan) {
        let Some(p) = planned else { continue };
        let word = match &p.state {
            State::Cached => "cached",
            State::Stale(_) => "will run",
            State::May => "may run",
        };
        unknown += usize::from(p.state != State::Cached && p.seconds.is_none());
        match p.state {
            State::Cached => {}
            State::Stale(_) => seconds[0] += p.seconds.unwrap_or(0.0),
            State::May => seconds[1] += p.seconds.unwrap_or(0.0),
        }
        let why = match &p.state {
            State::Stale(lines) => lines.clone(),
            _ => vec![],
        };
        if global.json {
            lines.push(
                json!({ "node": node.name, "state": word, "seconds": p.seconds, "why": why }),
            );
        } else {
            let took = p.seconds.map_or("?".into(), |s| format!("{s:.1} s"));
            let why: Vec<String> = why
                .iter()
                .map(|(w, o, n)| format!("{w}: {} -> {}", short(o), short(n)))
                .collect();
            crate::outln!("{word:<9} {:<14} {took:>8}  {}", node.name, why.join("; "));
        }
    }
    if global.json {
        crate::outln!(
            "{}",
            json!({
                "nodes": lines, "will_seconds": seconds[0], "may_seconds": seconds[1],
                "without_history": unknown,
            })
        );
    } else {
        crate::outln!(
            "expected: {:.1} s, and up to {:.1} s more if results change{}",
            seconds[0],
            seconds[1],
            match unknown {
                0 => String::new(),
                n => format!("; {n} nodes have never run here, so nothing is known of their time"),
            }
        );
    }
    listed(&graph, global)
}

/// A hash shortened, anything else as it is.
fn short(text: &str) -> &str {
    let hash = text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit());
    if hash { &text[..12] } else { text }
}

/// `why NODE`: the node and all that is to blame, back to every root cause.
pub(crate) fn why(why: &Why, global: &GlobalArgs) -> Result<(), Fault> {
    let answer = planned(&why.wanted, global)?;
    let Answer { graph, plan, .. } = &answer;
    let at = node(graph, &why.node)?;
    let causes = why::causes(graph, plan, &answer.files, answer.store.root(), at);
    let mut chain: Vec<Value> = Vec::new();
    for cause in &causes {
        let (name, state) = (&graph.nodes[cause.node].name, cause.state);
        let changes = &cause.changes;
        if !global.json {
            let so = match changes.is_empty() && state == "cached" {
                true => ", as in the last run",
                false => "",
            };
            crate::outln!("{name}: {state}{so}");
            changes
                .iter()
                .for_each(|(w, o, n)| crate::outln!("  {w}: {} -> {}", short(o), short(n)));
        }
        chain.push(json!({ "node": name, "state": state, "changes": changes }));
    }
    if global.json {
        crate::outln!("{}", json!({ "chain": chain }));
    }
    Ok(())
}

/// `graph`.
pub(crate) fn graph(drawing: &Drawing, global: &GlobalArgs) -> Result<(), Fault> {
    let (graph, _) = open(&drawing.wanted, global)?;
    // Without its inputs nobody knows what would run.
    let plan = match drawing.wanted.change.input.is_empty() && !graph.inputs.is_empty() {
        true => vec![None; graph.nodes.len()],
        false => planned(&drawing.wanted, global)?.plan,
    };
    let drawn = drawing::draw(&graph, &plan, &drawing.format).map_err(Fault::input)?;
    match global.json {
        true => crate::outln!("{}", drawing::json(&graph, &plan)),
        false => crate::out!("{drawn}"),
    }
    Ok(())
}

/// `stages --json-schema`.
pub(crate) fn schema(global: &GlobalArgs) -> Result<(), Fault> {
    let schema = crate::schema::schema(global.catalog().stages());
    let text = serde_json::to_string_pretty(&schema).expect("bug: JSON");
    crate::outln!("{text}");
    Ok(())
}

/// `stages`.
pub(crate) fn stages(name: Option<&str>, global: &GlobalArgs) -> Result<(), Fault> {
    let fits = |s: &dyn stage::AnyStage| {
        name.is_none_or(|n| s.name() == n || s.name().split('.').next() == Some(n))
    };
    let found: Vec<_> = global.catalog().stages().filter(|s| fits(*s)).collect();
    let program = name.is_none_or(|name| name == EXEC);
    if found.is_empty() && !program {
        let known = global.catalog().stages().map(|s| s.name());
        let known: Vec<&str> = known.chain([EXEC]).collect();
        return Err(Fault::input(stage::unknown(
            "stage",
            name.unwrap_or(""),
            &known,
        )));
    }
    if global.json {
        crate::outln!(
            "{}",
            found
                .iter()
                .map(|s| crate::reference::json(*s))
                .collect::<Value>()
        );
    } else {
        found
            .iter()
            .for_each(|s| crate::out!("{}", crate::reference::text(*s)));
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
            found.ok_or_else(|| Fault::input(stage::unknown("pipeline", name, &known)))?;
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
    let mut table = text::table();
    for (name, about) in all {
        table.add_row([name, &about]);
    }
    crate::outln!("{}", text::lines(&mut table));
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
