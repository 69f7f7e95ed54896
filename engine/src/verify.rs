//! Whether stages keep their word: each is run once more, on one thread and with nothing
//! remembered, and must give the same bytes.

use crate::graph::{Graph, Source};
use crate::key::{self, Digest};
use crate::outcome::Outcome;
use crate::session::{self, EngineError, Options};
use crate::store::Store;
use stage::{AnyArtifact, Ctx, Hash, Host};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// A node whose stage does not give the same bytes twice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unsteady {
    /// The node.
    pub node: String,
    /// Where, in what way.
    pub what: String,
}

/// Remembers nothing.
struct Fresh<'a>(&'a AtomicBool);

impl Host for Fresh<'_> {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Runs every stage of a finished run once more; `started` is called with each node's name before. The
/// results of the run must still be there (see [`crate::walk::all`]).
///
/// # Errors
///
/// Store or inputs cannot be used.
pub fn verify(
    graph: &Graph,
    folders: &[(String, PathBuf)],
    outcome: &Outcome,
    options: &Options,
    cancel: &AtomicBool,
    started: &dyn Fn(&str),
) -> Result<Vec<Unsteady>, EngineError> {
    let store = Store::open(&options.cache)?;
    let files = session::inputs(graph, folders, &store)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("bug: no thread");
    let mut unsteady = Vec::new();
    for (i, node) in graph.nodes.iter().enumerate() {
        let Some(content) = outcome.nodes[i].as_ref().and_then(|d| d.content) else {
            continue;
        };
        if cancel.load(Ordering::Relaxed) {
            break;
        }
        started(&node.name);
        let input = |source: &Option<Source>| match source.as_ref()? {
            Source::Input(j) => Some(AnyArtifact::new(files[*j].clone())),
            Source::Node(j) => outcome.artifact(graph, *j),
        };
        let inputs = node.from.iter().map(input).collect();
        let mut recipe = Digest::default();
        key::describe_recipe(node, &mut recipe);
        let recipe = recipe.finish();
        let ctx_host = Fresh(cancel);
        let ctx = Ctx::new(&ctx_host, recipe, recipe);
        let made = pool.install(|| node.stage.run(&node.params, inputs, &ctx));
        let what = match made {
            Ok(made) if stage::hash(&made.bytes) == content => continue,
            Ok(made) => difference(&store, content, &made.bytes),
            Err(stage::Stop::Cancelled) => break,
            Err(stage::Stop::Failed(error)) => format!("failed the second time: {error}"),
        };
        let node = node.name.clone();
        unsteady.push(Unsteady { node, what });
    }
    Ok(unsteady)
}

/// Where two results differ first.
fn difference(store: &Store, content: Hash, again: &[u8]) -> String {
    let Some(first) = store.blob(content) else {
        return "the first result is gone from the cache".into();
    };
    let at = first.iter().zip(again).position(|(a, b)| a != b);
    let at = at.unwrap_or(first.len().min(again.len()));
    let (n, m) = (first.len(), again.len());
    format!("differs from byte {at} on ({n} bytes, then {m}): its stage is not deterministic")
}
