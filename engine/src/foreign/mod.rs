//! Programs as stages: `stage = "exec"`. A node gives a command; what it reads is laid out as the files
//! that its kinds are documented by, the program runs in a folder of its own, and what it leaves is
//! taken in by its kind's importer, as any input.
//!
//! `template` (a command with its placeholders) → `program` (a node's program, what its key holds, what
//! the user allows) → `granted` (identities, `reads`, once it may run) → `stage` (the run: `layout`, `run`,
//! `child`, by `start` in a `sandbox` or confined by a `launcher`, where it sees what is `installed`, with its `family`, or one that is `kept` (`resident`); `results`).

mod child;
mod error;
mod family;
mod granted;
mod identity;
mod installed;
mod kept;
mod launcher;
mod layout;
pub(crate) mod leftover;
mod places;
#[cfg(test)]
mod pretended;
mod program;
mod reads;
mod resident;
mod results;
mod run;
mod sandbox;
mod stage;
mod start;
mod tail;
mod task;
mod template;
mod view;
mod weight;

pub use error::ForeignError;
pub use family::end_all;
pub use identity::Identities;
pub use installed::bring;
pub(crate) use kept::Keeping;
pub use launcher::launched;
pub use leftover::clear;
#[cfg(test)]
pub(crate) use pretended::{Pretended, pretend};
pub use program::{Granted, Program, Script};
pub use sandbox::{Sandbox, require_sandbox, sandbox};
pub use stage::{EXEC, VERSION, laid_out};
pub use template::{Piece, Template};
