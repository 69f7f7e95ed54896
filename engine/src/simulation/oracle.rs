//! What must hold, whatever happens.

use super::captures::{files, has, needles};
use super::oracle_there::{self, There};
use super::process::{Hasty, Process, options};
use super::programs::makes;
use super::story::Use;
use super::trade::trade;
use super::world::{Machine, World};
use crate::done::Status;
use crate::outcome::Outcome;
use crate::own;
use crate::past;
use crate::store::{Forgotten, Store, StoreError, below, keeper};
use stage::Hash;
use std::path::Path;
use std::sync::atomic::Ordering;

/// What a run makes.
#[derive(Clone, Copy)]
pub(super) enum Of {
    /// What the pipeline of a number makes.
    Number(usize),
    /// What a program makes.
    Program(usize),
}

/// What a run makes, of which folder.
#[derive(Clone, Copy)]
pub(super) struct Made<'a> {
    pub(super) folder: &'a Path,
    pub(super) of: Of,
}

/// A run's results are those of its pipeline, unless somebody is believed who is not to be.
pub(super) fn right(world: &World, m: usize, made: Made<'_>, outcome: &Outcome) {
    let machine = &world.machines[m];
    let files = files(made.folder);
    if outcome.inputs != [stage::content(&files)] {
        // Edited meanwhile.
        return;
    }
    let own = machine.captures.iter().position(|own| own == made.folder);
    if let Some(capture) = own.filter(|_| !machine.known.borrow().harmed) {
        let content = stage::content(&files).to_hex().to_string();
        let noted = &mut machine.known.borrow_mut().noted;
        noted.entry(capture).or_default().insert(content);
    }
    if !(machine.believed_all.get() && world.forged.get() > 0) {
        let made = match made.of {
            Of::Number(n) => trade().expected(n, &files),
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
    for done in outcome.nodes.iter().flatten().filter(|_| alone) {
        if let (Status::Executed, Some(key), Some(content)) = (&done.status, done.key, done.content)
            && done.seconds >= 3.0
        {
            let pair = (key.to_hex().to_string(), content.to_hex().to_string());
            machine.known.borrow_mut().durable.insert(pair);
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
    let pinned = store.pins().into_iter().filter_map(|(_, run)| {
        let told = past::nodes(store.root(), &run)?
            .filter_map(|node| node.content)
            .count();
        let contents = known.runs.get(&run)?;
        (told == contents.len()).then(|| contents.clone())
    });
    let there = |content: &Hash| is_there(machine, *content);
    pinned.flatten().filter(there).collect()
}

fn is_there(machine: &Machine, content: Hash) -> bool {
    let bytes = std::fs::read(own::place(&machine.root, "cas", content));
    bytes.is_ok_and(|bytes| blake3::hash(&bytes) == content)
}

/// Nothing pinned went, and nothing at all while a run was using the store.
pub(super) fn swept(world: &World, machine: &Machine, before: &[Hash], in_use: bool, done: bool) {
    machine.known.borrow_mut().durable.clear();
    if in_use && done {
        world.broken("gc swept while a run was using the store");
    }
    if machine.active.get() == 1 && !before.iter().all(|content| is_there(machine, *content)) {
        world.broken("gc removed what a pin keeps");
    }
}

/// After success no byte of the capture is left, here and in the shared store.
pub(super) fn forgotten(
    world: &World,
    m: usize,
    capture: usize,
    (in_use, lied, there): (bool, bool, &There),
    came: &Result<Forgotten, StoreError>,
) {
    let machine = &world.machines[m];
    let Ok(forgotten) = came else { return };
    if in_use {
        world.broken("forgotten while a run was using the store");
    }
    machine.known.borrow_mut().durable.clear();
    let calm = !machine.known.borrow().harmed && machine.active.get() == 1;
    if !forgotten.known && calm {
        // Nothing came of it: then nothing of it is there.
        clean(world, m, capture);
    }
    if !forgotten.known || !forgotten.unread.is_empty() {
        return;
    }
    if machine.active.get() == 1 {
        clean(world, m, capture);
        machine.known.borrow_mut().gone(capture);
    }
    let all: usize = world.machines.iter().map(|m| m.active.get()).sum();
    let others = all == machine.active.get();
    let shared = matches!(machine.uses.get(), Use::Open | Use::Strict);
    if shared && others && !lied {
        there.gone(world, m, capture);
    }
}

/// Nothing of a capture is on a machine's disk.
fn clean(world: &World, m: usize, capture: usize) {
    for path in below(&world.machines[m].root) {
        let bytes = std::fs::read(&path).unwrap_or_default();
        for needle in needles(m, capture)
            .iter()
            .filter(|needle| has(&bytes, needle))
        {
            let path = path.display();
            world.broken(&format!("forgotten, and {needle} is left in {path}"));
        }
    }
}

/// Once all mishaps are over each machine's next run succeeds, and is right; stores are sound.
pub(super) fn end(world: &World) {
    world.server.lies.store(0, Ordering::Relaxed);
    oracle_there::still_gone(world);
    for (m, machine) in world.machines.iter().enumerate() {
        let forgotten = machine.known.borrow().forgotten.clone();
        forgotten
            .iter()
            .for_each(|capture| clean(world, m, *capture));
        machine.full.set(false);
        machine.cut.set(false);
    }
    for (m, machine) in world.machines.iter().enumerate() {
        let process = Process::sound(m);
        let (capture, n) = world.wanted.get();
        last(world, m, capture, n);
        let store = match world.store(&process) {
            Ok(store) => store,
            Err(why) => return world.broken(&format!("machine {m} has no store: {why}")),
        };
        if machine.known.borrow().harmed {
            keeper::verify(&store);
        }
        let bad = keeper::verify(&store);
        let strange = own::stranger(&machine.root);
        if bad > 0 || strange.is_some() {
            world.broken(&format!("machine {m} is not sound: {bad} bad, {strange:?}"));
        }
    }
}

fn last(world: &World, m: usize, capture: usize, n: usize) {
    let (process, trade) = (Process::sound(m), trade());
    let machine = &world.machines[m];
    let store = match world.store(&process) {
        Ok(store) => store,
        Err(why) => return world.broken(&format!("machine {m} has no store: {why}")),
    };
    let graph = trade.graph(n);
    let folders = world.folders(m, capture);
    let (go, options) = (false.into(), options(&machine.root));
    let wanted = crate::walk::all(graph, &graph.goal);
    let ran = crate::session::run_in(
        store,
        graph,
        &folders,
        &wanted,
        &options,
        &Hasty::default(),
        &go,
    );
    let outcome = match ran {
        Ok(outcome) => outcome,
        Err(why) => return world.broken(&format!("machine {m}: the last run: {why}")),
    };
    let of = Of::Number(n);
    let folder = &machine.captures[capture];
    right(world, m, Made { folder, of }, &outcome);
    for (i, done) in outcome.nodes.iter().enumerate() {
        let Some(done) = done else { continue };
        let content = done.content.filter(|content| is_there(machine, *content));
        if content.is_none() || matches!(done.status, Status::Failed(_)) {
            let why = &done.status;
            world.broken(&format!(
                "machine {m}: node {i} has no result at the end: {why:?}"
            ));
        }
    }
}
