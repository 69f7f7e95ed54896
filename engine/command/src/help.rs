//! What the help of a verb leaves out: flags that it never uses.

use super::program::Program;
use super::shared::{NEEDS_NONE, OF_STORE, REFUSES};
use clap::Command;

/// Without the flags of a shared store where a verb never asks one, and everywhere in a program that can use none. They
/// are still understood, and reported to have no effect.
pub(super) fn trimmed(command: Command, program: &Program) -> Command {
    if !cfg!(feature = "remote") {
        return hidden(command);
    }
    let idle = |name: &&str| {
        let own = program.verbs.iter().find(|verb| verb.name == *name);
        own.is_some_and(|verb| !verb.runs) || NEEDS_NONE.contains(name) || *name == REFUSES
    };
    let names: Vec<String> = command
        .get_subcommands()
        .map(|verb| verb.get_name().to_owned())
        .collect();
    let global = command.clone();
    let idle = names.into_iter().filter(|name| idle(&name.as_str()));
    idle.fold(command, |command, name| {
        command.mut_subcommand(name, |verb| {
            let args = global.get_arguments();
            let args = args.filter(|arg| OF_STORE.contains(&arg.get_id().as_str()));
            args.fold(verb, |verb, arg| verb.arg(arg.clone().hide(true)))
        })
    })
}

/// With these flags hidden in every verb.
fn hidden(command: Command) -> Command {
    OF_STORE.into_iter().fold(command, |command, flag| {
        command.mut_arg(flag, |arg| arg.hide(true))
    })
}
