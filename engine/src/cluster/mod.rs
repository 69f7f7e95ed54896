//! A plan on a cluster: what is sent, under which names, and what became of it. The engine of the
//! cluster carries ids and never results: the store is the only truth.

mod export;
mod layers;
mod site;
mod slurm;
mod state;

pub use export::{Rules, makefile, snakefile};
pub use layers::{Layer, Packing, layers};
pub use site::{Limits, SlurmError};
pub use slurm::{Sent, Slurm, Wish};
pub use state::{Strands, state};
