//! A shared store that fails: runs go on without it, nothing wrong is believed, nothing is lost.

use crate::bucket::{Bucket, Faults};
use crate::place::{ALL, NONE, Place, chain, graph};
use crate::shared::{begun, caches, shared, shelf, texts};
use buckets::Objects;
use engine::store::remote::{Manner, Sharing};
use engine::store::{Store, retention};
use std::time::{Duration, Instant};

fn all() -> Vec<String> {
    ALL.map(str::to_owned).to_vec()
}

/// Each record in the bucket is whole: a store that has nothing finds all of it there.
fn whole(place: &Place, bucket: &Bucket, n: i64) {
    let cache = proof::in_memory();
    let cache = cache.path().join("fresh");
    bucket.fail(Faults::default());
    let (made, _, printed) = shared(place, &cache, bucket, n);
    assert_eq!((made, printed), (vec![], vec![]));
    assert_eq!(retention::verify(&Store::open(&cache).unwrap()).unwrap(), 0);
}

#[test]
fn eight_workers_on_one_key_and_a_tenth_of_all_answers_wrong_come_to_the_same() {
    for text in texts() {
        let place = Place::new(&text);
        let bucket = Bucket::new();
        bucket.fail(Faults {
            errors: 0.05,
            lost: 0.05,
            conflicts: 0.05,
            ..Faults::default()
        });
        let caches: [_; 8] = caches(&place);
        std::thread::scope(|scope| {
            for cache in &caches {
                scope.spawn(|| {
                    let (_, left, printed) = shared(&place, cache, &bucket, 1);
                    assert_eq!(left.waiting, 0, "{left:?} {printed:?}");
                    let odd = |line: &&String| {
                        line.contains("not deterministic") || line.contains("believed")
                    };
                    assert_eq!(printed.iter().find(odd), None);
                });
            }
        });
        assert_eq!(bucket.names("ac").len(), 4);
        whole(&place, &bucket, 1);
        let alone = place.path().join("alone");
        place.run_in(&chain(1), &alone, 2);
        let alone = shelf(&alone, "cas");
        for cache in &caches {
            for blob in shelf(cache, "cas") {
                assert!(alone.contains(&blob), "equal to a run alone");
            }
        }
    }
}

#[test]
fn a_bucket_that_is_gone_is_reported_and_what_waits_goes_there_later() {
    let place = Place::new(&texts()[1]);
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    bucket.fail(Faults {
        gone: true,
        ..Faults::default()
    });
    let start = Instant::now();
    let (sharing, printed) = begun(&a, &bucket, false);
    assert_eq!(place.run_in(&chain(1), &a, 2), all());
    let left = sharing.finish(Duration::from_secs(1));
    assert!(
        start.elapsed() < Duration::from_secs(8),
        "{:?}",
        start.elapsed()
    );
    assert_eq!((left.sent, left.waiting), (0, 4));
    assert_eq!(left.why.as_deref(), Some("connection refused"));
    let printed = printed.lock().unwrap().clone();
    assert_eq!(printed.len(), 1, "{printed:?}");
    assert!(printed[0].contains("memory://bucket") && printed[0].contains("going on without it"));
    // Sweeping the store here leaves what waits.
    let budget = retention::Budget {
        most: 0,
        keep_runs: 0,
        keep_records: 0,
    };
    retention::gc(&Store::open(&a).unwrap(), &budget, false).unwrap();
    // Nothing runs: what waits is uploaded all the same.
    bucket.fail(Faults::default());
    let (sharing, _) = begun(&a, &bucket, false);
    let left = sharing.finish(Duration::from_secs(20));
    assert_eq!((left.sent, left.waiting), (4, 0));
    assert_eq!(shared(&place, &b, &bucket, 1).0, NONE);
}

#[test]
fn a_bucket_that_is_gone_for_a_while_is_waited_for_at_the_end() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a] = caches(&place);
    let (sharing, printed) = begun(&a, &bucket, false);
    bucket.fail(Faults {
        gone: true,
        ..Faults::default()
    });
    assert_eq!(place.run_in(&chain(1), &a, 2), all());
    let back = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(1500));
            bucket.fail(Faults::default());
        });
        sharing.finish(Duration::from_secs(20))
    });
    assert_eq!((back.sent, back.waiting, back.why), (4, 0, None));
    let printed = printed.lock().unwrap().clone();
    assert!(
        printed.len() == 2 && printed[1].contains("answers again"),
        "{printed:?}"
    );
    whole(&place, &bucket, 1);
}

#[test]
fn wrong_bytes_are_refused_named_made_again_and_put_right() {
    let place = Place::new(&texts()[1]);
    for shelf in ["ac", "cas"] {
        let bucket = Bucket::new();
        let own = proof::in_memory();
        let [a, b] = ["a", "b"].map(|name| own.path().join(name));
        shared(&place, &a, &bucket, 1);
        let names = bucket.names(shelf);
        let before: Vec<Vec<u8>> = names.iter().map(|name| bucket.bytes(name)).collect();
        for name in &names {
            bucket.change(name, |bytes| {
                let middle = bytes.len() / 2;
                bytes[middle] ^= 1;
            });
        }
        let (made, left, printed) = shared(&place, &b, &bucket, 1);
        assert!(
            !made.is_empty() && left.waiting == 0,
            "{shelf}: {made:?} {left:?}"
        );
        assert!(
            printed
                .iter()
                .any(|line| line.contains("not believed") && line.contains(shelf)),
            "{printed:?}"
        );
        if shelf == "cas" {
            // What nobody read was not noticed; what was is right again.
            let right = names
                .iter()
                .zip(&before)
                .filter(|(n, b)| bucket.bytes(n) == **b);
            assert!(right.count() >= 2, "{printed:?}");
        } else {
            whole(&place, &bucket, 1);
        }
    }
}

#[test]
fn what_is_not_deterministic_is_reported_and_the_first_counts_there() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    let unsteady = graph(
        &["x"],
        "[node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n\
         [node.x]\nstage = \"toy.unsteady\"\nfrom = { text = \"clean\" }\n",
    );
    place.run_in(&unsteady, &b, 1);
    let run = |cache: &std::path::Path| -> Vec<String> {
        let (sharing, printed) = begun(cache, &bucket, false);
        place.run_in(&unsteady, cache, 1);
        sharing.finish(Duration::from_secs(20));
        printed.lock().unwrap().clone()
    };
    assert_eq!(run(&a), NONE);
    let there: Vec<Vec<u8>> = bucket.names("ac").iter().map(|n| bucket.bytes(n)).collect();
    let printed = run(&b);
    assert!(
        printed.len() == 1 && printed[0].contains("not deterministic"),
        "{printed:?}"
    );
    let now: Vec<Vec<u8>> = bucket.names("ac").iter().map(|n| bucket.bytes(n)).collect();
    assert_eq!(there, now);
}

#[test]
fn a_bucket_that_writes_over_is_noticed_and_used_with_care() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    let over = || Faults {
        overwrites: true,
        ..Faults::default()
    };
    bucket.fail(over());
    let (_, left, printed) = shared(&place, &a, &bucket, 1);
    assert_eq!(left.waiting, 0);
    assert!(
        printed.len() == 1 && printed[0].contains("writes over"),
        "{printed:?}"
    );
    let there = bucket
        .names("ac")
        .iter()
        .map(|n| bucket.bytes(n))
        .collect::<Vec<_>>();
    place.run_in(&chain(1), &b, 2);
    shared(&place, &b, &bucket, 1);
    let now = bucket
        .names("ac")
        .iter()
        .map(|n| bucket.bytes(n))
        .collect::<Vec<_>>();
    assert_eq!(there, now, "who comes second looks first");
}

#[test]
fn a_bucket_that_refuses_is_reported_once_and_what_is_made_waits() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a] = caches(&place);
    shared(&place, &a, &bucket, 1);
    bucket.fail(Faults {
        refuses: Some("its quota is full"),
        ..Faults::default()
    });
    let (made, left, printed) = shared(&place, &a, &bucket, 2);
    assert_eq!(made, ["final", "mid"]);
    assert_eq!(
        (left.waiting, left.why.as_deref()),
        (2, Some("its quota is full"))
    );
    assert_eq!(printed.len(), 1, "{printed:?}");
    bucket.fail(Faults::default());
    assert_eq!(shared(&place, &a, &bucket, 2).1.sent, 2);
}

#[test]
fn somebody_else_s_bucket_and_another_layout_are_refused() {
    let place = Place::new("hello\n");
    let [a] = caches(&place);
    let begin = |bucket: &Bucket| {
        let objects: Box<dyn Objects> = Box::new(bucket.clone());
        let begun = Sharing::begin(&a, objects, Manner::default(), Box::new(|_| {}));
        begun.err().map(|why| why.to_string()).unwrap_or_default()
    };
    let strange = Bucket::new();
    strange.write("holiday/1.jpg", b"beach");
    assert!(begin(&strange).contains("not empty and holds no store (holiday/1.jpg"));
    assert_eq!(strange.names(""), ["holiday/1.jpg"]);
    let other = Bucket::new();
    other.write("format", b"stage shared store 9 x\n");
    assert!(begin(&other).contains("another"));
    // As the engine wrote it while it bore the name of its first product.
    let former = Bucket::new();
    let mark = format!("tailor shared store 1 {}\n", "a1".repeat(32));
    former.write("format", mark.as_bytes());
    assert_eq!(begin(&former), "");
}
