//! What a run would do, for `plan` and its aspects: of a pipeline and nodes, or of the program's own verbs.

use super::arguments::{Wanted, Words};
use super::fault::Fault;
use super::open::{folders, open, prefetch};
use super::program::{GlobalArgs, Job};
use clap::ArgMatches;
use engine::graph::Graph;
use engine::plan::{self, Planned};
use engine::store::Store;
use stage::Files;

/// What would run, and of which files.
pub(super) struct Answer {
    pub(super) graph: Graph,
    pub(super) plan: Vec<Option<Planned>>,
    pub(super) files: Vec<Files>,
    pub(super) store: Store,
    /// The nodes that are asked after.
    pub(super) nodes: Vec<String>,
}

impl Answer {
    /// Of what a verb of the program's own would run.
    pub(super) fn of_job(job: Job, global: &GlobalArgs) -> Result<Answer, Fault> {
        let store = Store::open(&global.cache).map_err(Fault::input)?;
        looked_at(job, store)
    }
}

/// What a run of these would do.
pub(super) fn planned(wanted: &Wanted, global: &GlobalArgs) -> Result<Answer, Fault> {
    let prefetch = prefetch(wanted, global);
    let (graph, goal) = open(wanted, global)?;
    let store = Store::open_after(&global.cache, prefetch).map_err(Fault::input)?;
    let folders = folders(&wanted.change)?;
    let nodes = wanted.nodes.clone();
    let job = Job {
        graph,
        folders,
        goal,
        nodes,
    };
    looked_at(job, store)
}

fn looked_at(job: Job, store: Store) -> Result<Answer, Fault> {
    let Job {
        graph,
        folders,
        goal,
        nodes,
    } = job;
    let files = engine::inputs(&graph, &folders, &store).map_err(Fault::input)?;
    let plan = plan::plan(&graph, &files, &goal, &store);
    Ok(Answer {
        graph,
        plan,
        files,
        store,
        nodes,
    })
}

/// The verb comes first.
fn behind(verb: &str) -> Fault {
    let why =
        format!("write `{verb}` first, and behind it what you would write behind `{verb}` itself");
    Fault::input(why)
}

/// What is asked after, if it is a pipeline and nodes of it.
pub(super) fn of_words(words: &Words, global: &GlobalArgs) -> Result<Wanted, Fault> {
    match words.verb(global) {
        Some(verb) => Err(behind(verb)),
        None => Ok(words.wanted(global)),
    }
}

/// What a verb of the program's own would run: `plan measure DIR`.
pub(super) fn of_verb(
    (verb, printed): (&str, &ArgMatches),
    global: &GlobalArgs,
    words: &Words,
) -> Result<Job, Fault> {
    if !words.is_empty() {
        return Err(behind(verb));
    }
    let mut jobs = global.program().jobs.iter();
    let job = jobs.find(|(name, _)| *name == verb);
    (job.expect("bug: a verb without a job").1)(printed, global)
}
