//! A plan on a cluster: what is sent, under which names, and what became of it. The engine of the
//! cluster carries ids and never results: the store is the only truth.

mod dask;
mod export;
mod layers;
mod sent;
mod site;
mod slurm;
mod state;

pub use dask::{Dask, DaskError, Task, tasks};
pub use export::{Rules, makefile, snakefile};
pub use layers::{Layer, Packing, layers};
pub use sent::{Sent, more_memory};
pub use site::{Limits, SlurmError};
pub use slurm::{Slurm, Wish};
pub use state::{Strands, state};
