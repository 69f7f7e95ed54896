//! The same body again: one surface laid on another, limbs in their own pose, and what grew between them.
//!
//! ```text
//! first, other ─ rigid ─ limbs (by parts) ─ posed ─┬─ carry: planes at the same level
//!                                                  └─ growth: distances, volumes by part
//! ```
//!
//! Kernels without a stage: the product holds captures of months against each other.

mod carry;
mod closest;
mod growth;
mod limbs;
mod rigid;
mod segments;

pub use carry::carried;
pub use closest::{Closest, Hit};
pub use growth::{growth, labels_like, volumes};
pub use limbs::{Posed, posed};
pub use rigid::{Halves, Target, rigid};
pub use segments::{PARTS, Segments, segments};
