//! What must hold of a machine's own store once a capture is forgotten, and where forgetting was cut off.

use super::captures::{has, needles};
use super::machine::Machine;
use super::oracle_there::There;
use super::world::World;
use crate::own;
use crate::store::{Forgotten, StoreError, below};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// What there is before a capture is forgotten.
pub(super) struct Before {
    /// Whether a run is using the store.
    in_use: bool,
    /// Whether it is linked to the shared store, and may remove there.
    shares: bool,
    /// How many answers of the shared store were not true until then.
    lied: u64,
    /// What is in the shared store.
    there: There,
    /// Notes that name the folder.
    notes: BTreeSet<String>,
    /// A file of the store that names the folder, and is not being written.
    named: Option<PathBuf>,
}

/// The notes of a machine that name the folder of a capture.
fn notes(world: &World, m: usize, capture: usize) -> BTreeSet<String> {
    let (root, [_, folder]) = (&world.machines[m].root, needles(m, capture));
    let names = own::files(root, "captures", own::is_hash).unwrap_or_default();
    let names = names.into_iter();
    let note = |name: &String| std::fs::read(root.join("captures").join(name));
    names
        .filter(|name| note(name).is_ok_and(|note| has(&note, &folder)))
        .collect()
}

impl Before {
    /// Of a capture of a machine.
    pub(super) fn of(world: &World, m: usize, capture: usize, shares: bool) -> Before {
        let machine = &world.machines[m];
        let [_, folder] = needles(m, capture);
        let names = |path: &PathBuf| {
            let written = ["tmp", "exec"].map(|folder| path.starts_with(machine.root.join(folder)));
            !written.contains(&true) && std::fs::read(path).is_ok_and(|file| has(&file, &folder))
        };
        let notes = notes(world, m, capture);
        if !machine.known.borrow().harmed {
            let noted = &mut machine.known.borrow_mut().noted;
            noted.entry(capture).or_default().extend(notes.clone());
        }
        Before {
            in_use: machine.working.get() > 0,
            shares,
            lied: world.server.lied.load(Ordering::Relaxed),
            there: There::of(world, m, capture),
            notes,
            named: below(&machine.root).into_iter().find(names),
        }
    }

    /// Whether it is true of the shared store, and nobody else puts anything there just now.
    fn counts_there(&self, world: &World, machine: &Machine) -> bool {
        let all: usize = world.machines.iter().map(|m| m.active.get()).sum();
        let alone = all == machine.active.get();
        let untrue = world.server.lied.load(Ordering::Relaxed) > self.lied;
        self.shares && alone && !untrue
    }
}

/// After success no byte of the capture is left, here and in the shared store.
pub(super) fn forgotten(
    world: &World,
    m: usize,
    capture: usize,
    before: &Before,
    came: &Result<Forgotten, StoreError>,
) {
    let machine = &world.machines[m];
    let Ok(forgotten) = came else { return };
    if before.in_use {
        world.broken("forgotten while a run was using the store");
    }
    machine.known.borrow_mut().durable.clear();
    let calm = !machine.known.borrow().harmed && machine.active.get() == 1;
    if !forgotten.known && calm {
        // Nothing came of it: then nothing of it is there, nor was.
        clean(world, m, capture);
        if let Some(path) = &before.named {
            world.broken(&format!(
                "{} was there, and nothing came of it",
                path.display()
            ));
        }
    }
    if !forgotten.known || !forgotten.unread.is_empty() {
        return;
    }
    if machine.active.get() == 1 {
        clean(world, m, capture);
        machine.known.borrow_mut().gone(capture);
    }
    if before.counts_there(world, machine) {
        before.there.gone(world, m, capture);
    }
}

/// Forgetting that was killed: what is left still leads to the rest.
pub(super) fn cut_off(world: &World, m: usize, capture: usize, before: &Before) {
    let machine = &world.machines[m];
    let elsewhere = machine.known.borrow().elsewhere.contains(&capture);
    if machine.known.borrow().harmed || machine.active.get() > 1 || elsewhere {
        return;
    }
    let now = notes(world, m, capture);
    let mut gone = before.notes.difference(&now).peekable();
    if gone.peek().is_none() {
        return;
    }
    // A note went: so all that it leads to had gone.
    let [photos, _] = needles(m, capture);
    for path in below(&machine.root) {
        if has(&std::fs::read(&path).unwrap_or_default(), &photos) {
            let path = path.display();
            world.broken(&format!("a note went before what it leads to: {path}"));
        }
    }
    if before.counts_there(world, machine)
        && let Some(name) = before.there.left(world, m).first()
    {
        world.broken(&format!("a note went before what it leads to: {name}"));
    }
    let noted = &mut machine.known.borrow_mut().noted;
    let noted = noted.entry(capture).or_default();
    gone.for_each(|note| _ = noted.remove(note));
}

/// Nothing of a capture is on a machine's disk.
pub(super) fn clean(world: &World, m: usize, capture: usize) {
    let machine = &world.machines[m];
    let elsewhere = machine.known.borrow().elsewhere.contains(&capture);
    let [photos, folder] = needles(m, capture);
    for path in below(&machine.root) {
        let bytes = std::fs::read(&path).unwrap_or_default();
        let photos = Some(&photos).filter(|_| !elsewhere);
        let words = photos.into_iter().chain([&folder]);
        for needle in words.filter(|needle| has(&bytes, needle)) {
            let path = path.display();
            world.broken(&format!("forgotten, and {needle} is left in {path}"));
        }
    }
}
