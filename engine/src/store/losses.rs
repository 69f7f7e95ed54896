//! The protocol of publishing, tried on a disk that fails at each of its steps and one that loses
//! power after each. `ENGINE_LOSSES=1000` takes so many sequences of steps, `ENGINE_LOSSES_SEED` other ones.

use super::index::Index;
use super::simulated::{Simulated, User, after_loss, in_memory, laid};
use super::{Record, Store, StoreError, retention};
use crate::own;
use proof::Dice;
use stage::Hash;
use std::io::{Error, ErrorKind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// The step of this number fails.
#[derive(Default)]
struct Fails {
    at: Option<usize>,
    tried: AtomicUsize,
}

impl User for Arc<Fails> {
    fn step(&self, _: bool) -> std::io::Result<()> {
        let fails = self.ends_next();
        self.tried.fetch_add(1, Ordering::Relaxed);
        match fails {
            true => Err(Error::from(ErrorKind::StorageFull)),
            false => Ok(()),
        }
    }
    fn ends_next(&self) -> bool {
        self.at == Some(self.tried.load(Ordering::Relaxed))
    }
}

type Disk = Simulated<Arc<Fails>>;

/// A result that is to be kept.
struct Result {
    key: Hash,
    record: Record,
    bytes: Vec<u8>,
}

/// Some results, of which some took long enough to be worth a sync, and some are equal.
fn results(dice: &mut Dice) -> Vec<Result> {
    let result = |n: u64| {
        let alike = dice.bits() % 3;
        let bytes: Vec<u8> = (0..dice.bits() % 4 * 50)
            .map(|i| (i + alike) as u8)
            .collect();
        let provenance = vec![("stage".to_owned(), format!("toy v{n}"))];
        let record = Record {
            content: blake3::hash(&bytes),
            bytes: bytes.len() as u64,
            seconds: if dice.unit() < 0.5 { 0.1 } else { 5.0 },
            metrics: vec![],
            warnings: vec![],
            provenance,
        };
        let key = crate::key::of(&record.provenance);
        Result { key, record, bytes }
    };
    (0..5).map(result).collect()
}

fn publish(store: &Store, result: &Result) -> std::result::Result<(), StoreError> {
    store.keep(&result.bytes, result.record.seconds)?;
    store.create_record(result.key, &result.record).map(|_| ())
}

/// A part, a result, a record of a run and the index, again and again; how many steps were done when
/// each result was safe, if it was to be.
fn work(store: &Store, disk: &Disk, results: &[Result]) -> Vec<Option<usize>> {
    let one = |result: &Result| {
        let _ = store.remember(result.key, b"half of it");
        let done = publish(store, result).is_ok();
        let safe = done && result.record.seconds > 3.0;
        let steps = disk.steps.lock().unwrap().len();
        let _ = store.write("runs/00000000000000000001-1.json", b"{}\n");
        let index = store.index().bytes(i64::MAX);
        let _ = store.write("index", &index);
        safe.then_some(steps)
    };
    results.iter().map(one).collect()
}

/// Holds a store to what it promises: what it gives is right, what is missing can be made again, and
/// then it is whole.
fn hold(store: &Store, results: &[Result], round: &str) {
    for r in results {
        if let Some(found) = store.found(r.key) {
            assert_eq!(found.record.content, r.record.content, "{round}");
        }
        let blob = store.blob(r.record.content);
        assert!(blob.is_none_or(|blob| *blob == r.bytes), "{round}");
        let part = store.recall(r.key);
        assert!(part.is_none_or(|part| part == b"half of it"), "{round}");
        publish(store, r).unwrap();
    }
    for r in results {
        assert_eq!(store.record(r.key).as_ref(), Some(&r.record), "{round}");
        assert_eq!(*store.blob(r.record.content).unwrap(), r.bytes, "{round}");
    }
    retention::verify(store).unwrap();
    assert_eq!(retention::verify(store).unwrap(), 0, "{round}");
    assert_eq!(own::stranger(store.root()).unwrap(), None, "{round}");
}

/// A store whose disk is simulated.
fn simulated(root: &Path, disk: &Disk) -> std::result::Result<Store, StoreError> {
    Store::with(root, Box::new(disk.clone()), OnceLock::new())
}

fn rounds(usual: u64) -> std::ops::Range<u64> {
    let number = |name: &str, usual| std::env::var(name).map_or(usual, |n| n.parse().unwrap());
    let seed = number("ENGINE_LOSSES_SEED", 1) << 32;
    seed..seed + number("ENGINE_LOSSES", usual)
}

#[test]
fn power_may_go_after_any_step_and_what_was_to_be_safe_is() {
    let mut losses = 0;
    for seed in rounds(4) {
        let mut dice = Dice(seed);
        let (place, disk) = (in_memory(), Disk::default());
        let results = results(&mut dice);
        let safe = work(&simulated(place.path(), &disk).unwrap(), &disk, &results);
        let steps = disk.steps.lock().unwrap().clone();
        for end in 0..=steps.len() {
            let round = format!("seed {seed}, {end} of {} steps", steps.len());
            let after = in_memory();
            let left = after_loss(&steps[..end], place.path(), &mut dice);
            laid(&left, place.path(), after.path());
            let store = simulated(after.path(), &Disk::default());
            let store = store.unwrap_or_else(|e| panic!("{round}: {e}"));
            store.index().trust(after.path());
            for (r, _) in results
                .iter()
                .zip(&safe)
                .filter(|(_, at)| at.is_some_and(|at| at <= end))
            {
                assert_eq!(
                    store.record(r.key).as_ref(),
                    Some(&r.record),
                    "{round}: lost"
                );
                assert!(store.blob(r.record.content).is_some(), "{round}: lost");
            }
            hold(&store, &results, &round);
            losses += 1;
        }
    }
    assert!(losses > 200, "only {losses} losses");
}

#[test]
fn any_step_may_fail_and_the_store_is_sound() {
    for seed in rounds(1) {
        let results = results(&mut Dice(seed));
        for fails in 0.. {
            let place = in_memory();
            let (at, tried) = (Some(fails), AtomicUsize::new(0));
            let disk = Disk {
                user: Arc::new(Fails { at, tried }),
                ..Disk::default()
            };
            if let Ok(store) = simulated(place.path(), &disk) {
                work(&store, &disk, &results);
            }
            if disk.user.tried.load(Ordering::Relaxed) <= fails {
                break;
            }
            let round = format!("seed {seed}, step {fails} fails");
            let store = simulated(place.path(), &Disk::default()).unwrap();
            assert!(Index::load(&place.path().join("index")).entries.len() <= results.len());
            hold(&store, &results, &round);
            let left = own::files(store.root(), "tmp", |_| true).unwrap();
            assert_eq!(left, Vec::<String>::new(), "{round}");
        }
    }
}
