//! The command line: the engine's verbs, and those that a trade adds.
//!
//! ```no_run
//! use engine::Catalog;
//! static CATALOG: Catalog = Catalog { program: "words 1", rooms: &[], kinds: &[], importers: &[], pipelines: &[] };
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
mod either;
mod ended;
mod export;
mod fault;
mod forget;
mod forget_told;
mod help;
mod host;
mod impact;
mod itself;
mod known;
mod manual;
mod open;
mod pins;
mod planned;
mod private;
mod profiled;
mod program;
mod programs;
mod progress;
mod ran;
mod result;
mod run_verb;
mod search;
mod search_told;
mod shared;
mod show;
mod size;
mod speech;
mod store;
mod strands;
mod study;
mod sweep;
mod sweep_asked;
mod sweep_told;
mod telling;
mod verbs;
mod why;

pub use arguments::{Change, Wanted};
pub use deliver::{check as check_out, finish, inside, lies_in, whose};
pub use engine::text;
pub use fault::Fault;
pub use host::{Host, Telling};
pub use open::{folders, node, open_pipeline};
pub use program::{GlobalArgs, Job, JobOf, Program, Verb, Walls};
pub use progress::above;
pub use ran::Ran;
pub use result::there;
pub use run_verb::execute;
pub use speech::CANCEL;
#[doc(hidden)]
pub use speech::{answer, answer_line, say_line};
pub use sweep::{Heard, Swept, swept};
pub use sweep_asked::SweepArgs;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser};
use ended::ended;
use engine::store::remote::Sharing;
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use verbs::Own;

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
    ($($t:tt)*) => { $crate::say_line(format!($($t)*)) };
}

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    verb: Own,
}

/// Does what the arguments say. Exit codes: 0 done, 1 a stage failed, 2 input or pipeline wrong,
/// 130 cancelled.
pub fn main(program: &'static Program) -> ExitCode {
    let launched = engine::foreign::launched(std::env::args_os().skip(1));
    launched.unwrap_or_else(|| ExitCode::from(run(program, std::env::args_os())))
}

/// The whole command line: the engine's verbs and the program's own.
fn command(program: &'static Program) -> clap::Command {
    let mut command = Cli::command()
        .name(program.name)
        .version(program.version)
        .about(program.about)
        .mut_arg("cache", |arg| arg.env(program.cache_env))
        .mut_arg("max_size", |arg| arg.env(program.size_env))
        .mut_arg("store", |arg| arg.env(program.store_env))
        .mut_arg("sign_key", |arg| arg.env(program.sign_env))
        .mut_arg("trust", |arg| arg.env(program.trust_env));
    for (place, verb) in program.verbs.iter().enumerate() {
        let own = clap::Command::new(verb.name);
        command = command.subcommand((verb.arguments)(own).display_order(place));
    }
    help::trimmed(ahead::of_verbs(command, program), program)
}

/// Whether a command line could be run, the program's name first: verbs, flags and values, not files.
///
/// # Errors
///
/// What `clap` says of it. Help and version count as errors.
pub fn check_arguments<A: Into<OsString> + Clone>(
    program: &'static Program,
    arguments: impl IntoIterator<Item = A>,
) -> Result<(), clap::Error> {
    command(program).try_get_matches_from(arguments).map(|_| ())
}

/// As [`main`], with arguments of the caller's, the program's name first. Returns the exit code.
pub fn run<A: Into<OsString> + Clone>(
    program: &'static Program,
    arguments: impl IntoIterator<Item = A>,
) -> u8 {
    let command = command(program);
    let matches = command.clone().get_matches_from(arguments);
    let mut global = GlobalArgs::from_arg_matches(&matches).unwrap_or_else(|e| e.exit());
    global.program = Some(program);
    let _ = ctrlc::set_handler(|| {
        if CANCEL.swap(true, Ordering::Relaxed) {
            engine::foreign::end_all();
            private::burn();
            std::process::exit(130);
        }
        errln!(
            "Stopping. Finished steps are kept; run the same command to continue. Ctrl-C again stops at once."
        );
    });
    let (name, own) = matches
        .subcommand()
        .unwrap_or_else(|| unreachable!("clap asks for a verb"));
    verbs::hint(name, &global);
    let private = own.try_get_one::<bool>("private").ok().flatten();
    let begun = match private {
        Some(true) => private::cache().map(|cache| global.cache = cache),
        _ => Ok(()),
    };
    let uses = !shared::NEEDS_NONE.contains(&name);
    let sharing = begun.and_then(|()| match uses {
        true => shared::begin(&global, name, private == Some(&true)),
        false => Ok(None),
    });
    let done = sharing.and_then(|sharing| {
        let done = done(
            program,
            command,
            (&matches, own),
            (&global, sharing.as_ref()),
        );
        shared::finish(sharing, shared::innermost(&matches), done, &global)
    });
    speech::flush();
    let verb = program.verbs.iter().find(|verb| verb.name == name);
    if verb.is_some_and(|verb| verb.runs) || ["run", "sweep", "search", "study"].contains(&name) {
        budget::after_run(&global);
    }
    private::burn();
    ended(done, &global)
}

fn done(
    program: &Program,
    command: clap::Command,
    (all, own): (&ArgMatches, &ArgMatches),
    (global, sharing): (&GlobalArgs, Option<&Sharing>),
) -> Result<(), Fault> {
    let name = all.subcommand_name();
    if let Some(verb) = program.verbs.iter().find(|v| Some(v.name) == name) {
        return (verb.run)(own, global);
    }
    let cli = Cli::from_arg_matches(all).unwrap_or_else(|error| error.exit());
    cli.verb.done(own, command, (global, sharing))
}
