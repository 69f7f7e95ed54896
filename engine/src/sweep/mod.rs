//! Sweeps: many points of one pipeline, and what came of each.
//!
//! A sweep is no new machinery: the graphs of its points are one graph, in which what points have in
//! common is one node, and that is walked as any other: side by side, within threads and memory. A
//! point that was there before is found, and a sweep that was killed goes on. What varies upstream
//! varies slowest; rows come in the points' order.
//!
//! ```text
//! [sweep.NAME] ─ axes ─ points ─ whole ─ run ─ rows
//!   --sweep ──────┘        │
//!   replicates: seeds ─────┴─ outlook: how many, how long
//! ```

mod alike;
pub mod axes;
mod axis;
mod busy;
mod csv;
mod outlook;
mod points;
mod replicates;
mod row;
mod rows;
mod run;
mod sweeping;
pub(crate) mod whole;

pub use crate::numbers::{ENDS, entries, missing_number};
pub use alike::alike;
pub use axis::{Axis, AxisError};
pub use outlook::{Outlook, outlook};
pub use points::{Point, Points, plain};
pub use replicates::Replicates;
pub use row::{End, Kept, Row};
pub use run::run;
pub use sweeping::{Errors, Sweeping};
