//! One node: found in the store, or its stage is run and the result published.

use crate::done::{Done, Failures, Job, Status, Watch, why};
use crate::graph::{Bound, Source};
use crate::key::{self, Digest};
use crate::memory::Memory;
use crate::meter::Meter;
use crate::stopwatch::timed;
use crate::store::{Claim, Record, Store};
use stage::{AnyArtifact, AnyStage, Ctx, Hash, Host, Message, Metric, Stop};
use std::panic::AssertUnwindSafe;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};

/// What a walk happens in.
pub struct Surroundings<'a> {
    /// Where results are kept.
    pub store: &'a Store,
    /// Who hears what happens.
    pub watch: &'a dyn Watch,
    /// Set when the user asks to stop.
    pub cancel: &'a AtomicBool,
    /// The threads that stages share.
    pub pool: &'a Pool,
    /// What came to nothing already.
    pub failures: &'a Failures,
}

/// Threads that are there once somebody needs them, and memory.
pub struct Pool {
    threads: usize,
    /// None where the system gives not one thread.
    pool: OnceLock<Option<rayon::ThreadPool>>,
    memory: Memory,
    meter: Meter,
}

impl Pool {
    /// So many threads; with 0 the one that asks.
    pub fn new(threads: usize) -> Pool {
        Pool {
            threads,
            pool: OnceLock::new(),
            memory: Memory::default(),
            meter: Meter::default(),
        }
    }

    /// Runs something on them, or on fewer where the system gives no more, or on the thread that asks.
    fn install<T: Send>(&self, run: impl FnOnce() -> T + Send) -> T {
        if self.threads == 0 {
            return run();
        }
        let of = |n| rayon::ThreadPoolBuilder::new().num_threads(n);
        let most = || (1..=self.threads).rev().find_map(|n| of(n).build().ok());
        match self.pool.get_or_init(most) {
            Some(pool) => pool.install(run),
            None => {
                // Loops ask for threads of their own unless their thread is one of a pool, which it stays.
                std::mem::forget(of(1).use_current_thread().build());
                run()
            }
        }
    }
}

impl Surroundings<'_> {
    pub(crate) fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}

/// What the engine does for a stage while it runs.
struct Hosting<'a> {
    around: &'a Surroundings<'a>,
    node: &'a str,
    stage: &'static dyn AnyStage,
    metrics: Mutex<Vec<Metric>>,
    warnings: Mutex<Vec<Message>>,
}

impl Host for Hosting<'_> {
    fn cancelled(&self) -> bool {
        self.around.cancelled()
    }
    fn progress(&self, label: &str, done: usize, of: usize) {
        self.around.watch.progress(self.node, label, done, of);
    }
    fn metric(&self, metric: Metric) {
        debug_assert!(
            stage::fits_any(self.stage.metrics(), &metric.name),
            "{} reports `{}`, which its METRICS do not name",
            self.stage.name(),
            metric.name
        );
        self.metrics.lock().expect("bug: poisoned").push(metric);
    }
    fn warn(&self, message: &Message) {
        self.warnings
            .lock()
            .expect("bug: poisoned")
            .push(message.clone());
    }
    fn recall(&self, key: Hash) -> Option<Vec<u8>> {
        self.around.store.recall(key)
    }
    fn remember(&self, key: Hash, bytes: &[u8]) {
        // Best effort: a disk that is full is reported when the result itself is kept.
        let _ = self.around.store.remember(key, bytes);
    }
}

/// What came of a node's turn.
pub(crate) enum Step {
    /// It is done; the artifact if it was made now.
    Done(Box<Done>, Option<AnyArtifact>),
    /// Another process makes it just now.
    Busy,
    /// These results that it reads are gone from the store.
    Gone(Vec<usize>),
}

/// Finds a node's result. Where it need not be `there`, it is enough that its content is known.
pub(crate) fn find(
    job: &Job<'_>,
    node: usize,
    inputs: &[Option<Hash>],
    there: bool,
    store: &Store,
) -> Option<Done> {
    let key = key::key(&job.graph.nodes[node], inputs);
    let found = store.found(key)?;
    if there && !found.present && !store.fetch(found.record.content) {
        return None;
    }
    store.share(key);
    Some(Done::of(Status::Hit, key, found.record))
}

/// Finds or makes a node's result; hands on the artifact if it was made.
pub(crate) fn run_one(
    job: &Job<'_>,
    node: usize,
    inputs: &[Option<Hash>],
    at_hand: Vec<Option<AnyArtifact>>,
    there: bool,
    around: &Surroundings<'_>,
) -> Step {
    let bound = &job.graph.nodes[node];
    let provenance = key::provenance(bound, inputs);
    let key = provenance.key();
    let lease = match around.store.claim(key) {
        Claim::Busy => return Step::Busy,
        Claim::Mine(lease) => lease,
    };
    // The process that had the lease before may have made it; and it may equal what another node made.
    if let Some(done) = find(job, node, inputs, there, around.store) {
        return Step::Done(Box::new(done), None);
    }
    if let Some(why) = around.failures.of(key) {
        return Step::Done(Box::new(Done::failed(key, provenance, why)), None);
    }
    let artifacts = match load(job, node, inputs, at_hand, around.store) {
        Ok(artifacts) => artifacts,
        Err(gone) => return Step::Gone(gone),
    };
    let needs = around
        .pool
        .install(|| bound.stage.memory(&bound.params, &artifacts));
    let _share = around.pool.memory.take(needs, &|| around.cancelled());
    around.watch.started(&bound.name);
    let (done, artifact) = make(bound, key, provenance, artifacts, around);
    if needs > 0 {
        stage::machine::give_freed_memory_back();
    }
    if let Status::Failed(why) = &done.status {
        around.failures.note(key, why);
    }
    drop(lease);
    Step::Done(Box::new(done), artifact)
}

/// Runs the stage and publishes its result.
fn make(
    bound: &Bound,
    key: Hash,
    provenance: key::Provenance,
    artifacts: Vec<Option<AnyArtifact>>,
    around: &Surroundings<'_>,
) -> (Done, Option<AnyArtifact>) {
    let failed = |why: Message| Done::failed(key, provenance.clone(), why);
    let mut recipe = Digest::default();
    key::describe_recipe(bound, &mut recipe);
    let (metrics, warnings) = Default::default();
    let host = Hosting {
        around,
        node: &bound.name,
        stage: bound.stage,
        metrics,
        warnings,
    };
    let ctx = Ctx::new(&host, recipe.finish(), key);
    let run = || {
        around
            .pool
            .install(|| timed(|| bound.stage.run(&bound.params, artifacts, &ctx)))
    };
    let measured = around.pool.meter.begin();
    let (made, seconds) = match std::panic::catch_unwind(AssertUnwindSafe(run)) {
        Ok((Ok(made), took)) => (made, took.as_secs_f64()),
        Ok((Err(Stop::Cancelled), _)) => return (Done::nothing(Status::Cancelled), None),
        Ok((Err(Stop::Failed(error)), _)) => return (failed(why(error.as_ref())), None),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text
                .or(panic.downcast_ref::<&str>().copied())
                .unwrap_or("no message");
            let stage = bound.stage.name();
            return (
                failed(format!("bug in {stage}: {text}; please report it").into()),
                None,
            );
        }
    };
    let spent = measured.end();
    let published = around.store.keep(&made.bytes, seconds).and_then(|content| {
        let mut metrics = host.metrics.into_inner().expect("bug: poisoned");
        metrics.extend(spent.metrics());
        let record = Record {
            provenance: provenance.0.clone(),
            content,
            bytes: made.bytes.len() as u64,
            seconds,
            metrics,
            warnings: host.warnings.into_inner().expect("bug: poisoned"),
        };
        // Where the disk knows no locks, or two machines made it, somebody may have been first.
        let first = around.store.record(key);
        if let Some(first) = first.filter(|first| around.store.holds(first.content)) {
            // It is worth what its record has: nobody knows how long it takes the next time.
            let worth = seconds.max(first.seconds);
            around.store.made_again(key, &first, worth)?;
            return Ok((first, content));
        }
        let first = around.store.create_record(key, &record)?;
        Ok((first.unwrap_or(record), content))
    });
    match published {
        Ok((record, ours)) if record.content != ours => {
            around.watch.differs(&bound.name, record.content, ours);
            (Done::of(Status::Executed, key, record), None)
        }
        Ok((record, _)) => (Done::of(Status::Executed, key, record), Some(made.artifact)),
        Err(error) => (failed(error.to_string().into()), None),
    }
}

/// The artifacts of all ports: from memory, else from the store; or the nodes whose results are
/// not there, or not whole.
fn load(
    job: &Job<'_>,
    node: usize,
    inputs: &[Option<Hash>],
    at_hand: Vec<Option<AnyArtifact>>,
    store: &Store,
) -> Result<Vec<Option<AnyArtifact>>, Vec<usize>> {
    let mut gone = Vec::new();
    let ports = job.graph.nodes[node].from.iter().zip(inputs).zip(at_hand);
    let artifacts = ports
        .map(|((source, content), at_hand)| {
            let (Some(Source::Node(from)), None) = (source, &at_hand) else {
                return at_hand;
            };
            let blob = content.and_then(|content| store.blob(content));
            let stage = job.graph.nodes[*from].stage;
            let artifact = blob.and_then(|blob| stage.read(&blob).ok());
            if artifact.is_none() && !gone.contains(from) {
                gone.push(*from);
            }
            artifact
        })
        .collect();
    if gone.is_empty() {
        Ok(artifacts)
    } else {
        Err(gone)
    }
}
