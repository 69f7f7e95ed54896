//! A store that machines share: what one makes another finds, and what the place does of itself is reported.

use crate::bucket::{Bucket, Faults};
use crate::place::{ALL, Log, NONE, Place, chain, graph};
use crate::strands::{planned, worked};
use engine::recipe::Overrides;
use engine::store::Store;
use engine::store::remote::{Left, Manner, Sharing};
use engine::strands::Plan;
use stage::Hash;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// What was reported to the user.
pub(crate) type Printed = Arc<Mutex<Vec<String>>>;

/// A cache's use of a bucket.
pub(crate) fn begun(cache: &Path, bucket: &Bucket, read_only: bool) -> (Sharing, Printed) {
    let printed = Printed::default();
    let to = printed.clone();
    let report = move |line: &str| to.lock().unwrap().push(line.to_owned());
    let manner = Manner {
        read_only,
        seal: None,
        ..Manner::default()
    };
    let sharing = Sharing::begin(cache, Box::new(bucket.clone()), manner, Box::new(report));
    (sharing.unwrap(), printed)
}

/// What a run of [`chain`] makes in a cache that shares a bucket; what was left to upload; what was reported.
pub(crate) fn shared(
    place: &Place,
    cache: &Path,
    bucket: &Bucket,
    n: i64,
) -> (Vec<String>, Left, Vec<String>) {
    let (sharing, printed) = begun(cache, bucket, false);
    let made = place.run_in(&chain(n), cache, 2);
    let left = sharing.finish(Duration::from_secs(20));
    let printed = printed.lock().unwrap().clone();
    (made, left, printed)
}

pub(crate) fn caches<const N: usize>(place: &Place) -> [PathBuf; N] {
    std::array::from_fn(|i| place.path().join(format!("cache{i}")))
}

/// Small or large: results within records, and as blobs.
pub(crate) fn texts() -> [String; 2] {
    ["hello\n".into(), format!("{}\n", "hello ".repeat(40_000))]
}

/// The files of a shelf by name, with their bytes.
pub(crate) fn shelf(cache: &Path, name: &str) -> Vec<(String, Vec<u8>)> {
    let inner = |d: PathBuf| {
        std::fs::read_dir(d)
            .into_iter()
            .flatten()
            .map(|e| e.unwrap().path())
    };
    let files = inner(cache.join(name)).flat_map(inner);
    let name = |p: &PathBuf| p.file_name().unwrap().to_str().unwrap().to_owned();
    let mut all: Vec<_> = files
        .map(|p| (name(&p), std::fs::read(&p).unwrap()))
        .collect();
    all.sort();
    all
}

#[test]
fn what_one_makes_another_finds_with_the_bytes_of_a_run_alone() {
    for text in texts() {
        let place = Place::new(&text);
        let bucket = Bucket::new();
        let [a, b, c] = caches(&place);
        let (made, left, printed) = shared(&place, &a, &bucket, 1);
        assert_eq!(
            (made.as_slice(), printed),
            (ALL.map(str::to_owned).as_slice(), vec![])
        );
        assert_eq!(
            left,
            Left {
                sent: 4,
                waiting: 0,
                unlisted: false,
                why: None
            }
        );
        let (made, left, printed) = shared(&place, &b, &bucket, 1);
        assert_eq!((made, printed), (vec![], vec![]));
        assert_eq!((left.sent, left.waiting), (0, 0));
        place.run_in(&chain(1), &c, 2);
        let alone = shelf(&c, "cas");
        assert_eq!(shelf(&a, "cas"), alone);
        // Of what is between only the content is known: nobody has read it.
        for blob in shelf(&b, "cas") {
            assert!(alone.contains(&blob));
        }
        // The same records, but for where they were made.
        let records = |cache: &Path| {
            let store = Store::open(cache).unwrap();
            let keys = shelf(cache, "ac").into_iter();
            let record = |(key, _): (String, Vec<u8>)| store.record(Hash::from_hex(&key).unwrap());
            keys.map(record).collect::<Vec<_>>()
        };
        assert_eq!(records(&b), records(&a));
        // Alone again, all the same.
        assert_eq!(place.run_in(&chain(1), &b, 2), NONE);
    }
}

#[test]
fn what_was_made_before_goes_there_too_and_what_is_known_is_asked_once() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a] = caches(&place);
    place.run_in(&chain(1), &a, 2);
    let (made, left, _) = shared(&place, &a, &bucket, 1);
    assert_eq!((made, left.sent), (vec![], 4));
    bucket.requests();
    let (made, left, _) = shared(&place, &a, &bucket, 1);
    assert_eq!((made, left.sent), (vec![], 0));
    assert_eq!(bucket.requests(), 1, "its format, and nothing else");
    // A bucket that was emptied is another store: what was known of it does not hold.
    let bucket = Bucket::new();
    assert_eq!(shared(&place, &a, &bucket, 1).1.sent, 4);
}

#[test]
fn a_sweep_of_a_thousand_points_that_is_made_asks_little() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    let mut nodes = "[node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n".to_owned();
    let names: Vec<String> = (0..1000).map(|n| format!("n{n}")).collect();
    for (n, name) in names.iter().enumerate() {
        nodes += &format!(
            "[node.{name}]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ n = {} }}\n",
            n + 100
        );
    }
    let goal: Vec<&str> = names.iter().map(String::as_str).collect();
    let graph = graph(&goal, &nodes);
    let run = |cache: &Path| {
        let (sharing, printed) = begun(cache, &bucket, false);
        let made = place.run_in(&graph, cache, 2).len();
        let left = sharing.finish(Duration::from_secs(60));
        assert_eq!((left.waiting, printed.lock().unwrap().clone()), (0, vec![]));
        (made, bucket.requests())
    };
    let (made, _) = run(&a);
    assert_eq!(made, 1001);
    let (made, requests) = run(&a);
    assert_eq!(made, 0);
    assert!(requests <= 20, "{requests} requests where all is here");
    let (made, requests) = run(&b);
    assert_eq!(made, 0);
    // One a record: they are brought here.
    assert!(
        requests <= 1020,
        "{requests} requests where nothing is here"
    );
}

#[test]
fn a_plan_is_made_here_and_worked_on_there() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [b, c] = caches(&place);
    let text = "goal = \"final\"\n[input.src]\nfiles = \"*.txt\"\n[node.clean]\nstage = \"toy.clean\"\n\
                from = { files = \"@src\" }\n[node.final]\nstage = \"toy.mid\"\nfrom = { text = \"clean\" }\n";
    let point = |n: i64| Overrides {
        variant: None,
        sets: vec![format!("final.n={n}")],
    };
    let name = {
        let (sharing, _) = begun(&place.cache(), &bucket, false);
        let plan = planned(&place, text, &[point(1), point(2)]);
        let name = plan.write(&place.store()).unwrap();
        assert_eq!(plan.strands.len(), 3);
        sharing.finish(Duration::from_secs(20));
        name
    };
    let work = |cache: &Path, strands: &[usize]| {
        let (sharing, _) = begun(cache, &bucket, false);
        let store = Store::open(cache).unwrap();
        let (_, plan) = Plan::read(&store, &name[..8]).unwrap();
        for strand in strands {
            let worked = crate::strands::worked_in(cache, &plan, *strand, &Log::default()).unwrap();
            assert!(worked.outcome.failure(&worked.graph).is_none());
        }
        assert_eq!(sharing.finish(Duration::from_secs(20)).waiting, 0);
    };
    work(&b, &[0, 1]);
    work(&c, &[2]);
    // Where it was planned nothing is to be made.
    let (sharing, _) = begun(&place.cache(), &bucket, false);
    let (_, plan) = Plan::read(&place.store(), &name).unwrap();
    for strand in 0..3 {
        let worked = worked(&place, &plan, strand, &Log::default()).unwrap();
        let made = worked.outcome.nodes.iter().flatten();
        assert_eq!(
            made.filter(|d| d.status.word() == "made").count(),
            0,
            "{strand}"
        );
    }
    drop(sharing);
    // A plan there that is not what its name promises is none.
    bucket.change(&format!("plans/{name}"), |bytes| bytes[20] ^= 1);
    let [_, _, d] = caches(&place);
    let _sharing = begun(&d, &bucket, false);
    let read = Plan::read(&Store::open(&d).unwrap(), &name);
    assert!(read.is_err());
}

#[test]
fn what_is_old_goes_by_the_bucket_s_clock_and_everybody_asks_anew() {
    let place = Place::new(&texts()[1]);
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    shared(&place, &a, &bucket, 1);
    let day = Duration::from_secs(86_400);
    bucket.later(3 * day);
    shared(&place, &a, &bucket, 2);
    let (sharing, _) = begun(&a, &bucket, false);
    let all = bucket.names("ac").len();
    let dry = sharing.sweep(2 * day, true).unwrap();
    assert_eq!((dry.records, bucket.names("ac").len()), (4, all));
    assert_eq!(sharing.sweep(2 * day, false).unwrap(), dry);
    assert_eq!(bucket.names("ac").len(), all - 4);
    assert_eq!(bucket.names("probe"), NONE);
    assert_eq!(sharing.sweep(2 * day, false).unwrap().records, 0);
    let looked = sharing.look().unwrap();
    assert_eq!(looked.records, all - 4);
    assert!(
        (looked.ahead_s - 3.0 * 86_400.0).abs() < 60.0,
        "{}",
        looked.ahead_s
    );
    drop(sharing);
    // What went is still here, and goes there again; who has nothing is served.
    let (made, left, _) = shared(&place, &a, &bucket, 1);
    assert_eq!((made, left.sent), (vec![], 4));
    assert_eq!(shared(&place, &b, &bucket, 1).0, NONE);
}

#[test]
fn read_only_takes_and_puts_nothing() {
    let place = Place::new(&texts()[1]);
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    let manner = Manner {
        read_only: true,
        seal: None,
        ..Manner::default()
    };
    let refused = Sharing::begin(&b, Box::new(bucket.clone()), manner, Box::new(|_| {}));
    let why = refused.err().expect("there is no store yet").to_string();
    assert!(why.contains("no store yet"), "{why}");
    shared(&place, &a, &bucket, 1);
    let before = bucket.names("");
    bucket.fail(Faults {
        refuses: Some("nothing is to be written"),
        ..Faults::default()
    });
    let (sharing, printed) = begun(&b, &bucket, true);
    assert_eq!(place.run_in(&chain(1), &b, 2), NONE);
    assert_eq!(place.run_in(&chain(2), &b, 2), ["final", "mid"]);
    let left = sharing.finish(Duration::from_secs(5));
    assert_eq!((left.sent, left.waiting), (0, 0));
    assert_eq!(
        (bucket.names(""), printed.lock().unwrap().clone()),
        (before, vec![])
    );
}
