//! What must hold of the store that machines share, once a capture is forgotten.

use super::application::application;
use super::captures::{has, needles};
use super::gone::Gone;
use super::story::NUMBERS;
use super::world::World;
use crate::store::remote::readable;
use stage::Hash;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::Ordering;

/// What of a capture is in the shared store before it is forgotten, as far as its own records show.
pub(super) struct There {
    /// Its objects.
    mine: BTreeSet<String>,
    /// Objects that cannot be read.
    broken: BTreeSet<String>,
    /// The contents of the capture and of all that comes of it, hexadecimal.
    contents: BTreeSet<String>,
    put_elsewhere: u32,
}

impl There {
    /// Of a capture that a machine noted.
    pub(super) fn of(world: &World, m: usize, capture: usize) -> There {
        let machine = &world.machines[m];
        let photos = machine.files(capture);
        let content = stage::content(&photos).to_hex();
        let note = std::fs::read(machine.root.join("captures").join(content.as_str()));
        let noted = note.is_ok_and(|note| has(&note, &needles(m, capture)[1]));
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
        let known = machine.known.borrow();
        let mut contents = known.noted.get(&capture).cloned().unwrap_or_default();
        if noted {
            contents.insert(content.to_string());
        }
        let mut mine = BTreeSet::new();
        let mut before = usize::MAX;
        // Where a stranger writes what results were made of, only what was made of the capture itself is surely its own.
        while mine.len() != before && (before == usize::MAX || world.forged.get() == 0) {
            before = mine.len();
            let contents_then = contents.clone();
            for (name, record) in &records {
                let of_it = |(what, value): &(String, String)| {
                    what.starts_with("from ") && contents_then.contains(value)
                };
                if record.provenance.iter().any(of_it) && mine.insert(name.clone()) {
                    contents.insert(record.content.to_hex().to_string());
                }
            }
        }
        let (own, rest): (Vec<_>, Vec<_>) =
            records.iter().partition(|(name, _)| mine.contains(*name));
        let blob = |record: &crate::store::Record| crate::own::name("cas", record.content);
        let stay: BTreeSet<String> = rest.iter().map(|(_, record)| blob(record)).collect();
        let blobs = own.iter().map(|(_, record)| blob(record));
        let blobs: Vec<String> = blobs.filter(|blob| !stay.contains(blob)).collect();
        mine.extend(blobs);
        if noted {
            let made = (0..NUMBERS).map(|n| application().expected(n, &photos));
            let made = made.flat_map(|made| {
                made.iter()
                    .map(|bytes| blake3::hash(bytes))
                    .collect::<Vec<_>>()
            });
            contents.extend(made.map(|content| content.to_hex().to_string()));
        }
        There {
            mine,
            broken,
            contents,
            put_elsewhere: world.put_elsewhere(m),
        }
    }

    /// What of it is left, if nobody else put anything there meanwhile.
    pub(super) fn left(&self, world: &World, m: usize) -> Vec<String> {
        if world.put_elsewhere(m) > self.put_elsewhere {
            return vec![];
        }
        let objects = world.server.objects.lock().expect("one thread");
        let left = self.mine.iter().filter(|name| objects.contains_key(*name));
        left.cloned().collect()
    }

    /// It is gone now; what could not be read is gone or was reported.
    pub(super) fn gone(&self, world: &World, m: usize, capture: usize) {
        if world.put_elsewhere(m) > self.put_elsewhere {
            // Somebody else put something there meanwhile.
            return;
        }
        let objects = world.server.objects.lock().expect("one thread").clone();
        for name in self.left(world, m) {
            world.broken(&format!("forgotten, and left in the shared store: {name}"));
        }
        for name in self
            .broken
            .iter()
            .filter(|name| objects.contains_key(*name))
        {
            if needles(m, capture)
                .iter()
                .any(|needle| has(&objects[name].0, needle))
            {
                world.broken(&format!(
                    "forgotten, broken, left, and not reported: {name}"
                ));
            }
        }
        let folder = world.machines[m].capture(capture).display().to_string();
        for (name, (bytes, _)) in objects
            .iter()
            .filter(|(name, _)| name.starts_with("plans/"))
        {
            if has(bytes, &folder) {
                world.broken(&format!("forgotten, and a plan is left: {name}"));
            }
        }
        if World::is_running() {
            // It goes on afterwards.
            return;
        }
        let gone = Gone {
            machine: m,
            contents: self.contents.clone(),
            left: objects.into_keys().collect(),
        };
        world.forgotten_there.borrow_mut().push(gone);
    }
}

/// What was forgotten has not come back by itself.
pub(super) fn still_gone(world: &World) {
    let all = world.forgotten_there.take();
    if all.is_empty() {
        return;
    }
    let objects = world.server.objects.lock().expect("one thread").clone();
    for gone in all {
        for (name, (bytes, _)) in objects.iter().filter(|(name, _)| name.starts_with("ac/")) {
            let key = name.rsplit('/').next();
            let key = key.and_then(|hex| Hash::from_hex(hex).ok());
            let record = key.and_then(|key| readable(bytes, key));
            let of_it = |(what, value): &(String, String)| {
                what.starts_with("from ") && gone.contents.contains(value)
            };
            let comes = record.is_some_and(|record| record.provenance.iter().any(of_it));
            if comes && !gone.left.contains(name) {
                let m = gone.machine;
                world.broken(&format!("machine {m} forgot {name}, and it is there again"));
            }
        }
    }
}

/// Somebody is about to make or put there what may be of any capture; until now nobody did.
pub(super) fn used(world: &World) {
    still_gone(world);
}

/// A machine uploads what it has: its own was forgotten.
pub(super) fn uploaded(world: &World, m: usize) {
    let lied = world.server.false_answers.load(Ordering::Relaxed) > 0;
    let mut all = world.forgotten_there.borrow_mut();
    all.retain(|gone| gone.machine == m && !lied);
}
