//! Programs of a simulation, which the engine's tests ask for: no process starts, all else is as with any.

use crate::error::ForeignError;
use crate::sandbox;
use crate::tail::Tail;
use crate::task::Task;
use std::cell::Cell;
use std::path::Path;

/// What came of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pretended {
    /// It ended well.
    Done,
    /// It failed.
    Fails,
    /// Who started it was killed meanwhile.
    Killed,
}

/// What a program does with the words of its command; paths are this machine's.
pub type Does = fn(&[String]) -> Pretended;

thread_local! {
    static DOES: Cell<Option<Does>> = const { Cell::new(None) };
    static KILLED: Cell<bool> = const { Cell::new(false) };
}

/// From now on this thread only pretends to run programs.
pub fn pretend(does: Does) {
    DOES.set(Some(does));
}

/// Whether who started the last one was killed: then nobody removes its folders.
pub(crate) fn is_killed() -> bool {
    KILLED.get()
}

/// Pretends to run a program, if this thread does.
pub(crate) fn run(task: &Task<'_>) -> Option<Result<Tail, ForeignError>> {
    let does = DOES.get()?;
    let here = |word: &String| {
        let path = sandbox::hosted(task.root, Path::new(word));
        path.to_string_lossy().into_owned()
    };
    let words: Vec<String> = task.words.iter().map(here).collect();
    let came = does(&words);
    KILLED.set(came == Pretended::Killed);
    Some(match came {
        Pretended::Done => Ok(Tail::default()),
        Pretended::Fails | Pretended::Killed => Err(ForeignError::Failed {
            program: task.name.to_owned(),
            how: "pretended".into(),
            tail: String::new(),
        }),
    })
}
