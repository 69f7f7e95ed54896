//! What is done in a story, by the engine's own functions.

use super::mishaps;
use super::oracle::{self, Made, Of};
use super::oracle_forgotten::{self, Before};
use super::oracle_there;
use super::process::Process;
use super::programs::{BAD, program};
use super::story::{Act, Use, What};
use super::working::{came, one_strand, plan, ran, run, work};
use super::world::World;
use crate::done::Status;
use crate::session::EngineError;
use crate::store::retention::{self, Budget};
use crate::store::{self, Store};
use std::panic::AssertUnwindSafe;
use std::sync::Arc;

/// One act; what came of it.
pub(super) fn act(world: &World, act: &Act, process: &Arc<Process>) -> String {
    let machine = &world.machines[act.machine];
    let waits = machine.sweeping.get() > 0;
    if act.what.runs() {
        oracle_there::used(world);
    }
    match &act.what {
        what if waits && what.runs() => "waits".into(),
        What::Run { capture, n } => run(world, process, *capture, *n),
        What::Work { capture, n } => work(world, process, *capture, *n),
        What::Plan { capture, n } => plan(world, process, *capture, *n),
        What::Strand { strand } => one_strand(world, process, *strand),
        What::Upload if waits => "waits".into(),
        What::Upload => upload(world, process),
        What::Gc { most, keep } => gc(world, process, *most, *keep),
        What::Forget { capture } => forget(world, process, *capture),
        What::Pin { name } => pin(world, process, *name),
        What::Unpin { name } => with(world, process, |store| {
            format!("{}", store.unpin(&format!("pin-{name}")))
        }),
        What::Verify => with(world, process, |store| {
            format!("{:?}", retention::verify(store).ok())
        }),
        What::SweepStore { older_s } => sweep_store(world, process, *older_s),
        What::Ask { program, capture } => ask(world, process, *program, *capture),
        other => mishaps::happens(world, act.machine, other),
    }
}

fn with(world: &World, process: &Arc<Process>, act: impl FnOnce(&Store) -> String) -> String {
    match world.store(process) {
        Ok(store) => act(&store),
        Err(why) => format!("no store: {why}"),
    }
}

fn upload(world: &World, process: &Arc<Process>) -> String {
    match world.to_upload(process) {
        Ok(Some(to)) => {
            oracle_there::uploaded(world, process.machine);
            world.upload(process.machine, to);
            "uploaded".into()
        }
        Ok(None) => "nobody takes it".into(),
        Err(why) => why,
    }
}

fn gc(world: &World, process: &Arc<Process>, most: u64, keep: usize) -> String {
    let machine = &world.machines[process.machine];
    with(world, process, |store| {
        let before = (oracle::kept(machine, store), machine.known.borrow().losses);
        let in_use = machine.working.get() > 0;
        machine.sweeping.set(machine.sweeping.get() + 1);
        let budget = Budget {
            most,
            keep_runs: keep,
            keep_records: keep,
        };
        let swept = retention::gc(store, &budget, false);
        oracle::swept(world, machine, &before, in_use, swept.is_ok());
        match swept {
            Ok(swept) => format!("{} results went", swept.results.len()),
            Err(why) => why.to_string(),
        }
    })
}

fn forget(world: &World, process: &Arc<Process>, capture: usize) -> String {
    let m = process.machine;
    let machine = &world.machines[m];
    // As the store is opened now.
    let shares = matches!(machine.uses.get(), Use::Open | Use::Strict);
    with(world, process, |store| {
        let before = Before::of(world, m, capture, shares);
        machine.sweeping.set(machine.sweeping.get() + 1);
        let forget = || store::forget(store, machine.capture(capture));
        let forgotten = std::panic::catch_unwind(AssertUnwindSafe(forget));
        let forgotten = forgotten.unwrap_or_else(|killed| {
            oracle_forgotten::cut_off(world, m, capture, &before);
            std::panic::resume_unwind(killed)
        });
        oracle_forgotten::forgotten(world, m, capture, &before, &forgotten);
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
fn ask(world: &World, process: &Arc<Process>, number: usize, capture: usize) -> String {
    let m = process.machine;
    let machine = &world.machines[m];
    let graph = program(number);
    let granted = || machine.known.borrow().granted.contains(&number);
    let grants = || machine.known.borrow().grants.get(&number).copied();
    machine.known.borrow_mut().touched(capture);
    let (before, grants_before) = (granted(), grants());
    let ran = ran(world, process, (&graph, capture));
    // Other processes may change that meanwhile, also for a while only.
    let (always, ever) = (before && granted(), before || grants() != grants_before);
    match ran {
        Err(why) => why,
        Ok(Err(EngineError::NotAllowed(_))) if !always => "refused".into(),
        Ok(Err(EngineError::NotAllowed(_))) => {
            world.broken("a program that was allowed is refused");
            "refused".into()
        }
        Ok(Err(why)) => why.to_string(),
        Ok(Ok(outcome)) => {
            let executed = |done: &crate::done::Done| matches!(done.status, Status::Executed);
            if !ever {
                world.broken("a program runs that was not allowed");
            }
            if number == BAD && outcome.nodes.iter().flatten().any(executed) {
                world.broken("a link among a program's results is taken for one");
            }
            let made = Made {
                machine: m,
                capture,
                of: Of::Program(number),
            };
            oracle::right(world, m, made, &outcome);
            came(&outcome)
        }
    }
}
