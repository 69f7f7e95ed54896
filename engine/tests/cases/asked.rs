//! What is done of a plan, by a shared store: asked for at once, and only of those who are believed.

use crate::bucket::Bucket;
use crate::place::{Log, Place};
use crate::shared::{begun, caches};
use crate::signed::trusting;
use crate::strands::{planned, worked_in};
use crate::toys::CATALOG;
use engine::recipe::Overrides;
use engine::store::Store;
use engine::strands::{self, Plan};
use std::path::Path;
use std::time::Duration;

const TEXT: &str = "goal = \"final\"\n[input.src]\nfiles = \"*.txt\"\n[node.clean]\nstage = \"toy.clean\"\n\
    from = { files = \"@src\" }\n[node.final]\nstage = \"toy.mid\"\nfrom = { text = \"clean\" }\n";

fn state(plan: &Plan, cache: &Path) -> cluster::Strands {
    let pipeline = strands::pipeline(plan, &CATALOG).unwrap();
    cluster::state(plan, &pipeline, &Store::open(cache).unwrap()).unwrap()
}

#[test]
fn what_is_done_of_a_plan_is_asked_at_once_and_not_once_a_record() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a, b, c] = caches(&place);
    let point = |n: i64| Overrides {
        variant: None,
        sets: vec![format!("final.n={n}")],
    };
    let points: Vec<Overrides> = (100..160).map(point).collect();
    let plan = planned(&place, TEXT, &points);
    assert_eq!(plan.strands.len(), 61);
    let (sharing, _) = begun(&a, &bucket, false);
    for strand in 0..40 {
        worked_in(&a, &plan, strand, &Log::default()).unwrap();
    }
    assert_eq!(sharing.finish(Duration::from_secs(20)).waiting, 0);
    bucket.requests();
    let (sharing, printed) = begun(&b, &bucket, true);
    let there = state(&plan, &b);
    // Whose store it is, what it has, and the one record that other strands read.
    assert_eq!(bucket.requests(), 3);
    drop(sharing);
    let done: Vec<usize> = (0..61).filter(|at| there.done[*at]).collect();
    assert_eq!(done, (0..40).collect::<Vec<_>>());
    assert_eq!(state(&plan, &a), there, "as by the cache that has all");
    assert_eq!(printed.lock().unwrap().len(), 0);
    // Nobody who is trusted signed any of it.
    let sharing = trusting(&c, &bucket, "lab");
    assert_eq!(state(&plan, &c).done_in(0..61), 0);
    drop(sharing);
}
