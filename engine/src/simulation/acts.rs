//! What is done in a story, by the engine's own functions.

use super::mishaps;
use super::oracle;
use super::oracle_there::{self, There};
use super::process::{Hasty, Process, options};
use super::story::{Act, What};
use super::trade::{overrides, program, trade};
use super::world::World;
use crate::done::Status;
use crate::foreign;
use crate::outcome::Outcome;
use crate::session::{self, EngineError};
use crate::store::keeper::{self, Budget};
use crate::store::remote::{drain, working_beside};
use crate::store::{self, Store};
use crate::strands::{self, Plan};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// One act; what came of it.
pub(super) fn act(world: &World, act: &Act, process: &Arc<Process>) -> String {
    let machine = &world.machines[act.machine];
    let waits = machine.sweeping.get() > 0;
    if matches!(act.what, What::Run { .. } | What::Work { .. }) {
        oracle_there::used(world);
    }
    match &act.what {
        What::Run { .. } | What::Work { .. } if waits => "waits".into(),
        What::Run { capture, n } => run(world, process, *capture, *n),
        What::Work { capture, n } => work(world, process, *capture, *n),
        What::Upload => upload(world, process),
        What::Gc { most, keep } => gc(world, process, *most, *keep),
        What::Forget { capture } => forget(world, process, *capture),
        What::Pin { name } => pin(world, process, *name),
        What::Unpin { name } => with(world, process, |store| {
            format!("{}", store.unpin(&format!("pin-{name}")))
        }),
        What::Verify => with(world, process, |store| keeper::verify(store).to_string()),
        What::SweepStore { older_s } => sweep_store(world, process, *older_s),
        What::Ask { program } => ask(world, process, *program),
        other => mishaps::happens(world, act.machine, other),
    }
}

fn with(world: &World, process: &Arc<Process>, act: impl FnOnce(&Store) -> String) -> String {
    match world.store(process) {
        Ok(store) => act(&store),
        Err(why) => format!("no store: {why}"),
    }
}

/// Runs the pipeline of a number on a capture.
pub(super) fn run(world: &World, process: &Arc<Process>, capture: usize, n: usize) -> String {
    let (m, trade) = (process.machine, trade());
    let machine = &world.machines[m];
    let store = match world.store(process) {
        Ok(store) => store,
        Err(why) => return format!("no store: {why}"),
    };
    machine.known.borrow_mut().touched(capture);
    let (graph, hasty) = (trade.graph(n), Hasty::default());
    let (folders, options) = (world.folders(m, capture), options(&machine.root));
    let ran = session::run_in(
        store,
        graph,
        &folders,
        &graph.goal,
        &options,
        &hasty,
        &hasty.0,
    );
    match ran {
        Ok(outcome) => {
            oracle::right(world, m, (capture, n), &outcome);
            came(&outcome)
        }
        Err(why) => format!("{why}"),
    }
}

/// What came of each node.
fn came(outcome: &Outcome) -> String {
    let word = |done: &crate::done::Done| match &done.status {
        Status::Failed(why) => format!("failed ({why})"),
        status => status.word().to_owned(),
    };
    let words: Vec<String> = outcome.nodes.iter().flatten().map(word).collect();
    words.join(" ")
}

/// The same, strand by strand, by a plan.
fn work(world: &World, process: &Arc<Process>, capture: usize, n: usize) -> String {
    let (m, trade) = (process.machine, trade());
    let machine = &world.machines[m];
    machine.known.borrow_mut().touched(capture);
    let worked = || -> Result<String, String> {
        let store = world.store(process)?;
        let points = [(overrides(n), world.folders(m, capture))];
        let asked = strands::Asked {
            pipeline: &trade.pipeline,
            points: &points,
            nodes: &[],
        };
        let told = |why: &dyn std::fmt::Display| why.to_string();
        let plan = strands::planned(&asked, "sim 1", &store).map_err(|why| told(&why))?;
        let name = plan.write(&store).map_err(|why| told(&why))?;
        let (_, plan) = Plan::read(&store, &name).map_err(|why| told(&why))?;
        let mut text = String::new();
        for strand in 0..plan.strands.len() {
            let (store, hasty) = (world.store(process)?, Hasty::default());
            let of = (&plan, strand, &trade.pipeline);
            let worked = strands::work_in(store, of, &options(&machine.root), &hasty, &hasty.0);
            let worked = worked.map_err(|why| told(&why))?;
            oracle::right(world, m, (capture, n), &worked.outcome);
            text += &format!("[{}]", came(&worked.outcome));
        }
        Ok(text)
    };
    worked().unwrap_or_else(|why| why)
}

/// Uploads what waits.
pub(super) fn upload(world: &World, process: &Arc<Process>) -> String {
    let link = match world.link(process) {
        Ok(Some(link)) => link,
        Ok(None) => return "no shared store".into(),
        Err(why) => return why,
    };
    if link.is_read_only() {
        return "read only".into();
    }
    let store = match world.opened(process, Some(link.clone())) {
        Ok(store) => store,
        Err(why) => return why,
    };
    oracle_there::uploaded(world, process.machine);
    link.look_for_more();
    working_beside(|| drain(&store, &link));
    "uploaded".into()
}

fn gc(world: &World, process: &Arc<Process>, most: u64, keep: usize) -> String {
    let machine = &world.machines[process.machine];
    with(world, process, |store| {
        let before = oracle::kept(machine, store);
        let in_use = machine.working.get() > 0;
        machine.sweeping.set(machine.sweeping.get() + 1);
        let budget = Budget {
            most,
            keep_runs: keep,
            keep_records: 2,
        };
        let swept = keeper::gc(store, &budget, false);
        oracle::swept(world, machine, &before, in_use, swept.is_ok());
        match swept {
            Ok(swept) => format!("{} results went", swept.results.len()),
            Err(why) => why.to_string(),
        }
    })
}

fn forget(world: &World, process: &Arc<Process>, capture: usize) -> String {
    let machine = &world.machines[process.machine];
    with(world, process, |store| {
        let in_use = machine.working.get() > 0;
        let lied = world.server.lies.load(Ordering::Relaxed) > 0;
        let there = There::of(world, process.machine, capture);
        machine.sweeping.set(machine.sweeping.get() + 1);
        let folder = &machine.captures[capture];
        let forgotten = store::forget(store, folder);
        oracle::forgotten(
            world,
            process.machine,
            capture,
            (in_use, lied, &there),
            &forgotten,
        );
        match forgotten {
            Ok(f) => format!(
                "{} results, {} runs, unread {:?}",
                f.results, f.runs, f.unread
            ),
            Err(why) => why.to_string(),
        }
    })
}

/// Names the last run.
fn pin(world: &World, process: &Arc<Process>, name: usize) -> String {
    with(world, process, |store| {
        let Some(id) = crate::past::ids(store.root()).into_iter().next() else {
            return "no run".into();
        };
        match store.pin(&format!("pin-{name}"), &id) {
            Ok(()) => "pinned".into(),
            Err(why) => why.to_string(),
        }
    })
}

fn sweep_store(world: &World, process: &Arc<Process>, older_s: u64) -> String {
    match world.link(process) {
        Ok(Some(link)) if !link.is_read_only() => {
            let older = std::time::Duration::from_secs(older_s);
            match link.sweep(older, false) {
                Ok(swept) => format!("{} records went", swept.records),
                Err(why) => why.to_string(),
            }
        }
        Ok(_) => "not asked".into(),
        Err(why) => why,
    }
}

/// Wants what a program makes; none runs that was not allowed.
fn ask(world: &World, process: &Arc<Process>, number: usize) -> String {
    let machine = &world.machines[process.machine];
    let graph = program(number);
    let nodes = crate::walk::all(&graph, &graph.goal);
    foreign::permissions_here(Some(machine.state.clone()));
    let granted = machine.known.borrow().granted.contains(&number);
    with(world, process, |store| {
        if granted {
            // It would be run outside of the simulation: only asked.
            let settled = foreign::settle(&graph, &nodes, store, &|| false);
            if !settled.refused.is_empty() {
                world.broken("a program that was allowed is refused");
            }
            return "may run".into();
        }
        let again = match world.opened(process, None) {
            Ok(again) => again,
            Err(why) => return why,
        };
        let (hasty, folders) = (Hasty::default(), world.folders(process.machine, 0));
        let options = options(&machine.root);
        let ran = session::run_in(
            again,
            &graph,
            &folders,
            &graph.goal,
            &options,
            &hasty,
            &hasty.0,
        );
        match ran {
            Err(EngineError::NotAllowed(_)) => "refused".into(),
            Err(why) => why.to_string(),
            Ok(_) => {
                world.broken("a program runs that was not allowed");
                "ran".into()
            }
        }
    })
}
