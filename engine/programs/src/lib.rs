//! What an application brings to the engine: its [`Catalog`], how its artifacts are written as files (`out`), and
//! programs of its users as stages: `stage = "exec"`. A node gives a command; what it reads is laid out as the files
//! that its kinds are documented by, the program runs in a folder of its own, and what it leaves is
//! taken in by its kind's importer, as any input.
//!
//! `template` (a command with its placeholders) → `program` (a node's program, what its key holds, what
//! the user allows) → `granted` (identities, `reads`, once it may run) → `exec` (the run: `layout`, `run`,
//! `child`, by `start` in a `sandbox` or confined by a `launcher`, where it sees what is `installed`, with its `family`, or one that is `kept` (`resident`); `results`).

mod catalog;
mod child;
#[cfg(all(
    target_os = "linux",
    any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        target_arch = "riscv64"
    )
))]
mod confine;
#[cfg(not(all(
    target_os = "linux",
    any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        target_arch = "riscv64"
    )
)))]
#[path = "confine_portable.rs"]
mod confine;
mod error;
mod exec;
mod family;
mod granted;
mod identity;
mod installed;
mod kept;
mod launcher;
mod layout;
pub mod leftover;
pub mod out;
mod places;
pub mod pretended;
mod program;
mod reads;
mod resident;
mod results;
mod run;
mod sandbox;
mod start;
mod tail;
mod task;
mod template;
mod view;
mod weight;

pub use catalog::{Catalog, Importer, Kind, NamedFiles, WriteError, with_own};
pub use error::ForeignError;
pub use exec::{EXEC, VERSION, laid_out};
pub use family::end_all;
pub use identity::Identities;
pub use installed::bring;
pub use kept::Keeping;
pub use launcher::launched;
pub use leftover::clear;
pub use program::{Granted, Program, Script};
pub use sandbox::{Sandbox, require_sandbox, sandbox};
pub use template::{Piece, Template};
