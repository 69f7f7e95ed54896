//! What goes when the store is swept, and what stays.

use crate::bucket::{Bucket, Faults};
use crate::place::{ALL, Log, NONE, Place, chain};
use crate::shared::{begun, caches};
use engine::store::{Store, StoreError, retention};
use std::time::{Duration, Instant};

fn budget(most: u64, keep_runs: usize) -> retention::Budget {
    retention::Budget {
        most,
        keep_runs,
        keep_records: 200,
    }
}

fn sweep(place: &Place, budget: &retention::Budget, dry_run: bool) -> retention::Swept {
    retention::gc(&place.store(), budget, dry_run).unwrap()
}

#[test]
fn gc_removes_what_is_cheap_for_its_size_and_a_rerun_makes_nothing_of_it() {
    let place = Place::new("hello\n");
    let chained = chain(1);
    place.outcome(&chained, &place.cache(), 1, &Log::default());
    let store = place.store();
    let last_kept = sweep(&place, &budget(0, 1), true).results;
    assert_eq!(last_kept.len(), 0, "the last run is kept");
    assert_eq!(sweep(&place, &budget(0, 0), true).results.len(), 4);
    assert_eq!(
        retention::list(&store).unwrap().len(),
        4,
        "a dry run removes nothing"
    );
    let blob = std::fs::read(place.blob(1, "mid")).unwrap().len() as u64;
    let gone = sweep(&place, &budget(3 * blob, 0), false).results;
    assert!((1..4).contains(&gone.len()));
    let worth = |k: &retention::Kept| k.seconds / k.bytes as f64;
    let left = retention::list(&store).unwrap();
    assert!(
        gone.iter()
            .all(|g| left.iter().all(|l| worth(g) <= worth(l)))
    );
    let goal = |name: &str| chained.goal.iter().any(|i| chained.nodes[*i].name == name);
    assert!(
        place
            .run(1)
            .iter()
            .all(|name| goal(name) || name == "mid" || name == "clean")
    );
    assert_eq!(retention::verify(&store).unwrap(), 0);
}

#[test]
fn what_is_pinned_stays_until_it_is_let_go() {
    let place = Place::new("hello\n");
    place.run(1);
    let (first, _) = engine::runs(&place.cache()).next().unwrap();
    place.store().pin("first", &first).unwrap();
    place.run(2);
    place.run(3);
    let gone = sweep(&place, &budget(0, 0), false).results;
    assert_eq!(gone.len(), 4, "mid and final of 2 and 3: {gone:?}");
    assert_eq!(place.run(1), NONE);
    assert!(place.store().unpin("first"));
    assert_eq!(sweep(&place, &budget(0, 0), false).results.len(), 4);
    assert_eq!(place.run(1), ALL);
}

#[test]
fn records_of_old_runs_go_but_not_those_of_pins_nor_those_that_other_runs_refer_to() {
    let place = Place::new("hello\n");
    for n in 1..=5 {
        place.run(n);
    }
    // Found all: their records refer to the one of the fifth.
    place.run(5);
    place.run(5);
    let ids: Vec<String> = engine::runs(&place.cache()).map(|r| r.0).collect();
    assert_eq!(ids.len(), 7);
    place.store().pin("second", &ids[5]).unwrap();
    let few = retention::Budget {
        keep_records: 1,
        ..budget(u64::MAX, 1)
    };
    assert_eq!(sweep(&place, &few, true).records, 4);
    assert_eq!(
        engine::runs(&place.cache()).count(),
        7,
        "a dry run removes nothing"
    );
    assert_eq!(sweep(&place, &few, false).records, 4);
    let left: Vec<String> = engine::runs(&place.cache()).map(|r| r.0).collect();
    assert_eq!(left, [&ids[0], &ids[2], &ids[5]].map(String::clone));
    let logs = std::fs::read_dir(place.cache().join("runs")).unwrap();
    assert_eq!(
        logs.count(),
        5,
        "three records, and logs of the two that made something"
    );
    assert_eq!(place.run(5), NONE);
}

#[test]
fn nothing_is_swept_while_a_run_uses_the_store() {
    let place = Place::new("hello\n");
    let graph = chain(1);
    let outcome = place.outcome(&graph, &place.cache(), 1, &Log::default());
    let busy = retention::gc(&place.store(), &budget(0, 0), false);
    assert!(matches!(busy, Err(StoreError::Busy(_))));
    assert_eq!(
        sweep(&place, &budget(0, 0), true).results.len(),
        4,
        "but asked"
    );
    assert!(
        graph
            .goal
            .iter()
            .all(|i| outcome.artifact(&graph, *i).is_some())
    );
    drop(outcome);
    assert_eq!(sweep(&place, &budget(0, 0), false).results.len(), 4);
}

#[test]
fn a_sweep_waits_for_uploads_of_its_own_process() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a] = caches(&place);
    bucket.fail(Faults {
        takes: Duration::from_millis(50),
        ..Faults::default()
    });
    let (sharing, _) = begun(&a, &bucket, false);
    place.run_in(&chain(1), &a, 2);
    for _ in 0..3 {
        retention::gc(&Store::open(&a).unwrap(), &budget(u64::MAX, 1), false)
            .expect("nobody else uses it");
        std::thread::sleep(Duration::from_millis(20));
    }
    let left = sharing.finish(Duration::from_secs(20));
    assert_eq!((left.sent, left.waiting), (4, 0));
}

#[test]
fn a_place_that_was_gone_when_it_was_to_be_met_is_met_before_it_is_swept() {
    let place = Place::new("hello\n");
    let [a] = caches(&place);
    let strange = Bucket::new();
    strange.write("ac/1.jpg", b"beach");
    strange.later(Duration::from_secs(3600));
    strange.fail(Faults {
        gone: true,
        ..Faults::default()
    });
    let (sharing, _) = begun(&a, &strange, false);
    // Whoever writes there is noticed.
    strange.fail(Faults {
        refuses: Some("something was written"),
        ..Faults::default()
    });
    let begun = Instant::now();
    let refused = loop {
        let refused = sharing.sweep(Duration::from_secs(60), false).err();
        let refused = refused.map(|why| why.to_string()).unwrap_or_default();
        // Left alone for a while after it did not answer.
        if !refused.contains("connection refused") || begun.elapsed() > Duration::from_secs(20) {
            break refused;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    assert!(refused.contains("holds no store (ac/1.jpg"), "{refused}");
    assert_eq!(strange.names(""), ["ac/1.jpg"]);
}
