//! Sweeps: many points of one pipeline, and what came of each.
//!
//! A sweep is no new machinery: the graphs of its points are one graph, in which what points have in
//! common is one node, and that is walked as any other: side by side, within threads and memory. A
//! point that was there before is found, and a sweep that was killed goes on. What varies upstream
//! varies slowest; rows come in the points' order.
//!
//! ```text
//! [sweep.NAME] ─ axes ─ points ─ whole ─ run ─ rows ─┬─ table: text, CSV, JSON
//!   --sweep ──────┘        │                         ├─ page: plots
//!   replicates: seeds ─────┤                         └─ reported ─┬─ spread: replicates as one
//!                       outlook: how many, how long               └─ paired: do two methods differ
//! ```

mod alike;
pub mod axes;
mod axis;
mod busy;
mod cells;
mod chance;
mod columns;
mod csv;
mod given;
mod outlook;
mod page;
mod paired;
mod plot;
mod points;
mod replicates;
mod reported;
mod row;
mod rows;
mod run;
mod spread;
mod sweeping;
mod table;
pub(crate) mod whole;

pub use crate::numbers::{entries, missing_number};
pub use alike::alike;
pub use axis::{Axis, AxisError};
pub use columns::{Cells, Column, typed};
pub(crate) use given::{pairs_cells, spread_cells};
pub use given::{pairs_text, replicates_text};
pub use outlook::{Outlook, outlook};
pub use page::{Behind, Shown, page, pairs_page};
pub use paired::{Pairs, of_variants, paired};
pub use plot::{Plot, Reference, References};
pub use points::{Point, Points};
pub use replicates::Replicates;
pub use reported::Reported;
pub use row::{End, Kept, Row};
pub use run::run;
pub use spread::{Group, Spread, spread};
pub use sweeping::{Errors, Sweeping};
pub use table::as_csv;
pub use table::{csv, json, statistics, text};
