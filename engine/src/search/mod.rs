//! Searches: the best set of params within ranges, point by point through the same cache as sweeps.
//!
//! ```text
//! [search.NAME] ─ rounds: which points ─ sweep::run ─ best so far ─┐
//!                    └──────────────── next round ────────────────┘
//! ```
//!
//! Points hang on the ranges, the seed and the results before alone, so a search that was stopped goes on where it was.

mod found;
mod rounds;

pub use found::{Found, Set, Tried, variant};
pub use rounds::{Round, Values, search};
