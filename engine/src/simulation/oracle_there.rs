//! What must hold of the store that machines share, once a capture is forgotten.

use super::captures::{files, has, needles};
use super::world::World;
use crate::store::remote::readable;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::Ordering;

/// What of a capture lies in the shared store before it is forgotten, as far as its own records tell.
pub(super) struct There {
    /// Its objects.
    mine: BTreeSet<String>,
    /// Objects that cannot be read.
    broken: BTreeSet<String>,
}

impl There {
    /// Of a capture that a machine noted.
    pub(super) fn of(world: &World, m: usize, capture: usize) -> There {
        let machine = &world.machines[m];
        let content = stage::content(&files(&machine.captures[capture])).to_hex();
        let note = std::fs::read(machine.root.join("captures").join(content.as_str()));
        let noted = note.is_ok_and(|note| has(&note, &needles(capture)[1]));
        let objects = world.server.objects.lock().expect("one thread");
        let (mut records, mut broken) = (BTreeMap::new(), BTreeSet::new());
        for (name, (bytes, _)) in objects.iter().filter(|(name, _)| name.starts_with("ac/")) {
            let key = name
                .rsplit('/')
                .next()
                .and_then(|hex| Hash::from_hex(hex).ok());
            match key.and_then(|key| readable(bytes, key)) {
                Some(record) => _ = records.insert(name.clone(), record),
                None => _ = broken.insert(name.clone()),
            }
        }
        let mut contents = BTreeSet::from([content.to_string()]);
        let mut mine = BTreeSet::new();
        let mut before = usize::MAX;
        while noted && mine.len() != before {
            before = mine.len();
            for (name, record) in &records {
                let of_it = |(what, value): &(String, String)| {
                    what.starts_with("from ") && contents.contains(value)
                };
                if record.provenance.iter().any(of_it) && mine.insert(name.clone()) {
                    contents.insert(record.content.to_hex().to_string());
                }
            }
        }
        let (own, others): (Vec<_>, Vec<_>) =
            records.iter().partition(|(name, _)| mine.contains(*name));
        let blob = |record: &crate::store::Record| crate::own::name("cas", record.content);
        let stay: BTreeSet<String> = others.iter().map(|(_, record)| blob(record)).collect();
        let blobs = own.iter().map(|(_, record)| blob(record));
        let blobs: Vec<String> = blobs.filter(|blob| !stay.contains(blob)).collect();
        mine.extend(blobs);
        There { mine, broken }
    }

    /// It is gone now; what could not be read is gone or was said.
    pub(super) fn gone(&self, world: &World, m: usize, capture: usize) {
        let objects = world.server.objects.lock().expect("one thread").clone();
        for name in self.mine.iter().filter(|name| objects.contains_key(*name)) {
            world.broken(&format!("forgotten, and left in the shared store: {name}"));
        }
        for name in self
            .broken
            .iter()
            .filter(|name| objects.contains_key(*name))
        {
            if needles(capture)
                .iter()
                .any(|needle| has(&objects[name].0, needle))
            {
                world.broken(&format!("forgotten, broken, left, and not said: {name}"));
            }
        }
        let folder = world.machines[m].captures[capture].display().to_string();
        for (name, (bytes, _)) in objects
            .iter()
            .filter(|(name, _)| name.starts_with("plans/"))
        {
            if has(bytes, &folder) {
                world.broken(&format!("forgotten, and a plan is left: {name}"));
            }
        }
        let mine = self.mine.iter().map(|name| (name.clone(), m));
        world.forgotten_there.borrow_mut().extend(mine);
    }
}

/// What was forgotten has not come back by itself.
pub(super) fn still_gone(world: &World) {
    let objects = world.server.objects.lock().expect("one thread").clone();
    for (name, m) in world.forgotten_there.take() {
        if objects.contains_key(&name) {
            world.broken(&format!("machine {m} forgot {name}, and it is there again"));
        }
    }
}

/// Somebody makes or puts there what may be of any capture.
pub(super) fn used(world: &World) {
    world.forgotten_there.borrow_mut().clear();
}

/// A machine uploads what it has: its own was forgotten.
pub(super) fn uploaded(world: &World, m: usize) {
    let lied = world.server.lies.load(Ordering::Relaxed) > 0;
    let mut all = world.forgotten_there.borrow_mut();
    all.retain(|_, of| *of == m && !lied);
}
