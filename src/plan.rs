//! Graph → Plan: found, stale because, or waiting; nothing is run.

use crate::engine;
use crate::graph::{Graph, Source};
use crate::key;
use crate::store::Store;
use serde_json::Value;
use stage::{Files, Hash};

/// What a run would do with a node.
#[derive(Debug, Clone, PartialEq)]
pub enum State {
    /// Its result is in the store.
    Cached,
    /// It will run, since these lines changed against the last run: what, old, new.
    Stale(Vec<(String, String, String)>),
    /// It runs only if something that it reads comes out otherwise than before.
    May,
}

/// A node of the plan.
#[derive(Debug, Clone)]
pub struct Planned {
    /// What a run would do.
    pub state: State,
    /// How long it took the last time. \[s\]
    pub seconds: Option<f64>,
}

/// One entry a node; `None` for those that are not needed.
pub fn plan(
    graph: &Graph,
    files: &[Files],
    wanted: &[usize],
    store: &Store,
) -> Vec<Option<Planned>> {
    let needed = crate::walk::needed(graph, wanted);
    let runs = engine::runs(store.root());
    let mut contents: Vec<Option<Hash>> = vec![None; graph.nodes.len()];
    let mut plan = vec![None; graph.nodes.len()];
    for (i, node) in graph.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(j)) => Some(Some(stage::content(&files[*j]))),
            Some(Source::Node(j)) => contents[*j].map(Some),
        };
        let inputs: Option<Vec<Option<Hash>>> = node.from.iter().map(content).collect();
        let before = last(&runs, &node.name);
        let seconds = before.as_ref().and_then(|b| b["seconds"].as_f64());
        let state = match inputs {
            None => State::May,
            Some(inputs) => {
                let record = store.record(key::key(node, &inputs));
                match record.filter(|r| store.blob(r.content).is_some()) {
                    Some(record) => {
                        contents[i] = Some(record.content);
                        State::Cached
                    }
                    None => State::Stale(changes(&key::story(node, &inputs).0, before.as_ref())),
                }
            }
        };
        plan[i] = Some(Planned { state, seconds });
    }
    plan
}

/// The node's entry in the newest run that has one with a result.
pub fn last(runs: &[(String, Value)], node: &str) -> Option<Value> {
    runs.iter().find_map(|(_, run)| {
        let nodes = run["nodes"].as_array()?;
        nodes
            .iter()
            .find(|n| n["node"] == node && !n["content"].is_null())
            .cloned()
    })
}

/// The lines of a story that differ from those of an earlier entry: what, old, new.
pub fn changes(
    story: &[(String, String)],
    before: Option<&Value>,
) -> Vec<(String, String, String)> {
    let Some(before) = before else {
        return vec![(
            "result".into(),
            "none".into(),
            "never made in this cache".into(),
        )];
    };
    let old: Vec<(String, String)> =
        serde_json::from_value(before["story"].clone()).unwrap_or_default();
    let find = |lines: &[(String, String)], what: &str| {
        lines
            .iter()
            .find(|(w, _)| w == what)
            .map_or("nothing".to_owned(), |(_, v)| v.clone())
    };
    let names = story.iter().chain(
        old.iter()
            .filter(|(w, _)| !story.iter().any(|(x, _)| x == w)),
    );
    let changed: Vec<_> = names
        .map(|(what, _)| (what.clone(), find(&old, what), find(story, what)))
        .filter(|(_, old, new)| old != new)
        .collect();
    match changed.is_empty() {
        true => vec![(
            "result".into(),
            "was made".into(),
            "gone from the cache".into(),
        )],
        false => changed,
    }
}
