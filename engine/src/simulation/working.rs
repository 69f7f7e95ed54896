//! Runs and plans, by the engine's own functions.

use super::application::{application, overrides};
use super::oracle::{self, Made, Of};
use super::process::{Hasty, Process, options};
use super::world::{Planned, World};
use crate::done::{Done, Status};
use crate::graph::Graph;
use crate::outcome::Outcome;
use crate::session::{self, EngineError};
use crate::strands::{self, Plan};
use std::sync::Arc;

/// What came of running a graph on a capture, if there is a store.
pub(super) fn ran(
    world: &World,
    process: &Arc<Process>,
    (graph, capture): (&Graph, usize),
) -> Result<Result<Outcome, EngineError>, String> {
    let machine = &world.machines[process.machine];
    let store = world.store(process)?;
    let (hasty, options) = (Hasty::default(), options(&machine.root));
    let folders = world.folders(process.machine, capture);
    let goal = &graph.goal;
    Ok(session::run_in(
        store, graph, &folders, goal, &options, &hasty, &hasty.0,
    ))
}

/// Runs the pipeline of a number on a capture.
pub(super) fn run(world: &World, process: &Arc<Process>, capture: usize, n: usize) -> String {
    let (m, application) = (process.machine, application());
    let machine = &world.machines[m];
    machine.known.borrow_mut().touched(capture);
    world.wanted.set((capture, n));
    match ran(world, process, (application.graph(n), capture)) {
        Ok(Ok(outcome)) => {
            let made = Made {
                machine: m,
                capture,
                of: Of::Number(n),
            };
            oracle::right(world, m, made, &outcome);
            came(&outcome)
        }
        Ok(Err(why)) => why.to_string(),
        Err(why) => why,
    }
}

/// What came of each node.
pub(super) fn came(outcome: &Outcome) -> String {
    let word = |done: &Done| match &done.status {
        Status::Failed(why) => format!("failed ({why})"),
        status => status.word().to_owned(),
    };
    let words: Vec<String> = outcome.nodes.iter().flatten().map(word).collect();
    words.join(" ")
}

fn text(why: impl std::fmt::Display) -> String {
    why.to_string()
}

/// Makes a plan of a capture, and reads it back.
fn planned(
    world: &World,
    process: &Arc<Process>,
    capture: usize,
    n: usize,
) -> Result<(Planned, Plan), String> {
    let m = process.machine;
    world.machines[m].known.borrow_mut().touched(capture);
    let (store, application) = (world.store(process)?, application());
    let points = [(overrides(n), world.folders(m, capture))];
    let asked = strands::Asked {
        pipeline: &application.pipeline,
        points: &points,
        nodes: &[],
    };
    let plan = strands::planned(&asked, "sim 1", &store).map_err(text)?;
    // Its name is of the folder of this story: not shown.
    let none = || "no plan".to_owned();
    let name = plan.write(&store).map_err(|_| none())?;
    let (_, plan) = Plan::read(&store, &name).map_err(|_| none())?;
    let planned = Planned {
        name,
        machine: m,
        capture,
        n,
    };
    Ok((planned, plan))
}

/// Makes a plan, of which processes of all machines may make the strands.
pub(super) fn plan(world: &World, process: &Arc<Process>, capture: usize, n: usize) -> String {
    match planned(world, process, capture, n) {
        Ok((planned, plan)) => {
            world.plan.replace(Some(planned));
            format!("{} strands", plan.strands.len())
        }
        Err(why) => why,
    }
}

/// Makes one strand of the last plan, on whatever machine.
pub(super) fn one_strand(world: &World, process: &Arc<Process>, strand: usize) -> String {
    let Some(planned) = world.plan.borrow().clone() else {
        return "no plan".into();
    };
    let known = &world.machines[process.machine].known;
    known.borrow_mut().touched(planned.capture);
    if planned.machine != process.machine {
        known.borrow_mut().elsewhere.insert(planned.capture);
    }
    let worked = || {
        let store = world.store(process)?;
        let read = Plan::read(&store, &planned.name);
        let (_, plan) = read.map_err(|_| "no plan".to_owned())?;
        made(world, process, (&planned, &plan), strand)
    };
    worked().unwrap_or_else(|why| why)
}

fn made(
    world: &World,
    process: &Arc<Process>,
    (planned, plan): (&Planned, &Plan),
    strand: usize,
) -> Result<String, String> {
    let (m, application) = (process.machine, application());
    let (store, hasty) = (world.store(process)?, Hasty::default());
    let options = options(&world.machines[m].root);
    let of = (plan, strand, &application.pipeline);
    let worked = strands::work_in(store, of, &options, &hasty, &hasty.0).map_err(text)?;
    let of = Made {
        machine: planned.machine,
        capture: planned.capture,
        of: Of::Number(planned.n),
    };
    oracle::right(world, m, of, &worked.outcome);
    Ok(format!("[{}]", came(&worked.outcome)))
}

/// Makes a plan, and all of its strands one after the other.
pub(super) fn work(world: &World, process: &Arc<Process>, capture: usize, n: usize) -> String {
    let worked = || {
        let (planned, plan) = planned(world, process, capture, n)?;
        let strands = 0..plan.strands.len();
        let made = strands.map(|strand| made(world, process, (&planned, &plan), strand));
        made.collect::<Result<String, String>>()
    };
    worked().unwrap_or_else(|why| why)
}
