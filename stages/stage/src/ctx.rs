//! What a stage may ask of its surroundings while it runs; none of it can enter a key.

use crate::{Artifact, Cancelled, Hash, Message, Stop, from_bytes, to_bytes};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A number reported beside the result: kept with it, and reported again when the result is found.
#[derive(Debug, Clone, PartialEq)]
pub struct Metric {
    /// What it counts: `reprojection`.
    pub name: String,
    /// How much.
    pub value: f64,
    /// In what: `px`. Empty for a plain number.
    pub unit: String,
}

/// What the engine does for a running stage.
pub trait Host: Sync {
    /// Whether the user asked to stop.
    fn cancelled(&self) -> bool {
        false
    }
    /// So much of a loop is done.
    fn progress(&self, _label: &str, _done: usize, _of: usize) {}
    /// A number beside the result.
    fn metric(&self, _metric: Metric) {}
    /// Something that the user should know about the result; kept with it.
    fn warn(&self, _message: &Message) {}
    /// What was remembered under a key, if it is still there and whole.
    fn recall(&self, _key: Hash) -> Option<Vec<u8>> {
        None
    }
    /// Remembers part of the work, durably; best effort.
    fn remember(&self, _key: Hash, _bytes: &[u8]) {}
}

/// A host that does nothing: for tests and for callers without an engine.
struct Nobody;
impl Host for Nobody {}

/// The surroundings of a running stage.
pub struct Ctx<'a> {
    host: &'a dyn Host,
    recipe: Hash,
    action: Hash,
}

impl<'a> Ctx<'a> {
    /// For the engine. `recipe` identifies stage, version, format and params; `action` the inputs too.
    pub fn new(host: &'a dyn Host, recipe: Hash, action: Hash) -> Self {
        Ctx {
            host,
            recipe,
            action,
        }
    }

    /// No engine: nothing is remembered, nobody listens.
    pub fn alone() -> Ctx<'static> {
        let nothing = blake3::hash(b"");
        Ctx {
            host: &Nobody,
            recipe: nothing,
            action: nothing,
        }
    }

    /// Fails when the user asked to stop. Call it between strides of the work.
    ///
    /// # Errors
    ///
    /// The user asked to stop.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.host.cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// A loop of so many steps, to be shown; `tick` each.
    pub fn steps(&self, label: &'static str, of: usize) -> Steps<'_> {
        self.host.progress(label, 0, of);
        Steps {
            host: self.host,
            label,
            of,
            done: AtomicUsize::new(0),
        }
    }

    /// Tells a number beside the result. Call it outside of [`Ctx::part`].
    pub fn metric(&self, name: &str, value: f64, unit: &str) {
        self.host.metric(Metric {
            name: name.into(),
            value,
            unit: unit.into(),
        });
    }

    /// Warns the user of something about the result: a [`message!`](crate::message!), which other languages and programs can
    /// read, or a sentence as it is. Call it outside of [`Ctx::part`].
    pub fn warn(&self, message: impl Into<Message>) {
        self.host.warn(&message.into());
    }

    /// Part of the work, such as one photo's, remembered on its own: it is found again when
    /// the stage, its params, `label` and `depends` are equal, whatever else the inputs hold.
    /// `depends` must be the content of all that `make` reads.
    ///
    /// # Errors
    ///
    /// `make` stopped or failed.
    pub fn part<T: Artifact>(
        &self,
        label: &str,
        depends: &[Hash],
        make: impl FnOnce() -> Result<T, Stop>,
    ) -> Result<T, Stop> {
        let key = key("part", self.recipe, label, depends);
        if let Some(found) = self.host.recall(key).and_then(|b| from_bytes(&b).ok()) {
            return Ok(found);
        }
        self.check()?;
        let made = make()?;
        self.host.remember(key, &to_bytes(&made));
        Ok(made)
    }

    /// The state that an interrupted run of this very work left under `label`.
    pub fn resume<T: Artifact>(&self, label: &str) -> Option<T> {
        let key = key("checkpoint", self.action, label, &[]);
        self.host.recall(key).and_then(|b| from_bytes(&b).ok())
    }

    /// Leaves the state of a long iteration under `label`, over what was left there before.
    pub fn checkpoint<T: Artifact>(&self, label: &str, state: &T) {
        self.host
            .remember(key("checkpoint", self.action, label, &[]), &to_bytes(state));
    }
}

/// The key of a part or a checkpoint: lengths before texts, so that nothing can pass for another.
fn key(what: &str, base: Hash, label: &str, depends: &[Hash]) -> Hash {
    let mut hasher = blake3::Hasher::new();
    for text in [what, label] {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.update(base.as_bytes());
    for hash in depends {
        hasher.update(hash.as_bytes());
    }
    hasher.finalize()
}

/// A loop that is shown and can be stopped. May be ticked from any thread.
pub struct Steps<'a> {
    host: &'a dyn Host,
    label: &'static str,
    of: usize,
    done: AtomicUsize,
}

impl Steps<'_> {
    /// One more is done. Fails when the user asked to stop.
    ///
    /// # Errors
    ///
    /// The user asked to stop.
    pub fn tick(&self) -> Result<(), Cancelled> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.host.progress(self.label, done, self.of);
        if self.host.cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }
}
