//! `tailor`: girths of a body from the photographs of one turn, as a stage graph with cached artifacts.
//!
//! A pipeline has four forms, each a type, and only the next function makes the next form:
//! [`recipe::Recipe`] (as written) → [`graph::Graph`] (means something) → [`plan`] (found, stale
//! because, waiting) → [`engine::Outcome`].

mod agenda;
pub mod catalog;
mod cli;
pub mod clock;
pub mod closest;
pub mod compare;
pub mod delivery;
pub mod drawing;
mod drawing_svg;
pub mod engine;
pub mod graph;
pub mod history;
pub mod impact;
mod journal;
pub mod key;
pub mod lasttime;
mod memory;
mod nofollow;
pub mod out;
mod page;
pub mod past;
mod pattern;
pub mod plan;
pub mod recipe;
pub mod reference;
pub mod run_one;
pub mod schema;
pub mod score;
pub mod source;
pub mod store;
pub mod sweep;
pub mod verify;
pub mod walk;
pub mod why;

pub use cli::main;
