//! Graph → Outcome: makes what is not there yet, side by side, and drops what nobody reads any more.

use crate::graph::{Graph, Source};
use crate::key;
use crate::run_one::{self, Surroundings};
use stage::{AnyArtifact, Files, Hash, Metric};
use std::sync::{Condvar, Mutex};

/// What became of a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// Its result was in the store.
    Found,
    /// Its stage ran.
    Made,
    /// Its stage failed; the text says why. Not cached.
    Failed(String),
    /// It could not run since a node that it reads did not.
    Skipped,
    /// The user asked to stop.
    Cancelled,
}

/// A node after the walk.
#[derive(Debug, Clone)]
pub struct Done {
    /// What became of it.
    pub fate: Fate,
    /// The key of its result.
    pub key: Option<Hash>,
    /// The content of its result.
    pub content: Option<Hash>,
    /// What the key was made of.
    pub story: Vec<(String, String)>,
    /// How long it took: now, or when it was made. \[s\]
    pub seconds: f64,
    /// Size of the result. \[bytes\]
    pub bytes: u64,
    /// Numbers beside the result.
    pub metrics: Vec<Metric>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Done {
    /// A node that made nothing.
    pub(crate) fn nothing(fate: Fate) -> Done {
        let (metrics, warnings, story) = (vec![], vec![], vec![]);
        Done {
            fate,
            key: None,
            content: None,
            story,
            seconds: 0.0,
            bytes: 0,
            metrics,
            warnings,
        }
    }
}

/// Who is told what happens. All methods may be called from any thread.
pub trait Watch: Sync {
    /// A stage starts to run.
    fn started(&self, _node: &str) {}
    /// So much of a loop is done.
    fn progress(&self, _node: &str, _label: &str, _done: usize, _of: usize) {}
    /// A node is done.
    fn done(&self, _node: &str, _done: &Done) {}
}

/// What to walk.
pub struct Job<'a> {
    /// The pipeline.
    pub graph: &'a Graph,
    /// The files of each input, in the graph's order.
    pub files: &'a [Files],
    /// The nodes that are wanted.
    pub wanted: &'a [usize],
    /// How many threads work.
    pub threads: usize,
    /// Whether to go on with what does not depend on a failed node.
    pub keep_going: bool,
}

struct State {
    done: Vec<Option<Done>>,
    /// Nodes that some worker has taken.
    taken: Vec<bool>,
    /// Results in memory, while somebody still reads them.
    alive: Vec<Option<AnyArtifact>>,
    readers: Vec<usize>,
    ready: Vec<usize>,
    running: usize,
    stop: bool,
}

/// Walks: one entry a node, `None` for those that were not wanted.
pub fn walk(job: &Job<'_>, around: &Surroundings<'_>) -> Vec<Option<Done>> {
    let graph = job.graph;
    let needed = needed(graph, job.wanted);
    let mut readers = vec![0; graph.nodes.len()];
    for i in (0..graph.nodes.len()).filter(|i| needed[*i]) {
        for_each_node(graph, i, |j| readers[j] += 1);
    }
    let state = State {
        done: vec![None; graph.nodes.len()],
        taken: vec![false; graph.nodes.len()],
        alive: vec![None; graph.nodes.len()],
        readers,
        ready: vec![],
        running: 0,
        stop: false,
    };
    let (state, bell) = (Mutex::new(state), Condvar::new());
    refill(
        graph,
        &needed,
        &mut state.lock().expect("bug: a worker panicked"),
    );
    std::thread::scope(|scope| {
        for _ in 0..job.threads.max(1) {
            scope.spawn(|| work(job, around, &needed, &state, &bell));
        }
    });
    let mut state = state.into_inner().expect("bug: a worker panicked");
    for i in (0..graph.nodes.len()).filter(|i| needed[*i]) {
        let fate = if around.cancelled() {
            Fate::Cancelled
        } else {
            Fate::Skipped
        };
        state.done[i].get_or_insert_with(|| Done::nothing(fate));
    }
    state.done
}

/// One worker: takes a ready node, runs it, makes others ready.
fn work(
    job: &Job<'_>,
    around: &Surroundings<'_>,
    needed: &[bool],
    state: &Mutex<State>,
    bell: &Condvar,
) {
    let lock = || state.lock().expect("bug: a worker panicked");
    let mut held = lock();
    loop {
        if around.cancelled() {
            held.stop = true;
        }
        if held.stop || (held.ready.is_empty() && held.running == 0) {
            bell.notify_all();
            return;
        }
        let Some(node) = held.ready.pop() else {
            held = bell.wait(held).expect("bug: a worker panicked");
            continue;
        };
        held.running += 1;
        held.taken[node] = true;
        let inputs = contents(job, node, &held);
        let at_hand = at_hand(job, node, &held);
        drop(held);
        let (done, artifact) = run_one::run_one(job, node, &inputs, at_hand, around);
        around.watch.done(&job.graph.nodes[node].name, &done);
        held = lock();
        held.running -= 1;
        if matches!(done.fate, Fate::Failed(_)) && !job.keep_going {
            held.stop = true;
        }
        held.done[node] = Some(done);
        if held.readers[node] > 0 {
            held.alive[node] = artifact;
        }
        let mut freed = Vec::new();
        for_each_node(job.graph, node, |j| freed.push(j));
        for j in freed {
            held.readers[j] -= 1;
            if held.readers[j] == 0 {
                held.alive[j] = None;
            }
        }
        refill(job.graph, needed, &mut held);
        bell.notify_all();
    }
}

/// The nodes that the wanted ones need, themselves included.
pub(crate) fn needed(graph: &Graph, wanted: &[usize]) -> Vec<bool> {
    let mut needed = vec![false; graph.nodes.len()];
    let mut open = wanted.to_vec();
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut needed[i], true) {
            for_each_node(graph, i, |j| open.push(j));
        }
    }
    needed
}

/// The nodes that a node reads, one a port.
fn for_each_node(graph: &Graph, node: usize, mut f: impl FnMut(usize)) {
    for source in graph.nodes[node].from.iter().flatten() {
        if let Source::Node(j) = source {
            f(*j);
        }
    }
}

/// Lists what can run now: the first in the pipeline on top. Skips what cannot run any more.
fn refill(graph: &Graph, needed: &[bool], state: &mut State) {
    state.ready.clear();
    for i in (0..graph.nodes.len()).filter(|i| needed[*i]) {
        if state.done[i].is_some() || state.taken[i] {
            continue;
        }
        let (mut open, mut dead) = (false, false);
        for_each_node(graph, i, |j| match &state.done[j] {
            Some(done) => dead |= done.content.is_none(),
            None => open = true,
        });
        if dead {
            state.done[i] = Some(Done::nothing(Fate::Skipped));
        } else if !open {
            state.ready.push(i);
        }
    }
    state.ready.reverse();
}

/// The content at each port.
fn contents(job: &Job<'_>, node: usize, state: &State) -> Vec<Option<Hash>> {
    let content = |source: &Option<Source>| match source.as_ref()? {
        Source::Input(i) => Some(stage::content(&job.files[*i])),
        Source::Node(j) => state.done[*j].as_ref()?.content,
    };
    job.graph.nodes[node].from.iter().map(content).collect()
}

/// The artifacts at each port that are in memory already.
fn at_hand(job: &Job<'_>, node: usize, state: &State) -> Vec<Option<AnyArtifact>> {
    let artifact = |source: &Option<Source>| match source.as_ref()? {
        Source::Input(i) => Some(AnyArtifact::new(job.files[*i].clone())),
        Source::Node(j) => state.alive[*j].clone(),
    };
    job.graph.nodes[node].from.iter().map(artifact).collect()
}

/// The key of a node when the contents of its inputs are known.
pub(crate) fn key_of(job: &Job<'_>, node: usize, inputs: &[Option<Hash>]) -> Hash {
    key::key(&job.graph.nodes[node], inputs)
}
