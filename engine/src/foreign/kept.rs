//! A program that stays (`keep = true`): told of each job by a line on its standard input, a list of words as
//! JSON. It says `{"ready": true}` once, and answers each with `{"done": true}` or `{"failed": "why"}` on its standard
//! output.
//!
//! One runs a thread at most: who has a job takes an idle one that is like it, and puts it back.

use super::child::{self, Line, Task};
use super::error::ForeignError;
use super::family::{self, Running};
use super::layout::Layout;
use super::program::Program;
use super::tail::Tail;
use super::weight::weigh;
use serde_json::Value;
use stage::process;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// What two nodes must have in common to be served by one program.
#[derive(Clone, PartialEq, Eq)]
struct Like {
    program: String,
    env: Vec<String>,
    network: bool,
    store: PathBuf,
}

/// A program that stays, and its folder.
pub(super) struct Kept {
    like: Like,
    /// Its folder.
    pub(super) layout: Arc<Layout>,
    at_work: Option<AtWork>,
}

/// The process itself.
struct AtWork {
    child: Child,
    words: ChildStdin,
    lines: Receiver<Line>,
    /// Processes of the family when it was ready.
    own: Vec<u32>,
    _running: Running,
}

/// Idle ones, and how many hold them.
static IDLE: Mutex<(Vec<Kept>, usize)> = Mutex::new((Vec::new(), 0));

/// As long as one is held, programs stay; then idle ones end.
pub(crate) struct Keeping(());

impl Keeping {
    pub(crate) fn new() -> Keeping {
        IDLE.lock().expect("bug: poisoned").1 += 1;
        Keeping(())
    }
}

impl Drop for Keeping {
    fn drop(&mut self) {
        let mut idle = IDLE.lock().expect("bug: poisoned");
        idle.1 -= 1;
        let ending = match idle.1 {
            0 => std::mem::take(&mut idle.0),
            _ => vec![],
        };
        drop(idle);
        drop(ending);
    }
}

impl Drop for AtWork {
    fn drop(&mut self) {
        family::end(&self._running.folder, Some(self.child.id()));
        let _ = self.child.wait();
    }
}

impl Kept {
    /// An idle one for a node's program, its folder emptied; else one that is yet to be started.
    pub(super) fn of(program: &Program, store: &Path) -> Result<Kept, ForeignError> {
        let like = Like {
            program: program.command[0].written.clone(),
            env: program.env.clone(),
            network: program.network,
            store: store.into(),
        };
        let mut idle = IDLE.lock().expect("bug: poisoned");
        let serves = |kept: &mut Kept| kept.like == like && kept.lives();
        let found = idle.0.iter_mut().position(serves);
        let found = found.map(|at| idle.0.remove(at));
        drop(idle);
        match found {
            Some(kept) => kept.layout.emptied().map(|()| kept),
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

    /// Puts it back for the next job, as long as somebody holds idle ones.
    pub(super) fn rest(self) {
        let mut idle = IDLE.lock().expect("bug: poisoned");
        if idle.1 > 0 {
            idle.0.push(self);
        }
    }

    /// Does a job. After an error other than that the job failed, the program has ended.
    pub(super) fn run(
        &mut self,
        task: &Task<'_>,
        stop: &dyn Fn() -> bool,
        heard: &mut dyn FnMut(&Line) -> bool,
    ) -> Result<Tail, ForeignError> {
        let mut tail = Tail::default();
        let done = self.answered(task, stop, heard, &mut tail);
        if !matches!(done, Ok(()) | Err(ForeignError::Told { .. })) {
            self.at_work = None;
        }
        match done {
            Ok(()) => Ok(tail),
            Err(mut error) => {
                error.said(&tail.text());
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
        // Who has ended is told by how he ended.
        let _ = at_work.words.write_all(line.as_bytes());
        let answer = at_work.heard(&limits, &mut |line| {
            let answer = answer(line);
            if answer.is_none() && !heard(line) {
                tail.push(&line.text);
            }
            answer
        })?;
        let stayed = at_work.left_behind(task);
        match (answer, stayed.is_empty()) {
            (Ok(()), true) => Ok(()),
            (Ok(()), false) => Err(ForeignError::Stays {
                program: task.name.into(),
                who: stayed,
                tail: String::new(),
            }),
            (Err(why), _) => Err(ForeignError::Told {
                program: task.name.into(),
                why,
                tail: String::new(),
            }),
        }
    }
}

/// What a job may take.
struct Limits<'a> {
    task: &'a Task<'a>,
    stop: &'a dyn Fn() -> bool,
    start: Instant,
}

/// What a line of the program says of its job: done, or why it failed.
fn answer(line: &Line) -> Option<Result<(), String>> {
    let said = object(line)?;
    match (said.get("done"), said.get("failed")) {
        (Some(Value::Bool(true)), _) => Some(Ok(())),
        (_, Some(Value::String(why))) => Some(Err(why.clone())),
        _ => None,
    }
}

fn object(line: &Line) -> Option<Value> {
    let text = line.text.trim();
    let likely = line.out && text.starts_with('{');
    serde_json::from_str(text).ok().filter(|_| likely)
}

impl AtWork {
    /// Starts it, and waits until it is ready.
    fn started(limits: &Limits<'_>, tail: &mut Tail) -> Result<AtWork, ForeignError> {
        let task = limits.task;
        let mut child = child::started(task, Stdio::piped())?;
        let _running = Running::new(child.id(), task.root);
        let lines = child::listened(&mut child);
        let words = child.stdin.take().expect("bug: no standard input");
        let mut at_work = AtWork {
            child,
            words,
            lines,
            own: vec![],
            _running,
        };
        at_work.heard(limits, &mut |line| {
            let ready = object(line).is_some_and(|said| said.get("ready").is_some());
            if !ready {
                tail.push(&line.text);
            }
            ready.then_some(())
        })?;
        let family = family::members(task.root, Some(at_work.child.id()));
        at_work.own = family.iter().map(|member| member.id).collect();
        Ok(at_work)
    }

    /// Listens until a line is what is waited for.
    fn heard<T>(
        &mut self,
        limits: &Limits<'_>,
        wanted: &mut dyn FnMut(&Line) -> Option<T>,
    ) -> Result<T, ForeignError> {
        let (task, mut weighed) = (limits.task, Instant::now());
        loop {
            match self.lines.recv_timeout(child::LOOK) {
                Ok(line) => match wanted(&line) {
                    Some(found) => return Ok(found),
                    None => continue,
                },
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) if process::has_ended(&mut self.child) => {
                    return Err(ForeignError::Failed {
                        program: task.name.into(),
                        how: "no answer to its job".into(),
                        tail: String::new(),
                    });
                }
                Err(RecvTimeoutError::Disconnected) => std::thread::sleep(child::LOOK),
            }
            if (limits.stop)() {
                return Err(ForeignError::Cancelled);
            }
            if limits.start.elapsed() > task.timeout {
                return Err(ForeignError::Timeout {
                    program: task.name.into(),
                    limit: task.timeout,
                    tail: String::new(),
                });
            }
            if weighed.elapsed() > child::WEIGH {
                weigh(task.name, task.root, task.memory_mb, task.most)?;
                weighed = Instant::now();
            }
        }
    }

    /// Who is there after a job that was not there before, a moment later still.
    fn left_behind(&self, task: &Task<'_>) -> String {
        let start = Instant::now();
        loop {
            let mut left = family::members(task.root, Some(self.child.id()));
            left.retain(|member| !self.own.contains(&member.id));
            if left.is_empty() || start.elapsed() > child::GRACE {
                let who = left.iter().map(|m| format!("{} {}", m.name, m.id));
                return who.collect::<Vec<_>>().join(", ");
            }
            std::thread::sleep(child::LOOK / 5);
        }
    }
}
