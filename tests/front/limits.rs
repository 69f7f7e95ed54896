//! Bounds: threads, memory on record, the size of the cache, records of runs.

use super::place::Place;
use std::fs;

#[test]
fn any_number_of_threads_that_somebody_asks_for_is_bound() {
    let place = Place::new();
    place.run("run small.toml --threads 100000").code(0);
    let cores = std::thread::available_parallelism().unwrap().get();
    let options = |threads| tailor::engine::Options {
        cache: place.path("cache"),
        threads: Some(threads),
        keep_going: false,
    };
    assert_eq!(tailor::engine::threads(&options(100_000)), 4 * cores);
    assert_eq!(tailor::engine::threads(&options(1)), 1);
}

fn size(place: &Place) -> u64 {
    let du = place.run("cache du --json").code(0).json();
    du["bytes"].as_u64().unwrap()
}

#[test]
fn a_run_with_a_budget_sweeps_at_its_end_and_keeps_its_own() {
    let place = Place::new();
    for mm in [20, 21, 22, 23] {
        place
            .run(&format!("run small.toml --set body.cell_mm={mm}"))
            .code(0);
    }
    let (before, own) = (size(&place), "run small.toml --set body.cell_mm=40");
    let most = before / 2;
    // What fits is not swept.
    place.run(&format!("{own} --max-size 1G")).code(0);
    assert!(size(&place) > before);
    let printed = place.run(&format!("{own} --max-size {most}")).code(0);
    assert!(printed.err.contains("over its size: "), "{}", printed.err);
    assert!(size(&place) <= most, "{} of {most}", size(&place));
    let run = place.run(&format!("{own} --json")).code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{node}");
    }
    place.sound();
    place.run("run small.toml --max-size lots").code(2);
    place.run("cache gc").code(2);
}

#[test]
fn records_of_runs_are_bound_and_a_run_of_2040_is_not_the_last_for_ever() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let runs = fs::read_dir(place.path("cache/runs")).unwrap();
    let first = runs.map(|e| e.unwrap().file_name().into_string().unwrap());
    let first = first.into_iter().find(|n| n.ends_with(".json")).unwrap();
    let record = fs::read(place.path("cache/runs").join(&first)).unwrap();
    // As clocks that were wrong wrote them.
    for i in 0..500u64 {
        let id = 2_208_988_800_000_000_000 + i;
        place.write(&format!("cache/runs/{id:020}-7.json"), &record);
    }
    place.run("run small.toml --set body.cell_mm=30").code(0);
    let runs = place.run("cache runs --json").code(0).json();
    assert_eq!(runs.as_array().unwrap().len(), 200);
    assert_eq!(runs[0]["made"], 1, "the last is the last: {}", runs[0]);
    let why = place.run("why body small.toml").code(0).out;
    assert!(why.contains("with cell_mm: 30.0 -> 40.0"), "{why}");
}

#[test]
fn a_run_that_is_too_large_for_a_line_is_read_line_by_line() {
    let place = Place::new();
    let mut text = String::from("goal = [");
    for i in 0..2000 {
        text += &format!("\"s{i}\", ");
    }
    text += "]\n";
    for i in 0..2000 {
        let stature = 1000.0 + f64::from(i) / 10.0;
        text += &format!(
            "[node.s{i}]\nstage = \"synth.solid\"\nwith = {{ stature_mm = {stature:?} }}\n"
        );
    }
    place.write("many.toml", text);
    place.run("run many.toml --quiet").code(0);
    place
        .run("run many.toml --quiet --set s7.stature_mm=1500")
        .code(0);
    let why = place.run("why s7 many.toml").code(0).out;
    assert!(why.contains("with stature_mm: 1500.0 -> 1000.7"), "{why}");
    let compared = place.run("compare last last~1").code(0).out;
    assert!(compared.contains("s7"), "{compared}");
    let runs = place.run("cache runs --json").code(0).json();
    assert_eq!(
        (&runs[0]["made"], &runs[1]["made"]),
        (&1.into(), &2000.into())
    );
}
