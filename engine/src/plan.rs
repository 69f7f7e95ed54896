//! Graph → Plan: found, stale because, or waiting; nothing is run.

use crate::graph::{Graph, Source};
use crate::key;
use crate::lasttime::History;
use crate::past::NodeLine;
use crate::past::Of;
use crate::store::Store;
use stage::{Files, Hash};
use std::collections::BTreeSet;

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
    /// What its result depends on, where all that it reads is known.
    pub inputs: Option<Vec<Option<Hash>>>,
}

/// One entry a node; `None` for those that are not needed.
pub fn plan(
    graph: &Graph,
    files: &[Files],
    wanted: &[usize],
    store: &Store,
) -> Vec<Option<Planned>> {
    store.look_around(graph.nodes.len());
    // What is not settled has a key that no result has.
    crate::permission::settle(graph, &crate::done::all(graph, wanted), store, &|| false);
    let needed = crate::done::needed(graph, wanted);
    let file_contents: Vec<Hash> = files.iter().map(stage::content).collect();
    let history = History::of(store.root(), Of::new(graph, files));
    let mut coming = BTreeSet::new();
    let is_wanted: BTreeSet<usize> = wanted.iter().copied().collect();
    let mut absent = vec![false; graph.nodes.len()];
    let mut contents: Vec<Option<Hash>> = vec![None; graph.nodes.len()];
    let mut plan = vec![None; graph.nodes.len()];
    for (i, node) in graph.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(j)) => Some(Some(file_contents[*j])),
            Some(Source::Node(j)) => contents[*j].map(Some),
        };
        let inputs: Option<Vec<Option<Hash>>> = node.from.iter().map(content).collect();
        let known = inputs.clone();
        let before = || history.last(&node.name);
        let took = |before: &Option<NodeLine>| before.as_ref().map(|b| b.seconds);
        let (state, seconds) = match inputs {
            None => (State::May, took(&before())),
            Some(inputs) => {
                let key = key::key(node, &inputs);
                let found = store.found(key);
                match found.filter(|f| {
                    f.present || !is_wanted.contains(&i) || store.is_elsewhere(f.record.content)
                }) {
                    Some(found) => {
                        contents[i] = Some(found.record.content);
                        absent[i] = !found.present;
                        (State::Cached, Some(found.record.seconds))
                    }
                    // A node before this one makes the same.
                    None if !coming.insert(*key.as_bytes()) => (State::May, took(&before())),
                    None => {
                        let before = before();
                        let provenance = key::provenance(node, &inputs);
                        let changes = changes(&provenance.0, before.as_ref());
                        (State::Stale(changes), took(&before))
                    }
                }
            }
        };
        plan[i] = Some(Planned {
            state,
            seconds,
            inputs: known,
        });
    }
    read_again(graph, &absent, &mut plan);
    store.save_index();
    plan
}

/// Results that are gone are made again only for who reads them.
fn read_again(graph: &Graph, absent: &[bool], plan: &mut [Option<Planned>]) {
    for i in (0..graph.nodes.len()).rev() {
        let gone = |state: &State| match state {
            State::Cached => None,
            State::Stale(_) => Some(State::Stale(
                GONE.map(|(a, b, c)| (a.into(), b.into(), c.into()))
                    .to_vec(),
            )),
            State::May => Some(State::May),
        };
        let Some(state) = plan[i].as_ref().and_then(|p| gone(&p.state)) else {
            continue;
        };
        for j in crate::done::sources(graph, i).filter(|j| absent[*j]) {
            if let Some(source) = &mut plan[j]
                && !matches!(source.state, State::Stale(_))
            {
                source.state = state.clone();
            }
        }
    }
}

/// What `why` reports of a result that is not there any more.
const GONE: [(&str, &str, &str); 1] = [("result", "was made", "gone from the cache")];

/// The lines of a provenance that differ from those of an earlier entry: what, old, new.
pub fn changes(
    provenance: &[(String, String)],
    before: Option<&NodeLine>,
) -> Vec<(String, String, String)> {
    let Some(before) = before else {
        return vec![(
            "result".into(),
            "none".into(),
            "never made in this cache".into(),
        )];
    };
    let old = &before.provenance;
    let find = |lines: &[(String, String)], what: &str| {
        lines
            .iter()
            .find(|(w, _)| w == what)
            .map_or("nothing".to_owned(), |(_, v)| v.clone())
    };
    let names = provenance.iter().chain(
        old.iter()
            .filter(|(w, _)| !provenance.iter().any(|(x, _)| x == w)),
    );
    let changed: Vec<_> = names
        .map(|(what, _)| (what.clone(), find(old, what), find(provenance, what)))
        .filter(|(_, old, new)| old != new)
        .collect();
    match changed.is_empty() {
        true => GONE
            .map(|(a, b, c)| (a.into(), b.into(), c.into()))
            .to_vec(),
        false => changed,
    }
}
