//! Stage graphs with cached artifacts: how a pipeline is read, checked, planned, run, remembered and
//! compared. What flows and what is done with it is a trade's: see [`Catalog`].
//!
//! A pipeline has four forms, each a type, and only the next function makes the next form:
//! [`recipe::Recipe`] (as written) → [`graph::Graph`] (means something) → [`plan`] (found, stale
//! because, waiting) → [`Outcome`].

mod agenda;
pub mod clock;
pub mod delivery;
pub mod differ;
pub mod drawing;
mod drawing_svg;
pub mod graph;
pub mod history;
pub mod impact;
mod journal;
pub mod key;
pub mod kind;
pub mod lasttime;
mod memory;
mod nofollow;
pub mod page;
pub mod past;
pub mod pattern;
pub mod plan;
pub mod recipe;
pub mod reference;
pub mod run_one;
pub mod schema;
mod session;
pub mod source;
pub mod store;
pub mod story;
pub mod sweep;
pub mod verify;
pub mod walk;
pub mod why;

pub use kind::{Catalog, Kind};
pub use session::{EngineError, Options, Outcome, inputs, run, run_in, runs, said_inputs, threads};
