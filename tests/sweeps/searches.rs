//! Searches alone and on a cluster, and what is left of a study that was killed.

use super::methods::Place;
use serde_json::Value;
use std::io::{BufRead, BufReader};

#[test]
fn a_search_writes_its_best_set_as_a_variant_and_goes_on_from_the_cache() {
    let place = Place::new();
    let reported = place.tailor("search studies/hulls.toml wide --out found", 0);
    assert!(reported.contains("[variant.wide_best]"), "{reported}");
    place.tailor("run found/best.toml --variant wide_best", 0);
    let search: Value = serde_json::from_str(&place.read("found/search.json")).unwrap();
    let values = search["tried"]
        .as_array()
        .unwrap()
        .iter()
        .map(|t| t["value"].as_f64().unwrap());
    assert_eq!(
        search["best"]["value"].as_f64(),
        values.clone().reduce(f64::max)
    );
    assert_eq!(
        place.read("found/search.csv").lines().count(),
        1 + values.count()
    );
    let best = |reported: &str| {
        reported[reported.find("the best as a variant").unwrap()..]
            .lines()
            .take(6)
            .collect::<Vec<_>>()
            .join("\n")
    };
    let again = place.tailor("search studies/hulls.toml wide --quiet", 0);
    assert_eq!(best(&again), best(&reported), "the same again");
    // Strand by strand, as a cluster does it: the same rounds, the same best set, nothing left to make here.
    let mut rounds = Vec::new();
    let found = loop {
        let answer = place.tailor(
            "search studies/hulls.toml close --strands --json --quiet --cache strands",
            0,
        );
        let answer: Value = serde_json::from_str(&answer).unwrap();
        let Some(plan) = answer["plan"].as_str() else {
            break answer;
        };
        rounds.push(answer["round"].as_u64().unwrap());
        let last = answer["strands"].as_u64().unwrap() - 1;
        let work = format!("cluster work --plan {plan} --strand 0-{last} --quiet --cache strands");
        place.tailor(&work, 0);
    };
    assert_eq!(rounds, [1, 2]);
    let alone = place.tailor(
        "search studies/hulls.toml close --json --quiet --cache alone",
        0,
    );
    assert_eq!(found, serde_json::from_str::<Value>(&alone).unwrap());
    let output = place.tailor("search studies/hulls.toml wid", 2);
    assert!(output.contains("did you mean `wide`"), "{output}");
}

#[test]
fn what_strands_of_a_search_did_not_make_counts_as_refused_once_they_were_worked_on() {
    let place = Place::new();
    // The fine half needs more memory than it may take.
    let search = "search studies/hulls.toml fine --set hull.memory_mb=64 --json --quiet";
    let strands = format!("{search} --strands --cache strands");
    let parsed = |printed: &str| -> Value { serde_json::from_str(printed).unwrap() };
    let answer = parsed(&place.tailor(&strands, 0));
    let (plan, last) = (
        answer["plan"].as_str().unwrap(),
        answer["strands"].as_u64().unwrap() - 1,
    );
    let work = format!("cluster work --plan {plan} --strand 0-{last} --quiet --cache strands");
    let printed = place.tailor(&work, 1);
    assert!(printed.contains("cells of 0.25 mm would need"), "{printed}");
    let again = parsed(&place.tailor(&strands, 0));
    assert_eq!(again["plan"], plan, "it is for the user to give up on them");
    let found = parsed(&place.tailor(&format!("{strands} --after {}", &plan[..12]), 0));
    assert_eq!(found["best"]["set"][0], "hull.voxel_mm=12.0");
    assert_eq!(
        found,
        parsed(&place.tailor(&format!("{search} --cache alone"), 0))
    );
    let printed = place.tailor(&format!("{search} --after {plan}"), 2);
    assert!(printed.contains("--strands"), "{printed}");
}

#[test]
fn a_killed_study_goes_on_and_ends_with_the_same_bytes() {
    let place = Place::new();
    place.tailor("study run hulls --out whole --quiet --cache whole-cache", 0);
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_tailor"));
    command.args(["study", "run", "hulls", "--out", "lab", "--cache", "cache"]);
    command
        .current_dir(place.path(""))
        .stderr(std::process::Stdio::piped());
    let mut child = command.stdout(std::process::Stdio::null()).spawn().unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let first = lines.map(Result::unwrap).find(|l| l.contains("point 2, "));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(first.is_some(), "points are printed as they come");
    assert!(
        !place.path("lab").exists(),
        "a table is written when all of it is there"
    );
    let made = place.tailor("study run hulls --out lab --json", 0);
    assert_eq!(made, "1 study: nothing moved\n");
    for file in ["hulls.md", "hulls.json"] {
        let (whole, lab) = (format!("whole/{file}"), format!("lab/{file}"));
        assert_eq!(place.read(&lab), place.read(&whole), "{file}");
    }
    // What was made before the kill was found: the store made each result once.
    let inner = |folder: std::path::PathBuf| {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries.map(|e| e.unwrap().path())
    };
    let records = |cache: &str| inner(place.path(cache).join("ac")).flat_map(inner).count();
    assert_eq!(records("cache"), records("whole-cache"));
}
