//! A program that stays for the run: given each job, ended at last, whatever it does.

use crate::application::{Place, Text, left};
use engine::Options;
use engine::recipe::Overrides;
use engine::sweep::{self, End, Points, Sweeping, axes};
use std::path::PathBuf;
use std::time::Instant;

/// Answers each job by a number of its process's own, and the job's last word; some words are odd jobs.
const PROGRAM: &str = r#"#!/bin/sh
own=$(od -An -N8 -tx8 /dev/urandom | tr -d ' ')
echo '{"ready": true}'
while read -r line; do
  out=$(echo "$line" | sed 's/.*"\(\/[^"]*text.txt\)".*/\1/')
  job=$(echo "$line" | sed 's/.*"\([^"]*\)"\]$/\1/')
  case $job in
    1) echo '{"failed": "one is odd"}'; continue ;;
    2) exit 3 ;;
    3) sleep 100 & echo x > "$out" ;;
    4) sleep 100 ;;
    5) echo "by the way" >&2; sleep 0.3 ;;
    *) echo "$own $job" > "$out" ;;
  esac
  echo '{"done": true}'
done
"#;

fn node(place: &Place) -> String {
    use std::os::unix::fs::PermissionsExt;
    place.write("stays", PROGRAM);
    let path = place.path("stays");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
    format!(
        "[node.x]\nstage = \"exec\"\nout = \"text\"\nkeep = true\ntimeout_s = 5.0\n\
         command = [{:?}, \"{{out}}\", \"{{with.n}}\"]\nwith = {{ n = 10 }}\n",
        path.display()
    )
}

#[test]
fn one_program_serves_all_points_and_ends_with_them() {
    let place = Place::new();
    let nodes = node(&place);
    let graph = place.graph(&nodes);
    place.allow(&graph);
    let open = |sets: &[String]| {
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        place.open(&nodes, &sets)
    };
    let axes = vec![axes::given("x.n=10,1,11,2,12,13").unwrap()];
    let sweeping = Sweeping {
        open: &|point| open(&point.overrides(&Overrides::default()).sets),
        nodes: &[],
        folders: &[],
        // One program serves a thread.
        options: &Options {
            threads: Some(1),
            ..place.options()
        },
        tell: &[],
        errors: None,
        watch: &(),
        cancel: &false.into(),
    };
    let rows = sweep::run(
        &sweeping,
        Points::new(&graph, vec![None], axes).iter(),
        |_| {},
    )
    .unwrap();
    let ends: Vec<String> = rows
        .iter()
        .map(|row| match &row.end {
            End::Failed(_, why) => why.clone(),
            end => format!("{end:?}"),
        })
        .collect();
    assert_eq!(ends[0], "Done");
    assert!(ends[1].ends_with("failed: one is odd"), "{}", ends[1]);
    assert!(ends[3].ends_with("no answer to its job"), "{}", ends[3]);
    assert_eq!(ends[4..], ["Done", "Done"]);
    let number = |n: i32| {
        let graph = place.open(&nodes, &[&format!("x.n={n}")]).unwrap();
        let outcome = place.made(&graph);
        let text = outcome.read::<Text>("x").unwrap().0.clone();
        text.split(' ').next().unwrap().to_owned()
    };
    // A job that failed by its own word ended nobody; who went away was started anew.
    assert_eq!(number(10), number(11));
    assert_eq!(number(12), number(13));
    assert_ne!(number(11), number(12));
    assert_eq!(left(&place.path("cache")), Vec::<PathBuf>::new());
}

#[test]
fn every_way_to_fail_is_reported_and_nobody_stays() {
    let place = Place::new();
    let nodes = node(&place);
    let failure = |n: i32| place.failure(&nodes.replace("n = 10", &format!("n = {n}")));
    assert!(failure(3).contains("left processes behind (sleep"));
    let start = Instant::now();
    assert!(failure(4).contains("was ended after 5 s"));
    assert!(start.elapsed().as_secs() < 30);
    let reported = failure(5);
    assert!(
        reported.contains("wrote nothing") && reported.contains("| by the way"),
        "{reported}"
    );
}

#[test]
fn a_program_among_the_nodes_files_cannot_be_kept() {
    let place = Place::new();
    place.write("a.sh", "");
    let node = "[node.x]\nstage = \"exec\"\nout = \"text\"\nkeep = true\n\
         command = [\"{here}/a.sh\", \"{out}\"]\nfiles = [\"a.sh\"]\n";
    let reported = place.open(node, &[]).err().unwrap();
    assert!(reported.contains("one that is installed"), "{reported}");
}
