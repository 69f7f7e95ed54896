//! The report: equal results give equal bytes, however long its stages took.

use super::place::Place;
use std::fs;

/// A doll by formula, its photos and the report on it.
const REPORTED: &str = "goal = \"report\"\n\
    [node.solid]\nstage = \"synth.solid\"\n\
    [node.body]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = 40.0 }\n\
    [node.ring]\nstage = \"synth.ring\"\nwith = { views = 4, width = 160, height = 240 }\n\
    [node.photos]\nstage = \"synth.turn\"\nfrom = { mesh = \"body\", cameras = \"ring\" }\n\
    [node.masks]\nstage = \"synth.masks\"\nfrom = { mesh = \"body\", cameras = \"ring\" }\n\
    [node.girths]\nstage = \"synth.girths\"\nfrom = { solid = \"solid\" }\n\
    [node.report]\nstage = \"report.html\"\n\
    from = { photos = \"photos\", masks = \"masks\", cameras = \"ring\", body = \"body\", girths = \"girths\" }\n";

#[test]
fn a_report_does_not_tell_how_long_its_stages_took() {
    let place = Place::new();
    place.write("reported.toml", REPORTED);
    let run = |cache: &str, threads: usize| {
        let out = format!("{cache}-{threads}");
        let command = format!("run reported.toml --out {out} --cache {cache} --threads {threads}");
        place.run(&command).code(0);
        let file = |name: &str| fs::read(place.path(&out).join(name)).unwrap();
        let run: serde_json::Value = serde_json::from_slice(&file("run.json")).unwrap();
        let nodes = run["nodes"].as_array().unwrap();
        let seconds: Vec<f64> = nodes
            .iter()
            .map(|n| n["seconds"].as_f64().unwrap())
            .collect();
        (file("report.html"), seconds)
    };
    let (first, seconds) = run("a", 1);
    assert!(first.len() > 10_000 && seconds.len() == 7);
    let page = String::from_utf8_lossy(&first);
    assert!(
        page.contains("id=\"provenance\""),
        "what the run adds is there"
    );
    let (again, seconds_again) = run("b", 2);
    // Clocks count nanoseconds: two runs of seven stages never take as long.
    assert_ne!(seconds, seconds_again);
    assert!(first == again, "other times and threads, another report");
    let (found, _) = run("b", 3);
    assert!(first == found, "found, another report");
}
