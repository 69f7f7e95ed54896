//! Graph → Outcome: makes what is not there yet, side by side, and drops what nobody reads any more.

use crate::agenda::Agenda;
use crate::graph::{Graph, Source};
use crate::run_one::{self, Step, Surroundings};
use stage::{Files, Hash, Metric};
use std::sync::{Condvar, Mutex};
use std::time::Duration;

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

impl Fate {
    /// As one word, for records.
    pub fn word(&self) -> &'static str {
        match self {
            Fate::Found => "found",
            Fate::Made => "made",
            Fate::Failed(_) => "failed",
            Fate::Skipped => "skipped",
            Fate::Cancelled => "cancelled",
        }
    }
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
    /// What the key was made of; may be empty for what was found ([`crate::key::story`] tells it).
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
    pub fn nothing(fate: Fate) -> Done {
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
    /// Another process makes the node's result just now; asked again and again until it is there.
    fn waits(&self, _node: &str) {}
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
    /// Their content.
    pub contents: &'a [Hash],
    /// The nodes that are wanted.
    pub wanted: &'a [usize],
    /// How many threads work.
    pub threads: usize,
    /// Whether to go on with what does not depend on a failed node.
    pub keep_going: bool,
}

/// How long until it is asked again whether another process has made a result.
const RETRY: Duration = Duration::from_millis(15);

/// Walks: one entry a node, `None` for those that were not wanted.
pub fn walk(job: &Job<'_>, around: &Surroundings<'_>) -> Vec<Option<Done>> {
    let mut agenda = Agenda::new(job);
    around.store.look_around(job.graph.nodes.len());
    settle(job, around, &mut agenda);
    if !agenda.idle() {
        let (shared, bell) = (Mutex::new(agenda), Condvar::new());
        std::thread::scope(|scope| {
            for _ in 0..job.threads.max(1) {
                scope.spawn(|| work(job, around, &shared, &bell));
            }
        });
        agenda = shared.into_inner().expect("bug: a worker panicked");
    }
    let fate = if around.cancelled() {
        Fate::Cancelled
    } else {
        Fate::Skipped
    };
    for i in (0..job.graph.nodes.len()).filter(|i| agenda.needed[*i]) {
        agenda.done[i].get_or_insert_with(|| Done::nothing(fate.clone()));
    }
    agenda.done
}

/// Finds all that can be found without making anything, in the pipeline's order. What is left
/// ready must be made.
fn settle(job: &Job<'_>, around: &Surroundings<'_>, agenda: &mut Agenda<'_>) {
    let mut missing = Vec::new();
    while let Some(node) = agenda.next() {
        let found = match around.cancelled() {
            true => None,
            false => agenda.contents(node).and_then(|inputs| {
                run_one::find(job, node, &inputs, agenda.there(node), around.store)
            }),
        };
        match found {
            Some(done) => {
                around.watch.done(&job.graph.nodes[node].name, &done);
                agenda.finish(node, done, None);
            }
            None => missing.push(node),
        }
    }
    missing.into_iter().for_each(|node| agenda.put_off(node));
    agenda.retry();
}

/// One worker: takes a ready node, runs it, makes others ready.
fn work(job: &Job<'_>, around: &Surroundings<'_>, shared: &Mutex<Agenda<'_>>, bell: &Condvar) {
    let lock = || shared.lock().expect("bug: a worker panicked");
    let name = |node: usize| job.graph.nodes[node].name.as_str();
    let mut held = lock();
    loop {
        held.stop |= around.cancelled();
        if held.stop || held.idle() {
            bell.notify_all();
            return;
        }
        let Some(node) = held.next() else {
            held = if held.has_put_off() {
                let waited = bell.wait_timeout(held, RETRY);
                let (mut held, waited) = waited.expect("bug: a worker panicked");
                if waited.timed_out() {
                    held.retry();
                }
                held
            } else {
                bell.wait(held).expect("bug: a worker panicked")
            };
            continue;
        };
        held.running += 1;
        let inputs = held.contents(node).expect("bug: ready, but it waits");
        let (at_hand, there) = (held.at_hand(node), held.there(node));
        drop(held);
        let step = run_one::run_one(job, node, &inputs, at_hand, there, around);
        if let Step::Done(done, _) = &step {
            around.watch.done(name(node), done);
        }
        held = lock();
        held.running -= 1;
        let skipped = match step {
            Step::Done(done, artifact) => {
                held.stop |= matches!(done.fate, Fate::Failed(_)) && !job.keep_going;
                held.finish(node, done, artifact)
            }
            Step::Busy => {
                around.watch.waits(name(node));
                held.put_off(node);
                vec![]
            }
            Step::Gone(gone) if held.gone(node, &gone) => vec![],
            Step::Gone(gone) => {
                let from = name(gone[0]);
                let why = format!(
                    "the result of `{from}` goes out of the cache as soon as it is made; \
                     give it room, or another place with --cache"
                );
                let done = Done::nothing(Fate::Failed(why));
                around.watch.done(name(node), &done);
                held.stop |= !job.keep_going;
                held.finish(node, done, None)
            }
        };
        for node in skipped {
            let done = held.done[node]
                .as_ref()
                .expect("bug: skipped, but not done");
            around.watch.done(name(node), done);
        }
        bell.notify_all();
    }
}

/// The nodes that the wanted ones need, themselves included.
pub fn needed(graph: &Graph, wanted: &[usize]) -> Vec<bool> {
    let mut needed = vec![false; graph.nodes.len()];
    let mut open = wanted.to_vec();
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut needed[i], true) {
            open.extend(sources(graph, i));
        }
    }
    needed
}

/// The wanted nodes and all that they need: for who reads results on the way, too, which
/// otherwise need not be there as long as their content is known.
pub fn all(graph: &Graph, wanted: &[usize]) -> Vec<usize> {
    let needed = needed(graph, wanted);
    (0..needed.len()).filter(|i| needed[*i]).collect()
}

/// The nodes that a node reads, one a port.
pub fn sources(graph: &Graph, node: usize) -> impl Iterator<Item = usize> {
    let from = graph.nodes[node].from.iter().flatten();
    from.filter_map(|source| match source {
        Source::Node(j) => Some(*j),
        Source::Input(_) => None,
    })
}
