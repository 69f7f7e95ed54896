//! One person over time: captures by day, laid on each other, girths at the same anatomical level in all.
//!
//! ```text
//! folders ─ series (days, surfaces) ─ lay (first in each one's pose, planes carried) ─ change ─┬─ words: Markdown, JSON, CSV
//!                                                    │                                         └─ page: curves, coloured body
//!                                                   who: is it the same person?
//! ```

mod change;
mod curve;
mod day;
mod lay;
mod page;
mod part_of;
mod pictures;
mod repeated;
mod series;
mod who;
mod words;

pub use change::{Change, Followed, Line, follow};
pub use lay::{Laid, lay, tapes};
pub use page::page;
pub use repeated::repeated;
pub use series::{Series, Visit, series};
pub use who::{Doubt, doubts};
pub use words::{csv, json, markdown};
