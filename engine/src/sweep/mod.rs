//! Sweeps: many points of one pipeline, and what came of each.
//!
//! A sweep is no new machinery: each point is a run of its own through the same store, so what two
//! points have in common is made once, a point that was there before is found, and a sweep that
//! was killed goes on. What varies upstream varies slowest, and a point is finished before the
//! next begins.
//!
//! ```text
//! [sweep.NAME] ─ axes ─ points ─ run ─ rows ─┬─ table: text, CSV, JSON
//!   --sweep ──────┘        │                 └─ page: plots
//!                       outlook: how many, how long
//! ```

pub mod axes;
mod axis;
mod busy;
mod csv;
mod outlook;
mod page;
mod points;
mod run;
mod table;

pub use crate::tells::{entries, untellable};
pub use axis::{Axis, AxisError};
pub use outlook::{Outlook, outlook};
pub use page::page;
pub use points::{Point, Points};
pub use run::{End, Errors, Row, Sweeping, run};
pub use table::{csv, json, text};
