//! Why a program's result was not taken.

use std::path::PathBuf;
use std::time::Duration;

/// Why a program's result was not taken. `tail` is what it printed last.
#[derive(Debug, thiserror::Error)]
pub enum ForeignError {
    /// Nobody allowed it.
    #[error("this program was not allowed: look at it with `plan`, then give --allow-exec")]
    NotAllowed,
    /// There is no sandbox, and it must run in one.
    #[error("{0}, and --sandbox required lets no program run without a sandbox")]
    NoSandbox(String),
    /// There is no such program.
    #[error(
        "there is no program `{0}`: install it, put its folder into PATH, or give its whole path"
    )]
    Missing(String),
    /// It could not be started.
    #[error("`{program}` cannot be started: {why}")]
    Start {
        /// The program.
        program: String,
        /// The system's error.
        why: std::io::Error,
    },
    /// It ended with an error.
    #[error("`{program}` ended with {how}{tail}")]
    Failed {
        /// The program.
        program: String,
        /// Its exit code, or the signal.
        how: String,
        /// What it printed last.
        tail: String,
    },
    /// It stays, and reports that a job failed.
    #[error("`{program}` failed: {why}{tail}")]
    Reported {
        /// The program.
        program: String,
        /// The reason that it gives.
        why: String,
        /// What else it printed last.
        tail: String,
    },
    /// It took too long.
    #[error("`{program}` was ended after {} s: more was not allowed; raise `timeout_s`, if it needs longer{tail}", limit.as_secs_f64())]
    Timeout {
        /// The program.
        program: String,
        /// How long it was allowed.
        limit: Duration,
        /// What it printed last.
        tail: String,
    },
    /// It took too much memory.
    #[error(
        "`{program}` was ended: with its children it took more than {limit_mb} MB; raise `memory_mb`, if it needs more{tail}"
    )]
    Memory {
        /// The program.
        program: String,
        /// How much it was allowed. \[MB\]
        limit_mb: u64,
        /// What it printed last.
        tail: String,
    },
    /// It wrote too much.
    #[error("`{program}` wrote {what}: more than {most} is not taken{tail}")]
    TooMuch {
        /// The program.
        program: String,
        /// How much.
        what: String,
        /// How much is taken.
        most: String,
        /// What it printed last.
        tail: String,
    },
    /// It ended, and its children did not.
    #[error(
        "`{program}` ended and left processes behind ({who}), which were ended: let it wait for them{tail}"
    )]
    Stays {
        /// The program.
        program: String,
        /// Names and numbers.
        who: String,
        /// What it printed last.
        tail: String,
    },
    /// It wrote nothing.
    #[error("`{program}` ended well, but wrote nothing to {{out}}{tail}")]
    Nothing {
        /// The program.
        program: String,
        /// What it printed last.
        tail: String,
    },
    /// It wrote what is no plain file.
    #[error("`{program}` wrote {name}, which is {what}: only plain files are taken")]
    Strange {
        /// The program.
        program: String,
        /// The file.
        name: String,
        /// What it is.
        what: &'static str,
    },
    /// It wrote files that belong to no result of this kind.
    #[error(
        "`{program}` wrote {name}, which is no file of {kind} ({wants}): write what else there is beside {{out}}"
    )]
    Extra {
        /// The program.
        program: String,
        /// The file.
        name: String,
        /// The kind.
        kind: &'static str,
        /// Patterns of its files.
        wants: String,
    },
    /// The importer of the kind refuses.
    #[error("what `{program}` wrote is not taken as {kind}: {why}{tail}")]
    Refused {
        /// The program.
        program: String,
        /// The kind.
        kind: &'static str,
        /// The importer's error.
        why: String,
        /// What the program printed last.
        tail: String,
    },
    /// What it reads beside what it is given cannot be read, or is not what it was when the run began.
    #[error("`reads`: {0}")]
    Reads(String),
    /// Its identity is not what it was when the run began.
    #[error(
        "the identity of `{program}` changed while it ran, from {before:?} to {after:?}; nothing was kept, run again"
    )]
    Identity {
        /// The program.
        program: String,
        /// What was printed before.
        before: String,
        /// What was printed after.
        after: String,
    },
    /// Its identity cannot be found.
    #[error("the identity cannot be found: {0}")]
    NoIdentity(Box<ForeignError>),
    /// A file of the node's is not what it was.
    #[error("{} changed while the run was using it; run again once it no longer changes", .0.display())]
    Changed(PathBuf),
    /// An input cannot be laid out.
    #[error("`{port}` cannot be laid out as files: {why}")]
    Input {
        /// The port.
        port: String,
        /// Why.
        why: String,
    },
    /// The folder for the program.
    #[error("{}: {why}", path.display())]
    Folder {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        why: std::io::Error,
    },
    /// The user asked to stop.
    #[error("stopped")]
    Cancelled,
}

impl ForeignError {
    /// Puts what the program printed last behind the message.
    pub(crate) fn printed(&mut self, last: &str) {
        match self {
            ForeignError::Failed { tail, .. }
            | ForeignError::Reported { tail, .. }
            | ForeignError::Timeout { tail, .. }
            | ForeignError::Memory { tail, .. }
            | ForeignError::TooMuch { tail, .. }
            | ForeignError::Stays { tail, .. }
            | ForeignError::Nothing { tail, .. }
            | ForeignError::Refused { tail, .. } => *tail = last.to_owned(),
            _ => {}
        }
    }
}
