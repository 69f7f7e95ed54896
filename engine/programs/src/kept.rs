//! A program that stays (`keep = true`): it gets each job as a line on its standard input, a list of words as
//! JSON. It prints `{"ready": true}` once, and answers each with `{"done": true}` or `{"failed": "why"}` on its
//! standard output.
//!
//! One runs a thread at most: who has a job takes an idle one that is like it, and puts it back.

use crate::child::Line;
use crate::error::ForeignError;
use crate::layout::Layout;
use crate::program::Program;
use crate::resident::{AtWork, Limits, answer};
use crate::tail::Tail;
use crate::task::Task;
use stage::process;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// What two nodes must have in common to be served by one program.
#[derive(Clone, PartialEq, Eq)]
struct Like {
    program: String,
    env: Vec<String>,
    network: bool,
    reads: Vec<String>,
    store: PathBuf,
}

/// A program that stays, and its folder.
pub(crate) struct Kept {
    like: Like,
    /// Its folder.
    pub(crate) layout: Arc<Layout>,
    at_work: Option<AtWork>,
}

/// Idle ones, and how many runs keep those of a store.
struct Idle {
    kept: Vec<Kept>,
    keepers: BTreeMap<PathBuf, usize>,
}

static IDLE: Mutex<Idle> = Mutex::new(Idle {
    kept: Vec::new(),
    keepers: BTreeMap::new(),
});

/// As long as there is one, programs of a store's runs stay; then idle ones end.
pub struct Keeping(PathBuf);

impl Keeping {
    /// For a store, which need not be there yet.
    pub fn new(store: &Path) -> Keeping {
        let above = || {
            Some(
                store
                    .parent()?
                    .canonicalize()
                    .ok()?
                    .join(store.file_name()?),
            )
        };
        let store = store.canonicalize().ok().or_else(above);
        let store = store.unwrap_or_default();
        let mut idle = IDLE.lock().expect("bug: poisoned");
        *idle.keepers.entry(store.clone()).or_default() += 1;
        Keeping(store)
    }
}

impl Drop for Keeping {
    fn drop(&mut self) {
        let mut idle = IDLE.lock().expect("bug: poisoned");
        let count = idle.keepers.entry(self.0.clone()).or_default();
        *count -= 1;
        if *count > 0 {
            return;
        }
        idle.keepers.remove(&self.0);
        let all = std::mem::take(&mut idle.kept);
        let (ending, rest): (Vec<Kept>, Vec<Kept>) =
            all.into_iter().partition(|kept| kept.like.store == self.0);
        idle.kept = rest;
        drop(idle);
        drop(ending);
    }
}

impl Kept {
    /// An idle one for a node's program; else one that is yet to be started.
    pub(crate) fn of(program: &Program, store: &Path) -> Result<Kept, ForeignError> {
        let like = Like {
            program: program.command[0].written.clone(),
            env: program.env.clone(),
            network: program.network,
            reads: program.reads.clone(),
            store: store.into(),
        };
        let mut idle = IDLE.lock().expect("bug: poisoned");
        let serves = |kept: &mut Kept| kept.like == like && kept.lives();
        let found = idle.kept.iter_mut().position(serves);
        let found = found.map(|at| idle.kept.remove(at));
        drop(idle);
        match found {
            Some(kept) => Ok(kept),
            None => Ok(Kept {
                like,
                layout: Arc::new(Layout::new(store)?),
                at_work: None,
            }),
        }
    }

    fn lives(&mut self) -> bool {
        let ended = |at_work: &mut AtWork| process::has_ended(&mut at_work.child);
        !self.at_work.as_mut().is_some_and(ended)
    }

    /// Puts it back for the next job, as long as a run keeps idle ones.
    pub(crate) fn rest(self) {
        let mut idle = IDLE.lock().expect("bug: poisoned");
        if idle.keepers.contains_key(&self.like.store) {
            idle.kept.push(self);
        }
    }

    /// Does a job. After an error other than that the job failed, the program has ended.
    pub(crate) fn run(
        &mut self,
        task: &Task<'_>,
        stop: &dyn Fn() -> bool,
        heard: &mut dyn FnMut(&Line) -> bool,
    ) -> Result<Tail, ForeignError> {
        let mut tail = Tail::default();
        let done = self.answered(task, stop, heard, &mut tail);
        if !matches!(done, Ok(()) | Err(ForeignError::Reported { .. })) {
            self.at_work = None;
        }
        match done {
            Ok(()) => Ok(tail),
            Err(mut error) => {
                error.printed(&tail.text());
                Err(error)
            }
        }
    }

    fn answered(
        &mut self,
        task: &Task<'_>,
        stop: &dyn Fn() -> bool,
        heard: &mut dyn FnMut(&Line) -> bool,
        tail: &mut Tail,
    ) -> Result<(), ForeignError> {
        let limits = Limits {
            task,
            stop,
            start: Instant::now(),
        };
        let at_work = match &mut self.at_work {
            Some(at_work) => at_work,
            none => none.insert(AtWork::started(&limits, tail)?),
        };
        let mut line = serde_json::to_string(&task.words[1..]).expect("bug: JSON");
        line.push('\n');
        // Who has ended is known by how it ended.
        let _ = at_work.words.send(line);
        let answer = at_work.heard(&limits, &mut |line| {
            let answer = answer(line);
            if answer.is_none() && !heard(line) {
                tail.push(&line.text);
            }
            answer
        })?;
        at_work.besides(heard, tail);
        let stayed = at_work.left_behind(task);
        match (answer, stayed.is_empty()) {
            (Ok(()), true) => Ok(()),
            (Ok(()), false) => Err(ForeignError::Stays {
                program: task.name.into(),
                who: stayed,
                tail: String::new(),
            }),
            (Err(why), _) => Err(ForeignError::Reported {
                program: task.name.into(),
                why,
                tail: String::new(),
            }),
        }
    }
}
