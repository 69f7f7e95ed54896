//! One node: found in the store, or its stage is run and the result published.

use crate::graph::Source;
use crate::key::{self, Digest};
use crate::store::{Record, Store};
use crate::walk::{Done, Fate, Job, Watch, key_of};
use stage::{AnyArtifact, Ctx, Hash, Host, Metric, Stop};
use std::panic::AssertUnwindSafe;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// What a walk happens in.
pub struct Surroundings<'a> {
    /// Where results are kept.
    pub store: &'a Store,
    /// Who is told.
    pub watch: &'a dyn Watch,
    /// Set when the user asks to stop.
    pub cancel: &'a AtomicBool,
    /// The threads that stages share.
    pub pool: &'a rayon::ThreadPool,
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
    metrics: Mutex<Vec<Metric>>,
    warnings: Mutex<Vec<String>>,
}

impl Host for Hosting<'_> {
    fn cancelled(&self) -> bool {
        self.around.cancelled()
    }
    fn progress(&self, label: &str, done: usize, of: usize) {
        self.around.watch.progress(self.node, label, done, of);
    }
    fn metric(&self, metric: Metric) {
        self.metrics.lock().expect("bug: poisoned").push(metric);
    }
    fn warn(&self, text: &str) {
        self.warnings
            .lock()
            .expect("bug: poisoned")
            .push(text.into());
    }
    fn recall(&self, key: Hash) -> Option<Vec<u8>> {
        self.around.store.recall(key)
    }
    fn remember(&self, key: Hash, bytes: &[u8]) {
        // Best effort: a disk that is full is told when the result itself is kept.
        let _ = self.around.store.remember(key, bytes);
    }
}

/// Finds or makes a node's result; hands on the artifact if it was made.
pub(crate) fn run_one(
    job: &Job<'_>,
    node: usize,
    inputs: &[Option<Hash>],
    at_hand: Vec<Option<AnyArtifact>>,
    around: &Surroundings<'_>,
) -> (Done, Option<AnyArtifact>) {
    let key = key_of(job, node, inputs);
    if let Some(record) = around.store.record(key)
        && around.store.blob(record.content).is_some()
    {
        return (done(Fate::Found, key, record), None);
    }
    let bound = &job.graph.nodes[node];
    around.watch.started(&bound.name);
    let start = Instant::now();
    let failed = |why: String| {
        let story = key::story(bound, inputs).0;
        Done {
            key: Some(key),
            story,
            ..Done::nothing(Fate::Failed(why))
        }
    };
    let artifacts = match load(job, node, inputs, at_hand, around.store) {
        Ok(artifacts) => artifacts,
        Err(why) => return (failed(why), None),
    };
    let mut recipe = Digest::default();
    key::tell_recipe(bound, &mut recipe);
    let (metrics, warnings) = Default::default();
    let host = Hosting {
        around,
        node: &bound.name,
        metrics,
        warnings,
    };
    let ctx = Ctx::new(&host, recipe.finish(), key);
    let run = || {
        around
            .pool
            .install(|| bound.stage.run(&bound.params, artifacts, &ctx))
    };
    let made = match std::panic::catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(made)) => made,
        Ok(Err(Stop::Cancelled)) => return (Done::nothing(Fate::Cancelled), None),
        Ok(Err(Stop::Failed(error))) => return (failed(chain(error.as_ref())), None),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text
                .or(panic.downcast_ref::<&str>().copied())
                .unwrap_or("no message");
            let stage = bound.stage.name();
            return (
                failed(format!("bug in {stage}: {text}; please report it")),
                None,
            );
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    let published = around.store.keep(&made.bytes).and_then(|content| {
        let record = Record {
            story: key::story(bound, inputs).0,
            content,
            bytes: made.bytes.len() as u64,
            seconds,
            metrics: host.metrics.into_inner().expect("bug: poisoned"),
            warnings: host.warnings.into_inner().expect("bug: poisoned"),
        };
        around.store.write_record(key, &record)?;
        Ok(record)
    });
    match published {
        Ok(record) => (done(Fate::Made, key, record), Some(made.artifact)),
        Err(error) => (failed(error.to_string()), None),
    }
}

fn done(fate: Fate, key: Hash, record: Record) -> Done {
    Done {
        fate,
        key: Some(key),
        content: Some(record.content),
        story: record.story,
        seconds: record.seconds,
        bytes: record.bytes,
        metrics: record.metrics,
        warnings: record.warnings,
    }
}

/// The artifacts of all ports: from memory, else from the store.
fn load(
    job: &Job<'_>,
    node: usize,
    inputs: &[Option<Hash>],
    at_hand: Vec<Option<AnyArtifact>>,
    store: &Store,
) -> Result<Vec<Option<AnyArtifact>>, String> {
    let ports = job.graph.nodes[node].from.iter().zip(inputs).zip(at_hand);
    ports
        .map(|((source, content), at_hand)| {
            let (Some(Source::Node(from)), None) = (source, &at_hand) else {
                return Ok(at_hand);
            };
            let from = &job.graph.nodes[*from];
            let gone = |why: &str| {
                let name = &from.name;
                format!("the result of `{name}` {why} while the run went on; run again")
            };
            let content = content.ok_or_else(|| gone("was not made"))?;
            let blob = store
                .blob(content)
                .ok_or_else(|| gone("went out of the cache"))?;
            from.stage
                .read(&blob)
                .map(Some)
                .map_err(|e| gone(&format!("turned out {e}")))
        })
        .collect()
}

/// An error with its causes.
fn chain(error: &(dyn std::error::Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text += &format!(": {error}");
        cause = error.source();
    }
    text
}
