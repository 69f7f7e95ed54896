//! Past one machine: strands of a plan worked on by processes that know nothing of each other.

mod exports;
mod place;
mod site;
mod slurm;
mod workers;
