//! What must hold, whatever happens.

use super::application::application;
use super::machine::Machine;
use super::oracle_forgotten::clean;
use super::oracle_there;
use super::process::{Hasty, Process, options};
use super::programs::makes;
use super::story::Use;
use super::world::World;
use crate::done::Status;
use crate::outcome::Outcome;
use crate::own;
use crate::past;
use crate::store::{Store, retention};
use stage::Hash;
use std::sync::atomic::Ordering;

/// What a run makes.
#[derive(Clone, Copy)]
pub(super) enum Of {
    /// What the pipeline of a number makes.
    Number(usize),
    /// What a program makes.
    Program(usize),
}

/// What a run makes, of which machine's capture.
#[derive(Clone, Copy)]
pub(super) struct Made {
    pub(super) machine: usize,
    pub(super) capture: usize,
    pub(super) of: Of,
}

/// A run's results are those of its pipeline, unless somebody is believed who is not to be.
pub(super) fn right(world: &World, m: usize, made: Made, outcome: &Outcome) {
    let machine = &world.machines[m];
    let files = world.machines[made.machine].files(made.capture);
    if outcome.inputs != [stage::content(&files)] {
        // Edited meanwhile.
        return;
    }
    let own = (made.machine == m).then_some(made.capture);
    if let Some(capture) = own.filter(|_| !machine.known.borrow().harmed) {
        let content = stage::content(&files).to_hex().to_string();
        let noted = &mut machine.known.borrow_mut().noted;
        noted.entry(capture).or_default().insert(content);
    }
    if !(machine.believed_all.get() && world.forged.get() > 0) {
        let made = match made.of {
            Of::Number(n) => application().expected(n, &files),
            Of::Program(number) => makes(number, &files),
        };
        for (i, done) in outcome.nodes.iter().enumerate() {
            let content = done.as_ref().and_then(|done| done.content);
            if content.is_some_and(|content| content != blake3::hash(&made[i])) {
                world.broken(&format!("machine {m} has a wrong result of node {i}"));
            }
        }
    }
    let alone = machine.active.get() == 1;
    for done in outcome.nodes.iter().flatten() {
        if let (Status::Executed, Some(key), Some(content)) = (&done.status, done.key, done.content)
        {
            let pair = (key.to_hex().to_string(), content.to_hex().to_string());
            let durable = &mut machine.known.borrow_mut().durable;
            // What was swept meanwhile and made again at once is not worth a sync any more.
            match done.seconds >= 3.0 {
                true if alone => _ = durable.insert(pair),
                true => {}
                false => _ = durable.remove(&pair),
            }
        }
    }
    let contents = outcome
        .nodes
        .iter()
        .flatten()
        .filter_map(|done| done.content);
    if let Some(id) = past::ids(&machine.root).into_iter().next() {
        let contents = contents.collect();
        machine
            .known
            .borrow_mut()
            .runs
            .entry(id)
            .or_insert(contents);
    }
}

/// What a loss of power may not take: what took long, was made here, and is there.
pub(super) fn safe(machine: &Machine) -> Vec<(String, String)> {
    let durable = machine.known.borrow().durable.clone();
    durable
        .into_iter()
        .filter(|one| both(machine, one))
        .collect()
}

fn both(machine: &Machine, (key, content): &(String, String)) -> bool {
    let hash = |hex: &str| Hash::from_hex(hex).expect("a hash");
    let record = own::place(&machine.root, "ac", hash(key));
    record.is_file() && is_there(machine, hash(content))
}

/// It is there after one.
pub(super) fn outlived(world: &World, machine: &Machine, safe: &[(String, String)]) {
    if !safe.iter().all(|one| both(machine, one)) {
        world.broken("a loss of power took what was to be safe");
    }
}

/// The results of pinned runs that are there and whole.
pub(super) fn kept(machine: &Machine, store: &Store) -> Vec<Hash> {
    let known = machine.known.borrow();
    let pinned = store
        .pins()
        .unwrap_or_default()
        .into_iter()
        .filter_map(|(_, run)| {
            let reported = past::nodes(store.root(), &run)?
                .filter_map(|node| node.content)
                .count();
            let contents = known.runs.get(&run)?;
            (reported == contents.len()).then(|| contents.clone())
        });
    let there = |content: &Hash| is_there(machine, *content);
    pinned.flatten().filter(there).collect()
}

fn is_there(machine: &Machine, content: Hash) -> bool {
    let bytes = std::fs::read(own::place(&machine.root, "cas", content));
    bytes.is_ok_and(|bytes| blake3::hash(&bytes) == content)
}

/// Nothing pinned went, and nothing at all while a run was using the store. Before, what was kept was whole, and so much had
/// happened to the files.
pub(super) fn swept(
    world: &World,
    machine: &Machine,
    (before, losses): &(Vec<Hash>, u32),
    in_use: bool,
    done: bool,
) {
    machine.known.borrow_mut().durable.clear();
    let alone = machine.active.get() == 1 && machine.known.borrow().losses == *losses;
    if in_use && done {
        world.broken("gc swept while a run was using the store");
    }
    if alone && !before.iter().all(|content| is_there(machine, *content)) {
        world.broken("gc removed what a pin keeps");
    }
}

/// Once all mishaps are over each machine's next run succeeds, and is right; stores are sound.
pub(super) fn end(world: &World) {
    world.server.false_answers.store(0, Ordering::Relaxed);
    oracle_there::still_gone(world);
    for (m, machine) in world.machines.iter().enumerate() {
        let forgotten = machine.known.borrow().forgotten.clone();
        forgotten
            .iter()
            .for_each(|capture| clean(world, m, *capture));
        machine.full.set(false);
        machine.cut.set(false);
        world.new_key(m, None);
    }
    let (capture, n) = world.wanted.get();
    // One that nobody did anything on is as good as any other, and asks what became of the shared store.
    let harmed = world.server.harmed.load(Ordering::Relaxed);
    let mut asks = harmed || world.forged.get() > 0;
    let mut counts = |m: &usize| {
        let machine = &world.machines[*m];
        let idle = !machine.acted.get() && machine.uses.get() != Use::Alone;
        machine.acted.get() || (idle && std::mem::take(&mut asks))
    };
    let newcomer = world.own..world.machines.len();
    let all: Vec<usize> = (0..world.own).filter(|m| counts(m)).collect();
    for m in &all {
        last(world, *m, capture, n);
    }
    // What these machines have is there now, and a newcomer takes it.
    for m in all.iter().filter(|_| world.forged.get() > 0) {
        let process = Process::sound(*m);
        world.as_process(&process, || {
            if let Ok(Some(to)) = world.to_upload(&process) {
                world.upload(*m, to);
            }
        });
    }
    newcomer.for_each(|m| last(world, m, capture, n));
    // Each in its turn: one a story is enough to find what is not sound.
    let acted = world.machines.iter().enumerate();
    let acted: Vec<usize> = acted
        .filter(|(_, m)| m.acted.get())
        .map(|(m, _)| m)
        .collect();
    if !acted.is_empty() {
        sound(world, acted[world.turn % acted.len()]);
    }
}

/// A machine's store is as it should be.
fn sound(world: &World, m: usize) {
    let (machine, process) = (&world.machines[m], Process::sound(m));
    let store = match world.store(&process) {
        Ok(store) => store,
        Err(why) => return world.broken(&format!("machine {m} has no store: {why}")),
    };
    if machine.known.borrow().harmed {
        retention::verify(&store).unwrap();
    }
    let bad = retention::verify(&store).unwrap();
    let strange = own::stranger(&machine.root).unwrap();
    if bad > 0 || strange.is_some() {
        world.broken(&format!("machine {m} is not sound: {bad} bad, {strange:?}"));
    }
}

fn last(world: &World, m: usize, capture: usize, n: usize) {
    let (process, application) = (Process::sound(m), application());
    let machine = &world.machines[m];
    let graph = application.graph(n);
    let folders = world.folders(m, capture);
    let (go, options) = (false.into(), options(&machine.root));
    let wanted = crate::walk::all(graph, &graph.goal);
    let ran = world.as_process(&process, || {
        let store = world.store(&process)?;
        let ran = crate::session::run_in(
            store,
            graph,
            &folders,
            &wanted,
            &options,
            &Hasty::default(),
            &go,
        );
        ran.map_err(|why| why.to_string())
    });
    let outcome = match ran {
        Ok(outcome) => outcome,
        Err(why) => return world.broken(&format!("machine {m}: the last run: {why}")),
    };
    let made = Made {
        machine: m,
        capture,
        of: Of::Number(n),
    };
    right(world, m, made, &outcome);
    for (i, done) in outcome.nodes.iter().enumerate() {
        let Some(done) = done else { continue };
        // That it is whole is asked of all that there is.
        let there = |content: &Hash| own::place(&machine.root, "cas", *content).is_file();
        let content = done.content.filter(there);
        if content.is_none() || matches!(done.status, Status::Failed(_)) {
            let why = &done.status;
            world.broken(&format!(
                "machine {m}: node {i} has no result at the end: {why:?}"
            ));
        }
    }
}
