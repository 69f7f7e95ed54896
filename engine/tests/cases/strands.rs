//! Strands: what is cut, what a worker makes of it, and what it refuses.

use crate::place::{Log, Place};
use crate::toys::CATALOG;
use engine::recipe::{Overrides, Pipeline};
use engine::strands::{self, Asked, Plan, PlanError, WorkError, Worked};
use engine::walk::{Status, Watch};
use engine::{Options, Outcome};
use stage::Hash;
use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;

/// clean → mid → final, and other beside mid.
const TEXT: &str = r#"goal = ["final", "other"]
[input.src]
files = "*.txt"
[node.clean]
stage = "toy.clean"
from = { files = "@src" }
[node.mid]
stage = "toy.mid"
from = { text = "clean" }
with = { n = 1, sleep_ms = 5 }
[node.final]
stage = "toy.mid"
from = { text = "mid" }
[node.other]
stage = "toy.mid"
from = { text = "clean" }
with = { n = 99 }
"#;

/// So many mids, and finals of each.
fn points(mids: i64, finals: i64) -> Vec<Overrides> {
    let sets = |m: i64, f: i64| vec![format!("mid.n={m}"), format!("final.n={f}")];
    let one = |m| {
        (20..20 + finals).map(move |f| Overrides {
            variant: None,
            sets: sets(m, f),
        })
    };
    (0..mids).flat_map(one).collect()
}

/// The plan of some points.
pub(crate) fn planned(place: &Place, text: &str, points: &[Overrides]) -> Plan {
    let pipeline = Pipeline::of_text("toy.toml", text, &CATALOG).unwrap();
    let folders = vec![("src".to_owned(), place.src())];
    let points: Vec<_> = points
        .iter()
        .map(|p| (p.clone(), folders.clone()))
        .collect();
    let asked = Asked {
        pipeline: &pipeline,
        points: &points,
        nodes: &[],
    };
    strands::planned(&asked, CATALOG.program, &place.store()).unwrap()
}

/// What comes of a strand.
pub(crate) fn worked(
    place: &Place,
    plan: &Plan,
    strand: usize,
    watch: &dyn Watch,
) -> Result<Worked, WorkError> {
    worked_in(&place.cache(), plan, strand, watch)
}

/// As [`worked`], in a cache.
pub(crate) fn worked_in(
    cache: &std::path::Path,
    plan: &Plan,
    strand: usize,
    watch: &dyn Watch,
) -> Result<Worked, WorkError> {
    let pipeline = strands::pipeline(plan, &CATALOG).unwrap();
    let options = Options {
        cache: cache.into(),
        threads: Some(2),
        keep_going: true,
    };
    strands::work(
        plan,
        strand,
        &pipeline,
        &options,
        watch,
        &AtomicBool::new(false),
    )
}

/// How many nodes of a strand ended so.
fn count(worked: &Worked, status: &Status) -> usize {
    let nodes = worked.nodes.iter().flat_map(|i| &worked.outcome.nodes[*i]);
    nodes.filter(|d| d.status == *status).count()
}

/// The contents that a local run of a point comes to.
fn local(place: &Place, point: &Overrides) -> Vec<Option<Hash>> {
    let pipeline = Pipeline::of_text("toy.toml", TEXT, &CATALOG).unwrap();
    let graph = pipeline.graph(point).unwrap();
    let outcome: Outcome = place.outcome(&graph, &place.path().join("local"), 1, &Log::default());
    outcome.nodes.iter().map(|d| d.as_ref()?.content).collect()
}

#[test]
fn what_points_share_is_one_strand_and_every_chain_above_it_one_more() {
    let place = Place::new("hello\n");
    let plan = planned(&place, TEXT, &points(3, 4));
    let reported: Vec<(usize, Vec<&str>)> = plan
        .strands
        .iter()
        .map(|s| (s.layer, s.nodes.iter().map(String::as_str).collect()))
        .collect();
    assert_eq!(reported[0], (0, vec!["clean"]));
    assert_eq!(
        reported.iter().filter(|s| **s == (1, vec!["mid"])).count(),
        3
    );
    assert_eq!(
        reported
            .iter()
            .filter(|s| **s == (1, vec!["other"]))
            .count(),
        1
    );
    assert_eq!(
        reported
            .iter()
            .filter(|s| **s == (2, vec!["final"]))
            .count(),
        12
    );
    assert_eq!(reported.len(), 17);
    assert_eq!((plan.layers(), plan.layer(1)), (3, 1..5));
    // A run is one point: a strand a goal, and one for what they share.
    let run = planned(&place, TEXT, &points(1, 1));
    let nodes: BTreeSet<Vec<String>> = run.strands.iter().map(|s| s.nodes.clone()).collect();
    let names = |n: &[&str]| n.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>();
    assert_eq!(
        nodes,
        [
            names(&["clean"]),
            names(&["mid", "final"]),
            names(&["other"])
        ]
        .into()
    );
}

#[test]
fn strands_come_to_what_a_local_run_does_each_result_once_and_twice_is_harmless() {
    let place = Place::new("hello\n");
    let points = points(2, 3);
    let plan = planned(&place, TEXT, &points);
    let name = plan.write(&place.store()).unwrap();
    assert_eq!(
        planned(&place, TEXT, &points)
            .write(&place.store())
            .unwrap(),
        name
    );
    let (whole, plan) = Plan::read(&place.store(), &name[..8]).unwrap();
    assert_eq!(whole, name);
    let mut made = 0;
    for strand in 0..plan.strands.len() {
        let first = worked(&place, &plan, strand, &Log::default()).unwrap();
        made += count(&first, &Status::Executed);
        let again = worked(&place, &plan, strand, &Log::default()).unwrap();
        assert_eq!(count(&again, &Status::Executed), 0);
        let content = |w: &Worked, i: usize| w.outcome.nodes[i].as_ref().and_then(|d| d.content);
        let here = &local(&place, &points[plan.strands[strand].point]);
        for i in &first.nodes {
            assert_eq!(content(&first, *i), here[*i]);
        }
    }
    assert_eq!(made, 1 + 2 + 1 + 6, "every result once");
    // A result that went away after it was made is made again for who reads it.
    let clean = worked(&place, &plan, 0, &Log::default()).unwrap();
    let content = clean.outcome.nodes[clean.nodes[0]]
        .as_ref()
        .unwrap()
        .content
        .unwrap();
    drop(clean);
    let hex = content.to_hex();
    let blob = place.cache().join("cas").join(&hex[..2]).join(hex.as_str());
    std::fs::remove_file(blob).unwrap();
    std::fs::remove_file(place.cache().join("index")).unwrap();
    let last = plan
        .strands
        .iter()
        .rposition(|s| s.nodes == ["other"])
        .unwrap();
    assert_eq!(
        count(
            &worked(&place, &plan, last, &Log::default()).unwrap(),
            &Status::Hit
        ),
        1
    );
}

#[test]
fn a_failing_strand_fails_alone_and_what_reads_it_names_who_did_not_make_it() {
    let place = Place::new("hello\n");
    let mut points = points(2, 2);
    points[0].sets[0] = "mid.n=13".into();
    points[1].sets[0] = "mid.n=13".into();
    let plan = planned(&place, TEXT, &points);
    let (mut failed, mut early, mut done) = (vec![], vec![], 0);
    for strand in 0..plan.strands.len() {
        match worked(&place, &plan, strand, &Log::default()) {
            Ok(w) if w.outcome.failure(&w.graph).is_some() => failed.push(strand),
            Ok(_) => done += 1,
            Err(WorkError::Early { strand, node, from }) => early.push((strand, node, from)),
            Err(other) => panic!("{other}"),
        }
    }
    assert_eq!((failed.len(), early.len(), done), (1, 2, 5));
    for (strand, node, from) in early {
        assert_eq!((node.as_str(), from), ("mid", failed[0]));
        assert!(plan.strands[strand].reads.contains(&from));
    }
}

#[test]
fn a_plan_that_is_not_whole_or_means_something_else_is_refused() {
    let place = Place::new("hello\n");
    let plan = planned(&place, TEXT, &points(1, 2));
    let name = plan.write(&place.store()).unwrap();
    let missing = Plan::read(&place.store(), "0123456789");
    assert!(matches!(missing, Err(PlanError::None(..))));
    assert!(matches!(
        Plan::read(&place.store(), ""),
        Err(PlanError::None(..))
    ));
    let file = place.cache().join("plans").join(&name);
    let whole = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, whole.replace("mid.n=0", "mid.n=1")).unwrap();
    let changed = Plan::read(&place.store(), &name);
    assert!(matches!(changed, Err(PlanError::Corrupt(..))));
    // Under the name of its own hash, but with what cannot be.
    let changes = [
        ("\"a.txt\"", "\"../../etc/passwd\""),
        ("\"point\": 1", "\"point\": 7"),
        ("\"layer\": 0", "\"layer\": 9"),
    ];
    for (from, to) in changes {
        let changed = whole.replacen(from, to, 1);
        assert_ne!(changed, whole, "{from}");
        let hash = stage::hash(changed.as_bytes()).to_hex().to_string();
        std::fs::write(place.cache().join("plans").join(&hash), changed).unwrap();
        let read = Plan::read(&place.store(), &hash);
        assert!(matches!(read, Err(PlanError::Corrupt(..))), "{to}");
    }
    let later = whole.replacen("\"version\": 1", "\"version\": 9", 1);
    let hash = stage::hash(later.as_bytes()).to_hex().to_string();
    std::fs::write(place.cache().join("plans").join(&hash), later).unwrap();
    let read = Plan::read(&place.store(), &hash);
    assert!(matches!(read, Err(PlanError::Version(..))));
    // Planned by a program whose stages did something else.
    let mut other = plan.clone();
    other.strands[0].recipe = "0".repeat(64);
    let refused = worked(&place, &other, 0, &Log::default());
    assert!(matches!(refused, Err(WorkError::Other(0, _))));
    let unknown = worked(&place, &plan, 99, &Log::default());
    assert!(matches!(unknown, Err(WorkError::Unknown(99, _))));
}

#[test]
fn an_input_that_changed_since_the_plan_is_reported() {
    let place = Place::new("hello\n");
    let plan = planned(&place, TEXT, &points(1, 1));
    place.write("other\n");
    let worked = worked(&place, &plan, 0, &Log::default()).unwrap();
    let (node, why) = worked.outcome.failure(&worked.graph).unwrap();
    assert_eq!(node, "clean");
    assert!(why.contains("changed"), "{why}");
}

#[test]
fn a_plan_names_a_folder_and_is_forgotten_with_it() {
    let place = Place::new("hello\n");
    let name = planned(&place, TEXT, &points(1, 1))
        .write(&place.store())
        .unwrap();
    engine::store::forget(&place.store(), &place.src()).unwrap();
    assert!(matches!(
        Plan::read(&place.store(), &name),
        Err(PlanError::None(..))
    ));
}
