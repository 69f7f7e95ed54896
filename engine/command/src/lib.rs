//! The command line: the engine's verbs, and those that an application adds.
//!
//! ```no_run
//! use engine::Catalog;
//! static CATALOG: Catalog = Catalog { program: "words 1", stages: &[], kinds: &[], importers: &[], pipelines: &[] };
//! static WORDS: command::Program = command::Program::new("words", "1", "Counts words.", &CATALOG);
//!
//! fn main() -> std::process::ExitCode {
//!     command::main(&WORDS)
//! }
//! ```

mod ahead;
mod answers;
mod arguments;
mod aspects;
mod budget;
mod cache;
mod cluster;
mod dask;
mod deliver;
mod drawing;
mod either;
mod ended;
mod export;
mod fault;
mod forget;
mod forget_report;
mod help;
mod host;
mod impact;
mod itself;
mod known;
mod line;
mod manual;
mod messages;
mod open;
#[cfg(feature = "parquet")]
mod parquet;
mod pins;
mod planned;
mod private;
mod profile;
mod profiled;
mod program;
mod programs;
mod progress;
mod ran;
pub mod reference;
mod result;
mod run_verb;
pub mod schema;
mod search;
mod search_report;
mod search_strands;
mod shared;
mod show;
mod show_runs;
mod size;
mod speech;
mod store;
mod strands;
mod study;
mod sweep;
mod sweep_asked;
mod sweep_behind;
mod sweep_report;
mod telling;
mod verbs;
mod why;

pub use arguments::{Change, Wanted};
pub use deliver::{check as check_out, finish, inside, is_within, whose};
pub use fault::Fault;
pub use host::{Host, Telling};
pub use line::{check_arguments, main, run};
pub use messages::MESSAGES;
pub use open::{folders, node, open_pipeline};
pub use program::{GlobalArgs, Job, JobOf, Program, Verb, Walls};
pub use progress::above;
pub use ran::Ran;
pub use result::there;
pub use run_verb::execute;
pub use speech::CANCEL;
#[doc(hidden)]
pub use speech::{answer, answer_line, error_line};
pub use sweep::{Heard, Swept, swept};
pub use sweep_asked::SweepArgs;
pub use system::text;

/// Prints to standard output; a reader that has gone away is no fault of ours.
#[macro_export]
macro_rules! out {
    ($($t:tt)*) => { $crate::answer(format!($($t)*)) };
}

/// As `out!`, with an end of line.
#[macro_export]
macro_rules! outln {
    ($($t:tt)*) => { $crate::answer_line(format!($($t)*)) };
}

/// Prints a line to standard error, if anybody takes it.
#[macro_export]
macro_rules! errln {
    ($($t:tt)*) => { $crate::error_line(format!($($t)*)) };
}
