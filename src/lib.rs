//! `tailor`: girths of a body from the photographs of one turn, as a stage graph with cached artifacts.
//!
//! A pipeline has four forms, each a type, and only the next function makes the next form:
//! Recipe (as written) → Graph (means something) → Plan (found, stale because, waiting) → Outcome.

pub mod catalog;
pub mod closest;
pub mod graph;
pub mod score;
