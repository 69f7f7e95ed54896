//! A plan on a cluster as the store knows it, and as Slurm does.

use super::fault::Fault;
use super::program::GlobalArgs;
use cluster::{Layer, Sent, Slurm, Strands};
use engine::store::Store;
use engine::strands::{self, Plan};

/// A plan with what is done of it.
pub(super) struct Known {
    pub(super) name: String,
    pub(super) plan: Plan,
    pub(super) strands: Strands,
}

/// Reads a plan, and looks at the store for what is done of it.
pub(super) fn known(name: &str, global: &GlobalArgs) -> Result<Known, Fault> {
    let store = Store::open(&global.cache).map_err(Fault::input)?;
    let (name, plan) = Plan::read(&store, name).map_err(Fault::plan)?;
    let pipeline = strands::pipeline(&plan, global.catalog()).map_err(Fault::input)?;
    let strands = cluster::state(&plan, &pipeline, &store).map_err(Fault::input)?;
    Ok(Known {
        name,
        plan,
        strands,
    })
}

/// What is known of the jobs before: by the queue, or, where that has forgotten all of them, by accounts.
pub(super) fn past(slurm: &Slurm, jobs: &[Sent], layers: &[Layer]) -> Vec<Sent> {
    match jobs.is_empty() && !layers.is_empty() {
        true => slurm.remembered(),
        false => jobs.to_vec(),
    }
}
