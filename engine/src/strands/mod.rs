//! A run or a sweep cut into strands, which any machine that sees the store can make: the one protocol
//! behind every cluster.
//!
//! ```text
//! graphs of all points ─ cut ─ strands in layers ─ file: plans/HASH in the store
//!                                                    │
//!                       work: one strand, keys from actual inputs, hit → next, miss → make
//! ```
//!
//! A plan lists what is to be made and from what, not what is there: the same run gives the same plan,
//! and its name is its hash. To work on a strand twice, or on two machines, costs nothing but time.

mod cut;
mod file;
mod planned;
mod work;

pub use cut::{Strand, cut};
pub use file::{InputLine, Plan, PlanError, PointLine, SHORTEST, StrandLine};
pub use planned::{Asked, Folders, Unplanned, planned, wanted};
#[cfg(test)]
pub(crate) use work::work_in;
pub use work::{WorkError, Worked, graph, pipeline, work};
