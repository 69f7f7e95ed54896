//! A disk that knows no locks: two workers make the same, and the second compares.

use crate::place::Place;
use crate::strands::{planned, worked};
use engine::recipe::Overrides;
use engine::store::{Record, Store};
use engine::walk::Watch;
use stage::Hash;
use std::sync::{Barrier, Mutex};

/// Notes which nodes came out otherwise than somebody else's.
#[derive(Default)]
struct Differ(Mutex<Vec<(String, Hash, Hash)>>);
impl Watch for Differ {
    fn differs(&self, node: &str, theirs: Hash, ours: Hash) {
        self.0.lock().unwrap().push((node.into(), theirs, ours));
    }
}

#[test]
fn who_comes_second_where_there_are_no_locks_compares_and_the_first_counts() {
    let text = |stage: &str| {
        format!(
            "goal = \"x\"\n[input.src]\nfiles = \"*.txt\"\n[node.clean]\nstage = \"toy.clean\"\n\
             from = {{ files = \"@src\" }}\n[node.x]\nstage = \"{stage}\"\nfrom = {{ text = \"clean\" }}\n\
             with = {{ sleep_ms = 300 }}\n"
        )
    };
    for (stage, steady) in [("toy.mid", true), ("toy.unsteady", false)] {
        let place = Place::new("hello\n");
        let plan = planned(&place, &text(stage), &[Overrides::default()]);
        // A file in the place of the folder of locks: nobody can have one.
        std::fs::write(place.cache().join("lease"), "").unwrap();
        let differ = Differ::default();
        let contents: Vec<Hash> = std::thread::scope(|scope| {
            let one = |late_ms: u64| {
                std::thread::sleep(std::time::Duration::from_millis(late_ms));
                let worked = worked(&place, &plan, 0, &differ).unwrap();
                assert!(worked.outcome.failure(&worked.graph).is_none());
                worked.outcome.nodes[1].as_ref().unwrap().content.unwrap()
            };
            let two = [0, 100].map(|late_ms| scope.spawn(move || one(late_ms)));
            two.map(|t| t.join().unwrap()).into()
        });
        assert_eq!(contents[0], contents[1], "the first counts for both");
        let reported = differ.0.into_inner().unwrap();
        assert_eq!(reported.is_empty(), steady, "{stage}");
        assert!(reported.iter().all(|(node, theirs, ours)| {
            node == "x" && *theirs == contents[0] && *ours != contents[0]
        }));
    }
}

#[test]
fn of_many_who_write_one_record_at_once_the_first_counts_for_all() {
    let folder = proof::in_memory();
    let store = Store::open(folder.path()).unwrap();
    for round in 0..50 {
        let provenance = vec![("stage".to_owned(), format!("toy v{round}"))];
        let record = |n: u8| {
            let content = store.keep(&[n; 9], 0.0).unwrap();
            Record {
                provenance: provenance.clone(),
                content,
                bytes: 9,
                seconds: f64::from(n),
                metrics: vec![],
                warnings: vec![],
            }
        };
        let key = engine::key::of(&provenance);
        let records: Vec<Record> = (0..8).map(record).collect();
        let together = Barrier::new(8);
        let came: Vec<Option<Record>> = std::thread::scope(|scope| {
            let one = |record| {
                together.wait();
                store.create_record(key, record).unwrap()
            };
            let all: Vec<_> = records
                .iter()
                .map(|r| scope.spawn(move || one(r)))
                .collect();
            all.into_iter().map(|t| t.join().unwrap()).collect()
        });
        let first = came
            .iter()
            .position(Option::is_none)
            .expect("somebody is first");
        for (at, theirs) in came.iter().enumerate().filter(|(at, _)| *at != first) {
            assert_eq!(
                theirs.as_ref(),
                Some(&records[first]),
                "round {round}, {at}"
            );
        }
    }
}
