//! From a pipeline file to a [`Graph`](crate::graph::Graph): reading, extending, varying, binding.
//!
//! [`Pipeline::read`] reads a file with those that it extends; [`Pipeline::graph`] applies variants
//! and `--set`s and binds it, or returns all mistakes at once.

mod arrange;
mod bind;
mod bind_exec;
mod binder;
mod checked;
mod exec_keys;
mod exec_words;
mod extend;
mod mistake;
mod origins;
mod pipeline;
mod read;
mod searches;
mod sections;
mod shared;
mod stretch;
mod sweep_check;
mod sweeps;
mod toml_text;
mod tree;
mod values;
mod variant;
mod variants;
mod wire;
mod written;

/// The kinds of messages that are declared here, file by file.
pub(crate) const MESSAGES: [&[stage::Template]; 2] = [sections::MESSAGES, variant::MESSAGES];

pub use bind::{Beside, bind};
pub use mistake::{Mistake, Mistakes, Text};
pub use pipeline::{Pipeline, open, open_text};
pub use read::read;
pub(crate) use stretch::{between, values, written};
pub(crate) use sweep_check::no_seed;
pub use values::parse_value;
pub use variant::vary;
pub use written::*;
