//! A program with its places filled: its run, and what its identity prints.

use crate::child::{self, Line};
use crate::error::ForeignError;
use crate::kept::Kept;
use crate::layout::{Job, Layout};
use crate::program::Program;
use crate::tail::Tail;
use crate::task::Task;
use crate::template::{Piece, Template};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// What a result may be at most: bytes and files.
pub(crate) const MOST: (u64, usize) = (4 << 30, 100_000);

/// How long an identity may take.
const IDENTITY: Duration = Duration::from_secs(60);
/// How much of it counts. \[bytes\]
const LONGEST_IDENTITY: usize = 16 * 1024;

/// A path as a word of a command.
pub(crate) fn word(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Runs the node's command, by a program that is kept if there is one; `place` gives what replaces ports and `{out}`.
pub(crate) fn command(
    program: &Program,
    job: &Job,
    place: &dyn Fn(&Piece) -> String,
    kept: Option<&mut Kept>,
    stop: &dyn Fn() -> bool,
    heard: &mut dyn FnMut(&Line) -> bool,
) -> Result<Tail, ForeignError> {
    let words = filled(program, &program.command, job, place);
    let task = Task {
        name: &program.name(),
        words: &words,
        root: job.root(),
        env: &program.env,
        reads: &program.reads,
        network: program.network,
        timeout: program.timeout,
        memory_mb: program.memory_mb,
        most: MOST,
    };
    if let Some(ran) = crate::pretended::run(&task) {
        return ran;
    }
    match kept {
        Some(kept) => kept.run(&task, stop, heard),
        None => child::run(&task, stop, heard),
    }
}

/// What the program's identity prints, without the white space around it; nothing if it has none.
pub(crate) fn identity(
    program: &Program,
    store: &Path,
    stop: &dyn Fn() -> bool,
) -> Result<Option<String>, ForeignError> {
    if program.identity.is_empty() {
        return Ok(None);
    }
    let job = Job::new(&Arc::new(Layout::new(store)?))?;
    job.files(&program.files)?;
    let words = filled(program, &program.identity, &job, &|_| String::new());
    let task = Task {
        name: &words[0],
        words: &words,
        root: job.root(),
        env: &program.env,
        reads: &program.reads,
        network: program.network,
        timeout: IDENTITY,
        memory_mb: program.memory_mb,
        most: MOST,
    };
    let mut printed = String::new();
    let ran = child::run(&task, stop, &mut |line| {
        if line.out && printed.len() + line.text.len() < LONGEST_IDENTITY {
            printed += &line.text;
            printed.push('\n');
        }
        line.out
    });
    match ran {
        Ok(_) => Ok(Some(printed.trim().to_owned())),
        Err(ForeignError::Cancelled) => Err(ForeignError::Cancelled),
        Err(why) => Err(ForeignError::NoIdentity(Box::new(why))),
    }
}

fn filled(
    program: &Program,
    words: &[Template],
    job: &Job,
    place: &dyn Fn(&Piece) -> String,
) -> Vec<String> {
    let of = |piece: &Piece| match piece {
        Piece::Here => word(&job.shown(&job.here())),
        Piece::With(name) => program.output(name),
        other => place(other),
    };
    words.iter().map(|word| word.filled(&of)).collect()
}
