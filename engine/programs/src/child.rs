//! A program that runs: started in a folder of its own with a cleared environment, heard, and ended with
//! its children when it takes too long, too much, or the user asks to stop.

use crate::error::ForeignError;
use crate::family::{self, Running};
use crate::sandbox::boxed;
use crate::start::command;
use crate::tail::Tail;
use crate::task::Task;
use crate::weight::weigh;
use stage::process;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::Builder;
use std::time::{Duration, Instant};

/// A line that a program printed.
pub(crate) struct Line {
    /// Whether on standard output.
    pub(crate) out: bool,
    /// The line, without its end.
    pub(crate) text: String,
}

/// A line that is longer comes in pieces. \[bytes\]
const LONGEST_LINE: u64 = 16 * 1024;
/// How long it is waited at most until it is looked at the program again.
pub(crate) const LOOK: Duration = Duration::from_millis(10);
/// How long it is waited before the first of several looks.
pub(crate) const SHORTEST_LOOK: Duration = Duration::from_micros(100);
/// How often memory and disk are looked at.
const WEIGH: Duration = Duration::from_millis(50);
/// How many lines of a program wait to be read; a program that prints more waits, too. \[lines\]
const WAITING_LINES: usize = 64;
/// How long a program that has ended is listened to.
const LISTEN: Duration = Duration::from_secs(2);
/// How long children have to end after their program.
pub(crate) const GRACE: Duration = Duration::from_millis(200);
/// How long the system has to end a sandbox whose first process has ended: nothing can stay in it, but a busy machine is slow.
const SANDBOX_GRACE: Duration = Duration::from_secs(10);

/// Runs a program to its end. `heard` gets each line, and returns whether it has taken it; the last of those that it
/// has not are returned. Nothing of the program runs any more when this returns.
pub(crate) fn run(
    task: &Task<'_>,
    stop: &dyn Fn() -> bool,
    heard: &mut dyn FnMut(&Line) -> bool,
) -> Result<Tail, ForeignError> {
    let mut child = started(task)?;
    let running = Running::new(child.id(), task.root);
    let lines = listened(&mut child).map_err(|why| unheard(task, &mut child, why))?;
    let mut tail = Tail::default();
    let mut hear = |line: Line| {
        if !heard(&line) {
            tail.push(&line.text);
        }
    };
    let ended = watched(task, &mut child, &lines, stop, &mut hear);
    let stayed = match ended {
        Ok(()) => left_behind(task, child.id()),
        Err(_) => String::new(),
    };
    match ended.is_ok() && stayed.is_empty() {
        true => process::end_group(child.id()),
        false => family::end(task.root, Some(child.id())),
    }
    let status = child.wait();
    drop(running);
    // All of the family has ended; without a sandbox a process that left it may keep the pipes open, and print more.
    let since = Instant::now();
    while since.elapsed() < LISTEN
        && let Ok(line) = lines.recv_timeout(GRACE)
    {
        hear(line);
    }
    drop(lines);
    let program = task.name.to_owned();
    if let Err(mut error) = ended {
        error.printed(&tail.text());
        return Err(error);
    }
    let status = status.map_err(|why| ForeignError::Start {
        program: program.clone(),
        why,
    })?;
    if !status.success() {
        let (how, tail) = (how(status), tail.text());
        return Err(ForeignError::Failed { program, how, tail });
    }
    if !stayed.is_empty() {
        let (who, tail) = (stayed, tail.text());
        return Err(ForeignError::Stays { program, who, tail });
    }
    Ok(tail)
}

fn how(status: ExitStatus) -> String {
    match (status.code(), process::signal(status)) {
        (Some(code), _) if code > 128 => format!("exit code {code} (signal {}?)", code - 128),
        (Some(code), _) => format!("exit code {code}"),
        (None, signal) => format!("signal {}", signal.unwrap_or(0)),
    }
}

fn started(task: &Task<'_>) -> Result<Child, ForeignError> {
    let spawned = command(task, Stdio::null())?.spawn();
    spawned.map_err(|why| ForeignError::Start {
        program: task.words[0].clone(),
        why,
    })
}

/// Both outputs, line by line; an error where the system gives no thread for that.
pub(crate) fn listened(child: &mut Child) -> std::io::Result<Receiver<Line>> {
    let (to, from) = sync_channel(WAITING_LINES);
    let (out, err) = (child.stdout.take(), child.stderr.take());
    if let Some(out) = out {
        let to = to.clone();
        Builder::new().spawn(move || listen(out, true, &to))?;
    }
    if let Some(err) = err {
        Builder::new().spawn(move || listen(err, false, &to))?;
    }
    Ok(from)
}

/// Ends a program that nobody can listen to.
pub(crate) fn unheard(task: &Task<'_>, child: &mut Child, why: std::io::Error) -> ForeignError {
    family::end(task.root, Some(child.id()));
    let _ = child.wait();
    let program = task.words[0].clone();
    ForeignError::Start { program, why }
}

fn listen(pipe: impl Read, out: bool, to: &SyncSender<Line>) {
    let mut pipe = BufReader::new(pipe);
    let mut line = Vec::new();
    // A line that is too long comes in pieces.
    while let Ok(1..) = (&mut pipe).take(LONGEST_LINE).read_until(b'\n', &mut line) {
        let text = String::from_utf8_lossy(&line);
        let text = text.trim_end_matches(['\n', '\r']).to_owned();
        if to.send(Line { out, text }).is_err() {
            return;
        }
        line.clear();
    }
}

/// Waits until the program has ended, whose end is not fetched yet; an error if it must be ended.
fn watched(
    task: &Task<'_>,
    child: &mut Child,
    lines: &Receiver<Line>,
    stop: &dyn Fn() -> bool,
    hear: &mut dyn FnMut(Line),
) -> Result<(), ForeignError> {
    let (start, mut weighed) = (Instant::now(), Instant::now());
    let mut closed: Option<Instant> = None;
    loop {
        match lines.recv_timeout(LOOK) {
            Ok(line) => hear(line),
            Err(RecvTimeoutError::Timeout) => {}
            // Both outputs are closed: most programs end at once.
            Err(RecvTimeoutError::Disconnected) => {
                let since = closed.get_or_insert_with(Instant::now).elapsed();
                std::thread::sleep(if since < GRACE { LOOK / 50 } else { LOOK });
            }
        }
        if process::has_ended(child) {
            return Ok(());
        }
        may_go_on(task, start, stop, &mut weighed)?;
    }
}

/// Whether a program may go on that was started then: an error if the user stops it, or it takes too long or too much.
pub(crate) fn may_go_on(
    task: &Task<'_>,
    start: Instant,
    stop: &dyn Fn() -> bool,
    weighed: &mut Instant,
) -> Result<(), ForeignError> {
    if stop() {
        return Err(ForeignError::Cancelled);
    }
    if start.elapsed() > task.timeout {
        return Err(ForeignError::Timeout {
            program: task.name.into(),
            limit: task.timeout,
            tail: String::new(),
        });
    }
    if weighed.elapsed() > WEIGH {
        weigh(task.name, task.root, task.memory_mb, task.most)?;
        *weighed = Instant::now();
    }
    Ok(())
}

/// Who is still there a moment after the program ended.
fn left_behind(task: &Task<'_>, leader: u32) -> String {
    let (start, mut pause) = (Instant::now(), SHORTEST_LOOK);
    let grace = if boxed() { SANDBOX_GRACE } else { GRACE };
    loop {
        let left = family::members(task.root, Some(leader));
        if left.is_empty() {
            return String::new();
        }
        if start.elapsed() > grace {
            let who: Vec<String> = left
                .iter()
                .map(|m| format!("{} {}", m.name, m.id))
                .collect();
            return who.join(", ");
        }
        // A sandbox is gone a moment after its program, as a rule.
        std::thread::sleep(pause);
        pause = (pause * 2).min(LOOK / 5);
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::process::Command;

    #[test]
    fn a_program_that_prints_more_than_is_read_waits() {
        let mut command = Command::new("sh");
        process::lead_group(command.args(["-c", "yes hello | head -c 5000000"]));
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let lines = listened(&mut child).unwrap();
        std::thread::sleep(Duration::from_secs(1));
        assert!(!process::has_ended(&mut child), "all of it is in memory");
        let heard = std::iter::from_fn(|| lines.recv().ok()).count();
        assert_eq!(heard, 5_000_000_usize.div_ceil(6));
        child.wait().unwrap();
    }
}
