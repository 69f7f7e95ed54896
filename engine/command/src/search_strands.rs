//! A search on a cluster: the next round that is not there is cut into strands; what is there is read.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::search_report::SearchArgs;
use super::strands;
use engine::recipe::{Overrides, Pipeline};
use engine::store::Store;
use engine::strands::{Asked, Folders, Plan, planned};
use engine::sweep::Point;

/// Why a search stops here.
pub(super) enum Halt {
    /// A mistake, or somebody's wish.
    Fault(Fault),
    /// These strands are to be worked on first: of which round, and their plan.
    Next(usize, Box<Plan>),
}

impl From<Fault> for Halt {
    fn from(fault: Fault) -> Halt {
        Halt::Fault(fault)
    }
}

/// What a round's points are made of.
pub(super) struct Round<'a> {
    pub(super) number: usize,
    pub(super) args: &'a SearchArgs,
    pub(super) pipeline: &'a Pipeline,
    pub(super) all: &'a Overrides,
    pub(super) folders: &'a Folders,
    pub(super) nodes: &'a [String],
    pub(super) global: &'a GlobalArgs,
}

impl Round<'_> {
    /// Which of the points are all there.
    ///
    /// # Errors
    ///
    /// Some are not, and their plan was not worked on yet.
    pub(super) fn there(&self, points: &[Point]) -> Result<Vec<bool>, Halt> {
        let store = Store::open(&self.global.cache).map_err(Fault::input)?;
        let plan = self.plan(points, &store)?;
        if self.is_done(&plan, &store)? {
            return Ok(vec![true; points.len()]);
        }
        let name = plan.write(&store).map_err(Fault::input)?;
        let worked = |after: &String| after.len() >= strands::SHORTEST && name.starts_with(after);
        if !self.args.after.iter().any(worked) {
            return Err(Halt::Next(self.number, Box::new(plan)));
        }
        let one = |point: &Point| {
            let plan = self.plan(std::slice::from_ref(point), &store)?;
            self.is_done(&plan, &store)
        };
        points.iter().map(one).collect()
    }

    fn plan(&self, points: &[Point], store: &Store) -> Result<Plan, Halt> {
        let given = |p: &Point| (p.overrides(self.all), self.folders.clone());
        let given: Vec<(Overrides, Folders)> = points.iter().map(given).collect();
        let asked = Asked {
            pipeline: self.pipeline,
            points: &given,
            nodes: self.nodes,
        };
        let plan = planned(&asked, self.global.catalog().program, store);
        Ok(plan.map_err(Fault::input)?)
    }

    fn is_done(&self, plan: &Plan, store: &Store) -> Result<bool, Halt> {
        let state = cluster::state(plan, self.pipeline, store).map_err(Fault::input)?;
        Ok(state.done.iter().all(|done| *done))
    }
}
