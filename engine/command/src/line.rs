//! A whole command line: arguments to a verb, the verb done, an exit code.

use super::ended::ended;
use super::fault::Fault;
use super::program::{GlobalArgs, Program};
use super::speech::{self, CANCEL};
use super::verbs::{self, Own};
use super::{ahead, budget, help, private, shared};
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser};
use engine::store::remote::Sharing;
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::atomic::Ordering;

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    verb: Own,
}

/// Does what the arguments ask for. Exit codes: 0 done, 1 a stage failed, 2 input or pipeline wrong,
/// 130 cancelled.
pub fn main(program: &'static Program) -> ExitCode {
    let launched = programs::launched(std::env::args_os().skip(1));
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
/// What `clap` reports. Help and version count as errors.
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
            programs::end_all();
            private::burn();
            std::process::exit(130);
        }
        crate::errln!(
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
