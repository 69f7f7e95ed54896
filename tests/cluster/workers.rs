//! `tailor work`, as any cluster starts it: in any order within a layer, twice, killed and again.

use crate::place::Place;
use std::process::Stdio;
use std::time::Duration;

const CELLS: &str = "50,45,40";

#[test]
fn processes_make_each_strand_once_and_come_to_what_one_sweep_does() {
    let place = Place::new();
    let (plan, strands) = place.plan(CELLS);
    assert_eq!(strands, 4, "what all share, and one a point");
    let work = |strand: &str| place.run(&["work", "--plan", &plan, "--strand", strand]);
    let early = work("2");
    let said = String::from_utf8_lossy(&early.stderr).into_owned();
    assert_eq!(early.status.code(), Some(1), "{said}");
    assert!(said.contains("which strand 0 has not made yet"), "{said}");
    assert!(work("0").status.success());
    // Two processes on the same strands, and one on all: side by side.
    let all = ["1-3", "3,2,1", "0-3"].map(|strands| {
        let mut command = place.tailor(&["work", "--plan", &plan, "--strand", strands, "--quiet"]);
        command.stderr(Stdio::piped()).spawn().unwrap()
    });
    for child in all {
        let ended = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(ended.status.success(), "{said}");
    }
    assert_eq!(place.made(), 4, "event logs: each result once");
    assert_eq!(
        place.swept(CELLS),
        (0, 6),
        "the table is there for the asking"
    );
    let alone = Place::new();
    alone.swept(CELLS);
    assert_eq!(place.contents(), alone.contents());
}

#[test]
fn a_killed_worker_leaves_nothing_to_unlock_and_another_goes_on() {
    let place = Place::new();
    let (plan, _) = place.plan("8,50");
    let strand = ["work", "--plan", &plan, "--strand", "0-2"];
    let mut lost = 0;
    for wait_ms in [30, 60, 120, 250] {
        let mut child = place.tailor(&strand).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait_ms));
        child.kill().unwrap();
        lost += usize::from(!child.wait().unwrap().success());
    }
    assert!(lost > 0, "none was killed in time");
    assert!(place.run(&strand).status.success());
    assert_eq!(place.swept("8,50"), (0, 4));
    let found = place.run(&["cache", "verify"]);
    assert!(found.status.success());
}

#[test]
fn what_cannot_be_worked_on_is_told() {
    let place = Place::new();
    let (plan, _) = place.plan("50");
    for (arguments, code, part) in [
        (
            vec!["--plan", "abcdef", "--strand", "0"],
            2,
            "there is no plan abcdef",
        ),
        (vec!["--plan", &plan, "--strand", "x"], 2, "say 3, or 0-63"),
        (
            vec!["--plan", &plan, "--strand", "3-1"],
            2,
            "say 3, or 0-63",
        ),
        (
            vec!["--plan", &plan, "--strand", "9"],
            1,
            "strand 9 is not in the plan, which has 1",
        ),
    ] {
        let ran = place.run(&[&["work"], &arguments[..]].concat());
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(part), "{said}");
    }
}
