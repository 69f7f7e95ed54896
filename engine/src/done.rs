//! What a walk is given, what becomes of a node, and who hears of it.

use crate::graph::{Graph, Source};
use crate::key::Provenance;
use crate::meter::Spent;
use crate::store::Record;
use stage::{Files, Hash, Message, Metric};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// What became of a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// Its result was in the store.
    Hit,
    /// Its stage ran.
    Executed,
    /// Its stage failed, and why. Not cached.
    Failed(Message),
    /// It could not run since a node that it reads did not.
    Skipped,
    /// The user asked to stop.
    Cancelled,
}

impl Status {
    /// As one word, for records.
    pub fn word(&self) -> &'static str {
        match self {
            Status::Hit => "found",
            Status::Executed => "made",
            Status::Failed(_) => "failed",
            Status::Skipped => "skipped",
            Status::Cancelled => "cancelled",
        }
    }
}

/// A node after the walk.
#[derive(Debug, Clone)]
pub struct Done {
    /// What became of it.
    pub status: Status,
    /// The key of its result.
    pub key: Option<Hash>,
    /// The content of its result.
    pub content: Option<Hash>,
    /// What the key was made of; may be empty for what was found ([`crate::key::provenance`] gives it).
    pub provenance: Vec<(String, String)>,
    /// How long it took: now, or when it was made. \[s\]
    pub seconds: f64,
    /// What that took of the processor and of memory.
    pub spent: Spent,
    /// Size of the result. \[bytes\]
    pub bytes: u64,
    /// Numbers beside the result.
    pub metrics: Vec<Metric>,
    /// What the user should know.
    pub warnings: Vec<Message>,
}

impl Done {
    /// A node that made nothing.
    pub fn nothing(status: Status) -> Done {
        let (metrics, warnings, provenance) = (vec![], vec![], vec![]);
        Done {
            status,
            key: None,
            content: None,
            provenance,
            seconds: 0.0,
            spent: Spent::default(),
            bytes: 0,
            metrics,
            warnings,
        }
    }
}

impl Done {
    /// A node whose stage came to nothing.
    pub(crate) fn failed(key: Hash, provenance: Provenance, why: Message) -> Done {
        Done {
            key: Some(key),
            provenance: provenance.0,
            ..Done::nothing(Status::Failed(why))
        }
    }

    /// A node whose result is in a record.
    pub(crate) fn of(status: Status, key: Hash, mut record: Record) -> Done {
        Done {
            spent: Spent::taken(&mut record.metrics),
            status,
            key: Some(key),
            content: Some(record.content),
            provenance: record.provenance,
            seconds: record.seconds,
            bytes: record.bytes,
            metrics: record.metrics,
            warnings: record.warnings,
        }
    }
}

/// Who hears what happens. All methods may be called from any thread.
pub trait Watch: Sync {
    /// A stage starts to run.
    fn started(&self, _node: &str) {}
    /// Another process makes the node's result just now; asked again and again until it is there.
    fn waits(&self, _node: &str) {}
    /// So much of a loop is done.
    fn progress(&self, _node: &str, _label: &str, _done: usize, _of: usize) {}
    /// Somebody made the same result first, and it has another content than what was made here: the stage
    /// is not deterministic. What was there first counts.
    fn differs(&self, _node: &str, _theirs: Hash, _ours: Hash) {}
    /// A node is done.
    fn done(&self, _node: &str, _done: &Done) {}
}

/// Nobody listens.
impl Watch for () {}

/// Two that hear the same, the first one first.
pub struct Both<'a>(pub &'a dyn Watch, pub &'a dyn Watch);

impl Watch for Both<'_> {
    fn started(&self, node: &str) {
        self.0.started(node);
        self.1.started(node);
    }

    fn waits(&self, node: &str) {
        self.0.waits(node);
        self.1.waits(node);
    }

    fn progress(&self, node: &str, label: &str, done: usize, of: usize) {
        self.0.progress(node, label, done, of);
        self.1.progress(node, label, done, of);
    }

    fn differs(&self, node: &str, theirs: Hash, ours: Hash) {
        self.0.differs(node, theirs, ours);
        self.1.differs(node, theirs, ours);
    }

    fn done(&self, node: &str, done: &Done) {
        self.0.done(node, done);
        self.1.done(node, done);
    }
}

/// Why keys came to nothing in this process: none of them is tried twice. \[key, why\]
#[derive(Debug, Default)]
pub struct Failures(Mutex<BTreeMap<[u8; 32], Message>>);

impl Failures {
    /// Why a key came to nothing, if it did.
    pub(crate) fn of(&self, key: Hash) -> Option<Message> {
        let known = self.0.lock().expect("bug: poisoned");
        known.get(key.as_bytes()).cloned()
    }

    pub(crate) fn note(&self, key: Hash, why: &Message) {
        let mut known = self.0.lock().expect("bug: poisoned");
        known.insert(*key.as_bytes(), why.clone());
    }
}

/// An error as a message: its own, or its words with those of its causes.
pub(crate) fn why(error: &(dyn std::error::Error + 'static)) -> Message {
    if let Some(message) = error.downcast_ref::<Message>() {
        return message.clone();
    }
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text += &format!(": {error}");
        cause = error.source();
    }
    text.into()
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
    /// How many threads work beside the one that asks; with 0 it works itself.
    pub threads: usize,
    /// Whether to go on with what does not depend on a failed node.
    pub keep_going: bool,
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
