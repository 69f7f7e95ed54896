//! `impact`: which nodes a param reaches, and what it would cost to change it.

use super::arguments::Change;
use super::fault::Fault;
use super::open::open_pipeline;
use super::program::GlobalArgs;
use clap::Args;
use engine::graph::Graph;
use engine::impact::{Impact, impacts};
use engine::lasttime::History;
use engine::past::Of;
use serde_json::{Value, json};
use tables::aligned;

/// Arguments of `impact`.
#[derive(Args)]
pub(crate) struct ImpactArgs {
    /// A pipeline file (default: the program's own), then params: PARAM or NODE.PARAM; none is all
    what: Vec<String>,
    #[command(flatten)]
    change: Change,
}

/// Prints which nodes a param reaches.
pub(crate) fn impact(args: &ImpactArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let (files, asked): (Vec<_>, Vec<_>) = args
        .what
        .iter()
        .partition(|w| w.ends_with(".toml") || global.catalog().pipeline(w).is_some());
    if files.len() > 1 {
        return Err(Fault::input("one pipeline at a time"));
    }
    let graph = open_pipeline(files.first().map(|f| f.as_ref()), &args.change, global)?;
    reached(&graph, &asked, global)
}

/// Which nodes these params of a pipeline reach, and what changing them costs; none is all.
pub(super) fn reached(graph: &Graph, asked: &[&String], global: &GlobalArgs) -> Result<(), Fault> {
    let all = impacts(graph, &graph.goal);
    let full = |i: &Impact| format!("{}.{}", graph.nodes[i.node].name, i.param);
    let mut shown = Vec::new();
    for name in asked {
        let found = all
            .iter()
            .filter(|i| full(i) == **name || i.param == **name);
        let before = shown.len();
        shown.extend(found);
        if shown.len() == before {
            let names: Vec<String> = all.iter().map(full).collect();
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            return Err(Fault::coded(&stage::unknown("param", name, &known)));
        }
    }
    if asked.is_empty() {
        shown.extend(&all);
    }
    let history = History::of(&global.cache, Of::default());
    let cost = |i: &Impact| seconds(graph, i, &history);
    if global.json {
        let one = |i: &&Impact| {
            let names: Vec<&str> = i
                .reaches
                .iter()
                .map(|n| graph.nodes[*n].name.as_str())
                .collect();
            json!({
                "param": full(i), "stage": graph.nodes[i.node].stage.name(),
                "value": i.value.to_string(), "default": i.default.to_string(),
                "reaches": names, "seconds": cost(i),
            })
        };
        let list: Vec<Value> = shown.iter().map(one).collect();
        crate::outln!(
            "{}",
            serde_json::to_string_pretty(&list).expect("bug: JSON")
        );
        return Ok(());
    }
    let mut table = aligned::table();
    for i in &shown {
        let reached: Vec<&str> = i
            .reaches
            .iter()
            .map(|n| graph.nodes[*n].name.as_str())
            .collect();
        let time = cost(i).map_or("?".into(), |s| format!("{s:.1} s"));
        table.add_row([full(i), i.value.to_string(), time, reached.join(" > ")]);
    }
    for column in [1, 2] {
        aligned::to_the_right(&mut table, column);
    }
    crate::outln!("{}", aligned::lines(&mut table));
    Ok(())
}

/// How long what it reaches took the last time. \[s\]
fn seconds(graph: &Graph, impact: &Impact, history: &History) -> Option<f64> {
    let last = |n: &usize| Some(history.last(&graph.nodes[*n].name)?.seconds);
    impact.reaches.iter().map(last).sum()
}
