//! The process of a program that stays: started, heard, watched, ended.

use crate::child::{self, Line};
use crate::error::ForeignError;
use crate::family::{self, Running};
use crate::start::command;
use crate::tail::Tail;
use crate::task::Task;
use serde_json::Value;
use stage::process;
use std::io::Write;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::time::Instant;

/// The process.
pub(crate) struct AtWork {
    pub(crate) child: Child,
    /// Lines for it, written by a thread of their own: it may not listen.
    pub(crate) words: SyncSender<String>,
    lines: Receiver<Line>,
    /// Processes of the family when it was ready.
    own: Vec<u32>,
    _running: Running,
    /// Its other end is where the thread waits that started it.
    _starter: Sender<()>,
}

impl Drop for AtWork {
    fn drop(&mut self) {
        family::end(&self._running.folder, Some(self.child.id()));
        let _ = self.child.wait();
    }
}

/// What a job may take.
pub(crate) struct Limits<'a> {
    pub(crate) task: &'a Task<'a>,
    pub(crate) stop: &'a dyn Fn() -> bool,
    pub(crate) start: Instant,
}

/// What a line of the program reports of its job: done, or why it failed.
pub(crate) fn answer(line: &Line) -> Option<Result<(), String>> {
    let printed = object(line)?;
    match (printed.get("done"), printed.get("failed")) {
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

/// Starts a program on a thread of its own, which lives as long as the other end of what it waits for: in the
/// sandbox a program ends with the thread that started it.
fn spawned(mut command: Command) -> std::io::Result<(Sender<()>, Child)> {
    let (reported, hears) = channel();
    let (starter, waits) = channel::<()>();
    std::thread::Builder::new().spawn(move || {
        let _ = reported.send(command.spawn());
        let _ = waits.recv();
    })?;
    let child = hears.recv().map_err(std::io::Error::other)??;
    Ok((starter, child))
}

/// Sends lines to a program; one that has ended gets none.
fn reported(mut to: ChildStdin) -> std::io::Result<SyncSender<String>> {
    let (words, lines) = sync_channel::<String>(1);
    std::thread::Builder::new().spawn(move || {
        while let Ok(line) = lines.recv() {
            if to.write_all(line.as_bytes()).is_err() {
                return;
            }
        }
    })?;
    Ok(words)
}

impl AtWork {
    /// Starts it, and waits until it is ready.
    pub(crate) fn started(limits: &Limits<'_>, tail: &mut Tail) -> Result<AtWork, ForeignError> {
        let task = limits.task;
        let alone = Task {
            words: &task.words[..1],
            ..*task
        };
        let command = command(&alone, Stdio::piped())?;
        let (_starter, mut child) = spawned(command).map_err(|why| ForeignError::Start {
            program: task.words[0].clone(),
            why,
        })?;
        let _running = Running::new(child.id(), task.root);
        let words = reported(child.stdin.take().expect("bug: no standard input"));
        let heard = words.and_then(|words| Ok((words, child::listened(&mut child)?)));
        let (words, lines) = heard.map_err(|why| child::unheard(task, &mut child, why))?;
        let mut at_work = AtWork {
            child,
            words,
            lines,
            own: vec![],
            _running,
            _starter,
        };
        at_work.heard(limits, &mut |line| {
            let ready = object(line).is_some_and(|printed| printed.get("ready").is_some());
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
    pub(crate) fn heard<T>(
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
            child::may_go_on(task, limits.start, limits.stop, &mut weighed)?;
        }
    }

    /// Takes what else was printed up to now.
    pub(crate) fn besides(&self, heard: &mut dyn FnMut(&Line) -> bool, tail: &mut Tail) {
        while let Ok(line) = self.lines.try_recv() {
            if !heard(&line) {
                tail.push(&line.text);
            }
        }
    }

    /// Who is there after a job that was not there before, a moment later still.
    pub(crate) fn left_behind(&self, task: &Task<'_>) -> String {
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
