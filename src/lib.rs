//! `tailor`: girths of a body from the photographs of one turn: the product on top of [`engine`].

pub mod catalog;
mod cli;
mod errors;
pub mod kinds;
pub mod measured;
mod photos;
mod program;
mod references;
#[cfg(feature = "serve")]
pub mod serve;
// Without pages some texts are nobody's.
#[cfg_attr(not(feature = "serve"), allow(dead_code))]
mod words;

pub use cli::{Measured, measured};
pub use command;
pub use engine;
pub use program::{check_arguments, main, program, program_over};
pub use study::{compare, girth_file, over_time, reader, repeat, score};
// The engine's modules, under the names by which the product knows them.
pub use engine::{
    delivery, differ, graph, history, impact, key, lasttime, past, plan, provenance, recipe, store,
    sweep, verify, walk, why,
};

/// Every kind of message of this program, folder by folder; those of stages are in their crates.
#[cfg_attr(not(feature = "serve"), allow(dead_code))]
pub(crate) const MESSAGES: &[&[&[stage::Template]]] = &[
    cli::MESSAGES,
    &[words::alike::MESSAGES],
    #[cfg(feature = "serve")]
    &[serve::MESSAGES],
];
