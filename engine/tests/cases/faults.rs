//! What goes wrong around a run: lost and garbled files, a full disk, a store that cannot be
//! written to, sources that change.

use crate::place::{ALL, Log, NONE, Place, chain, graph};
use engine::plan;
use engine::store::retention;
use engine::walk::{Status, Watch};
use engine::{self, EngineError, Options};
use std::fs::{File, FileTimes};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

#[test]
fn every_file_of_the_store_may_be_garbled() {
    let place = Place::new("hello\n");
    place.run(1);
    let mut files: Vec<_> = ["ac", "cas"]
        .into_iter()
        .flat_map(|s| place.shelf(s))
        .collect();
    files.extend(["index", "files.json", "last-run", "noted"].map(|f| place.cache().join(f)));
    files.extend(
        std::fs::read_dir(place.cache().join("runs"))
            .unwrap()
            .map(|e| e.unwrap().path()),
    );
    let garble: [fn(Vec<u8>) -> Vec<u8>; 4] = [
        |b| b[..b.len() / 2].to_vec(),
        |_| vec![],
        |b| b.iter().rev().copied().collect(),
        |mut b| {
            let middle = b.len() / 2;
            b.get_mut(middle).into_iter().for_each(|b| *b ^= 0x20);
            b
        },
    ];
    for file in &files {
        for garble in garble {
            let Ok(bytes) = std::fs::read(file) else {
                continue;
            };
            std::fs::write(file, garble(bytes)).unwrap();
            assert!(place.run(1).len() <= 2, "{}", file.display());
            assert_eq!(place.run(1), NONE);
            engine::runs(&place.cache()).for_each(drop);
        }
    }
    assert_eq!(retention::verify(&place.store()).unwrap(), 0);
}

#[test]
fn the_store_may_be_deleted_while_it_is_in_use() {
    struct Deleter<'a>(&'a Place, Mutex<usize>);
    impl Watch for Deleter<'_> {
        fn started(&self, node: &str) {
            let mut times = self.1.lock().unwrap();
            if node == "final" && *times == 0 {
                *times += 1;
                std::fs::remove_dir_all(self.0.cache()).unwrap();
            }
        }
    }
    let place = Place::new("hello\n");
    let graph = chain(1);
    let outcome = place.outcome(&graph, &place.cache(), 1, &Deleter(&place, Mutex::new(0)));
    let statuses = outcome.nodes.iter().flatten().map(|d| &d.status);
    assert!(
        statuses
            .clone()
            .all(|f| matches!(f, Status::Executed | Status::Failed(_))),
        "{statuses:?}"
    );
    place.run(1);
    assert_eq!(place.run(1), NONE);
    assert_eq!(retention::verify(&place.store()).unwrap(), 0);
}

#[test]
fn a_run_that_is_stopped_keeps_what_is_done_and_the_next_goes_on() {
    struct Stopper<'a>(&'a AtomicBool);
    impl Watch for Stopper<'_> {
        fn done(&self, node: &str, _: &engine::walk::Done) {
            if node == "mid" {
                self.0.store(true, std::sync::atomic::Ordering::Relaxed);
            }
        }
    }
    let place = Place::new("hello\n");
    let (graph, cancel) = (chain(1), AtomicBool::new(false));
    let options = Options {
        cache: place.cache(),
        threads: Some(1),
        keep_going: true,
    };
    let folders = [("src".to_owned(), place.src())];
    let stopper = Stopper(&cancel);
    let outcome = engine::run(&graph, &folders, &graph.goal, &options, &stopper, &cancel).unwrap();
    assert!(outcome.cancelled() && outcome.failure(&graph).is_none());
    let status = |name: &str| {
        outcome.nodes[graph.node(name).unwrap()]
            .clone()
            .unwrap()
            .status
    };
    assert_eq!(
        (status("mid"), status("final")),
        (Status::Executed, Status::Cancelled)
    );
    let made = place.run(1);
    assert!(made.contains(&"final".to_owned()) && !made.contains(&"mid".to_owned()));
}

#[test]
fn a_source_that_changes_while_it_is_read_is_reported_and_nothing_is_published() {
    struct Meddler<'a>(&'a Place);
    impl Watch for Meddler<'_> {
        fn started(&self, node: &str) {
            if node == "clean" {
                self.0.write("otherwise\n");
            }
        }
    }
    let place = Place::new("hello\n");
    let graph = chain(1);
    let outcome = place.outcome(&graph, &place.cache(), 1, &Meddler(&place));
    let (node, why) = outcome.failure(&graph).unwrap();
    assert_eq!(node, "clean");
    assert!(
        why.contains("changed while the run was reading it"),
        "{why}"
    );
    assert!(place.shelf("ac").is_empty());
    assert_eq!(place.run(1), ALL);
}

#[test]
fn a_source_of_equal_size_and_time_is_hashed_again() {
    let place = Place::new("hello\n");
    let path = place.src().join("a.txt");
    let past = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    let set = || {
        let file = File::options().write(true).open(&path).unwrap();
        file.set_times(FileTimes::new().set_modified(past)).unwrap();
    };
    set();
    place.run(1);
    place.write("hallo\n");
    set();
    assert_eq!(
        place.run(1),
        ALL,
        "the content changed, size and time did not"
    );
}

#[test]
fn a_store_that_cannot_be_written_to_still_answers() {
    let place = Place::new("hello\n");
    place.run(1);
    let (tmp, lease) = (place.cache().join("tmp"), place.cache().join("lease"));
    for folder in [&tmp, &lease] {
        std::fs::remove_dir_all(folder).unwrap();
        std::fs::write(
            folder,
            "a file where a folder must be: also root cannot write",
        )
        .unwrap();
    }
    assert_eq!(place.run(1), NONE);
    let graph = chain(2);
    let options = Options {
        cache: place.cache(),
        threads: Some(1),
        keep_going: true,
    };
    let (folders, cancel) = ([("src".to_owned(), place.src())], AtomicBool::new(false));
    let run = || {
        engine::run(
            &graph,
            &folders,
            &graph.goal,
            &options,
            &Log::default(),
            &cancel,
        )
    };
    let Err(EngineError::Store(error)) = run() else {
        let outcome = run().unwrap();
        let (node, why) = outcome.failure(&graph).expect("it cannot be kept");
        assert!(node == "mid" && why.contains("--cache"), "{node}: {why}");
        return;
    };
    assert!(error.to_string().contains("--cache"), "{error}");
}

#[test]
fn of_a_chain_of_ten_a_plan_has_one_certain_and_nine_possible() {
    let place = Place::new("hello\n");
    let mut nodes = String::from("[node.n0]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n");
    for i in 1..10 {
        let from = format!("from = {{ text = \"n{}\" }}\nwith = {{ n = {i} }}", i - 1);
        nodes += &format!("[node.n{i}]\nstage = \"toy.mid\"\n{from}\n");
    }
    let graph = graph(&["n9"], &nodes);
    place.run_in(&graph, &place.cache(), 1);
    place.write("hello there\n");
    let store = place.store();
    let folders = [("src".to_owned(), place.src())];
    let files = engine::inputs(&graph, &folders, &store).unwrap();
    let plan = plan::plan(&graph, &files, &graph.goal, &store);
    let state = |name: &str| plan[graph.node(name).unwrap()].clone().unwrap().state;
    assert!(matches!(state("n0"), plan::State::Stale(_)));
    for i in 1..10 {
        assert_eq!(state(&format!("n{i}")), plan::State::May, "n{i}");
    }
}

struct Panics;
impl Watch for Panics {
    fn started(&self, node: &str) {
        assert_ne!(node, "mid", "a bug");
    }
}

#[test]
fn a_worker_that_panics_keeps_nobody_waiting() {
    let (done, over) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let place = Place::new("hello\n");
        let run = || place.outcome(&chain(1), &place.cache(), 3, &Panics);
        done.send(catch_unwind(AssertUnwindSafe(run)).is_err())
    });
    assert_eq!(over.recv_timeout(Duration::from_secs(60)), Ok(true));
}
