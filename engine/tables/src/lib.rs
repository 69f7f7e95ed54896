//! What the points of a sweep came to, for people and for other programs.
//!
//! ```text
//! rows ─┬─ table: text, CSV, JSON          aligned: a table on a screen
//!       ├─ page: plots ── html: one file
//!       ├─ columns: with types
//!       └─ reported ─┬─ spread: replicates as one
//!                    └─ paired: do two methods differ ─ study: kept, and made again
//! ```

pub mod aligned;
mod cells;
mod chance;
mod columns;
mod given;
pub mod html;
mod page;
mod paired;
mod plot;
mod reported;
mod spread;
mod study;
mod table;

pub use columns::{Cells, Column, typed};
pub use given::{pairs_text, replicates_text};
pub use page::{Behind, Shown, page, pairs_page};
pub use paired::{Pairs, of_variants, paired};
pub use plot::{Plot, Reference, References};
pub use reported::Reported;
pub use spread::{Group, Spread, spread};
pub use study::{Moved, Table};
pub use table::{as_csv, csv, json, statistics, text};
