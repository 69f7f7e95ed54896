//! `--profile`: where a run's time and memory went.

use super::place::Place;
use serde_json::Value;

#[test]
fn a_profile_tells_what_ran_and_nothing_of_what_was_found() {
    let place = Place::new();
    let first = place.run("run small.toml --profile first.json").code(0);
    for reported in ["clock s", "memory MB", "body", "ui.perfetto.dev"] {
        assert!(first.err.contains(reported), "{reported}: {}", first.err);
    }
    let slices = |file: &str| -> Vec<(String, f64)> {
        let trace: Value =
            serde_json::from_slice(&std::fs::read(place.path(file)).unwrap()).unwrap();
        let events = trace["traceEvents"].as_array().unwrap().clone();
        let slices = events.iter().filter(|e| e["ph"] == "X");
        slices
            .map(|e| {
                (
                    e["name"].as_str().unwrap().to_owned(),
                    e["dur"].as_f64().unwrap(),
                )
            })
            .collect()
    };
    let ran = slices("first.json");
    for node in ["solid", "body", "ring", "sway"] {
        assert!(
            ran.iter().any(|(name, us)| name == node && *us >= 0.0),
            "{ran:?}"
        );
    }
    let again = place.run("run small.toml --profile again.json").code(0);
    assert!(again.err.contains("nothing ran"), "{}", again.err);
    assert_eq!(slices("again.json"), []);
    let quiet = place
        .run("run small.toml --quiet --profile again.json")
        .code(0);
    assert_eq!(quiet.err, "");
    let bad = place
        .run("run small.toml --profile no/such/place.json")
        .code(2);
    assert!(bad.err.contains("no/such/place.json"), "{}", bad.err);
    let many = place.run("measure a b --profile x.json").code(2);
    assert!(many.err.contains("give one folder"), "{}", many.err);
}
