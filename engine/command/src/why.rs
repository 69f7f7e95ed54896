//! `plan --why`: which lines of what a node depends on changed, back to every root cause.

use super::arguments::{Wanted, Words};
use super::fault::Fault;
use super::open::node;
use super::planned::{Answer, of_verb, of_words, planned};
use super::program::GlobalArgs;
use clap::{ArgMatches, Args};
use engine::past::NodeLine;
use engine::why::{against, causes};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Arguments of `why`.
#[derive(Args)]
pub(crate) struct Why {
    #[command(flatten)]
    words: Words,
    /// Against the run of this run.json, of this machine or another, instead of the last run of the same here
    #[arg(long, value_name = "RUN.JSON")]
    against: Option<PathBuf>,
}

/// A hash shortened, anything else as it is.
pub(super) fn short(text: &str) -> &str {
    let hash = text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit());
    if hash { &text[..12] } else { text }
}

/// The nodes of a `run.json`.
fn nodes_of(file: &Path) -> Result<Vec<NodeLine>, Fault> {
    let wrong = |why: String| Fault::input(format!("{}: {why}", file.display()));
    let bytes = std::fs::read(file).map_err(|e| wrong(e.to_string()))?;
    let run: Value = serde_json::from_slice(&bytes).map_err(|e| wrong(e.to_string()))?;
    let nodes = run.get("nodes").cloned().unwrap_or_default();
    let what = "no record of a run; `measure` and `run --out` write one as run.json";
    serde_json::from_value(nodes).map_err(|e| wrong(format!("{what} ({e})")))
}

/// `why`: the node and all that is to blame, back to every root cause.
pub(super) fn why(
    why: &Why,
    verb: Option<(&str, &ArgMatches)>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let answer = match verb {
        Some(verb) => Answer::of_job(of_verb(verb, global, &why.words)?, global)?,
        None => {
            let wanted = of_words(&why.words, global)?;
            // What a run of the whole would do with it.
            let whole = Wanted {
                nodes: vec![],
                ..wanted.clone()
            };
            Answer {
                nodes: wanted.nodes,
                ..planned(&whole, global)?
            }
        }
    };
    let [name] = answer.nodes.as_slice() else {
        let names: Vec<&str> = answer.graph.nodes.iter().map(|n| n.name.as_str()).collect();
        let names = names.join(", ");
        return Err(Fault::input(format!("name one node of: {names}")));
    };
    why_of(&answer, name, why.against.as_deref(), global)
}

/// A node and all that is to blame, back to every root cause.
pub(super) fn why_of(
    answer: &Answer,
    name: &str,
    run: Option<&Path>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let Answer { graph, plan, .. } = answer;
    let at = node(graph, name)?;
    let causes = match run {
        Some(file) => against(graph, plan, &nodes_of(file)?, at),
        None => causes(graph, plan, &answer.files, answer.store.root(), at),
    };
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
