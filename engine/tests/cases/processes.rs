//! Several processes on one store, and processes that are killed.
//!
//! A process is this very test program, asked by its environment to do nothing but one run.

use crate::place::{Log, NONE, Place, chain, graph};
use engine::graph::Graph;
use engine::store::{Claim, retention};
use engine::walk::{Done, Status, Watch};
use engine::{self, Options};
use proof::Dice;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// `width` chains of `length` nodes, each of which takes so long; another `n` gives other nodes.
pub(crate) fn wide(width: usize, length: usize, sleep_ms: u64, n: i64) -> Graph {
    let mut nodes =
        String::from("[node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n");
    let mut goal = Vec::new();
    for w in 0..width {
        let mut from = "clean".to_owned();
        for l in 0..length {
            let name = format!("w{w}l{l}");
            let n = n * 1000 + (w * length + l) as i64;
            let _ = write!(
                nodes,
                "[node.{name}]\nstage = \"toy.mid\"\nfrom = {{ text = \"{from}\" }}\n\
                 with = {{ n = {n}, sleep_ms = {sleep_ms} }}\n"
            );
            from = name;
        }
        goal.push(from);
    }
    let goal: Vec<&str> = goal.iter().map(String::as_str).collect();
    graph(&goal, &nodes)
}

/// What a child is to run.
fn job(text: &str) -> Graph {
    let words: Vec<u64> = text.split(' ').map(|w| w.parse().unwrap()).collect();
    match words[..] {
        [n] => chain(n as i64),
        [width, length, sleep_ms, n] => wide(width as usize, length as usize, sleep_ms, n as i64),
        _ => panic!("no job: {text}"),
    }
}

/// Appends a line for every stage that ran.
struct Tally(std::fs::File);
impl Watch for Tally {
    fn done(&self, node: &str, done: &Done) {
        if done.status == Status::Executed {
            let mut file = &self.0;
            file.write_all(format!("{node}\n").as_bytes()).unwrap();
        }
    }
}

#[test]
#[ignore = "the process that the other tests start"]
fn child() {
    let var = |name: &str| std::env::var(name).expect("started by another test");
    let (folder, graph) = (var("TOY_FOLDER"), job(&var("TOY_JOB")));
    let folder = Path::new(&folder);
    let tally = std::fs::File::options()
        .create(true)
        .append(true)
        .open(folder.join("tally"));
    let options = Options {
        cache: folder.join("cache"),
        threads: Some(2),
        keep_going: false,
    };
    let folders = [("src".to_owned(), folder.join("src"))];
    let (tally, cancel) = (Tally(tally.unwrap()), AtomicBool::new(false));
    let outcome = engine::run(&graph, &folders, &graph.goal, &options, &tally, &cancel);
    let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.failure(&graph), None);
}

pub(crate) fn start(place: &Place, job: &str) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "processes::child", "--ignored", "--quiet"])
        .env("TOY_FOLDER", place.path())
        .env("TOY_JOB", job)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// How often each node was made, over all processes.
fn tally(place: &Place) -> BTreeMap<String, usize> {
    let text = std::fs::read_to_string(place.path().join("tally")).unwrap_or_default();
    let mut tally = BTreeMap::new();
    text.lines()
        .for_each(|node| *tally.entry(node.to_owned()).or_default() += 1);
    tally
}

#[test]
fn eight_processes_on_one_store_make_each_result_once() {
    let place = Place::new("hello\n");
    let children: Vec<Child> = (0..8).map(|_| start(&place, "6 4 10 1")).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let tally = tally(&place);
    assert_eq!(tally.len(), 25);
    assert!(tally.values().all(|n| *n == 1), "{tally:?}");
    assert_eq!(retention::verify(&place.store()).unwrap(), 0);
}

#[test]
fn nodes_that_come_to_the_same_are_made_once_in_one_process() {
    let place = Place::new("hello\n");
    let twin = |name: &str| {
        format!(
            "[node.{name}]\nstage = \"toy.mid\"\nfrom = {{ text = \"clean\" }}\nwith = {{ sleep_ms = 40 }}\n"
        )
    };
    let nodes = format!(
        "[node.clean]\nstage = \"toy.clean\"\nfrom = {{ files = \"@src\" }}\n{}{}",
        twin("one"),
        twin("two")
    );
    let made = place.run_in(&graph(&["one", "two"], &nodes), &place.cache(), 2);
    assert_eq!(made.len(), 2, "clean and one of the twins: {made:?}");
}

#[test]
fn stages_that_need_more_memory_than_there_is_run_one_after_the_other() {
    let place = Place::new("hello\n");
    let mut nodes =
        String::from("[node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n");
    for n in 0..4 {
        let from = "from = { text = \"clean\" }";
        let _ = write!(
            nodes,
            "[node.b{n}]\nstage = \"toy.big\"\n{from}\nwith = {{ n = {n}, sleep_ms = 30 }}\n"
        );
    }
    let graph = graph(&["b0", "b1", "b2", "b3"], &nodes);
    let outcome = place.outcome(&graph, &place.cache(), 4, &Log::default());
    for done in outcome
        .nodes
        .iter()
        .flatten()
        .filter(|d| !d.metrics.is_empty())
    {
        assert_eq!(done.metrics[0].value, 0.0, "another ran beside it");
    }
    assert_eq!(
        outcome
            .nodes
            .iter()
            .flatten()
            .filter(|d| !d.metrics.is_empty())
            .count(),
        4
    );
}

#[test]
fn a_process_killed_in_a_stage_leaves_nothing_to_unlock() {
    let place = Place::new("hello\n");
    place.run(1);
    let job = "1 1 60000 1";
    let outcome = place.outcome(&chain(1), &place.cache(), 1, &Log::default());
    let clean = outcome.nodes[0].as_ref().unwrap().content;
    let graph = self::job(job);
    let key = engine::key::key(&graph.nodes[graph.node("w0l0").unwrap()], &[clean]);
    let mut child = start(&place, job);
    while !matches!(place.store().claim(key), Claim::Busy) {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(matches!(place.store().claim(key), Claim::Mine(Some(_))));
    assert_eq!(place.run(1), NONE, "what was done is kept");
}

#[test]
fn two_hundred_kills_at_random_moments_leave_a_clean_store() {
    let place = Place::new("hello\n");
    let mut dice = Dice(1);
    let mut killed = 0;
    // `ENGINE_KILLS=1000` takes more of them.
    let kills = std::env::var("ENGINE_KILLS").map_or(200, |n| n.parse().unwrap());
    for i in 0..kills {
        let job = format!("2 10 1 {}", i / 20);
        let mut child = start(&place, &job);
        std::thread::sleep(Duration::from_micros(dice.within(300.0, 10_000.0) as u64));
        let _ = child.kill();
        killed += usize::from(!child.wait().unwrap().success());
        assert!(
            !place.cache().join("quarantine").exists(),
            "torn at kill {i}"
        );
        if i % 10 == 9 && place.cache().join("format").exists() {
            assert_eq!(
                retention::verify(&place.store()).unwrap(),
                0,
                "after kill {i}"
            );
        }
    }
    assert!(killed >= 20, "only {killed} were killed in time");
    let graph = wide(2, 10, 1, 9);
    place.run_in(&graph, &place.cache(), 2);
    assert_eq!(place.run_in(&graph, &place.cache(), 2), NONE);
    let fresh = place.path().join("fresh");
    let contents = |cache: &Path| {
        let outcome = place.outcome(&graph, cache, 1, &Log::default());
        outcome
            .nodes
            .iter()
            .flatten()
            .map(|d| d.content)
            .collect::<Vec<_>>()
    };
    assert_eq!(contents(&place.cache()), contents(&fresh));
    let budget = retention::Budget {
        most: u64::MAX,
        keep_runs: 1,
        keep_records: 200,
    };
    retention::gc(&place.store(), &budget, false).unwrap();
    for litter in ["tmp", "lease"] {
        let left = std::fs::read_dir(place.cache().join(litter))
            .unwrap()
            .count();
        assert_eq!(left, 0, "gc sweeps {litter}");
    }
}
