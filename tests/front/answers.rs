//! Answers: what would run and why, drawings, the store, all of it in JSON too.

use super::place::{Place, SMALL};
use serde_json::Value;

fn states(plan: &Value) -> Vec<(String, String)> {
    let nodes = plan["nodes"].as_array().unwrap();
    let text = |v: &Value| v.as_str().unwrap().to_owned();
    let mut states: Vec<_> = nodes
        .iter()
        .map(|n| (text(&n["node"]), text(&n["state"])))
        .collect();
    states.sort();
    states
}

fn pairs(all: [(&str, &str); 4]) -> Vec<(String, String)> {
    all.map(|(a, b)| (a.into(), b.into())).to_vec()
}

#[test]
fn plan_and_why_tell_old_and_new_back_to_the_root_cause() {
    let place = Place::new();
    let plan = place.run("plan small.toml").code(0).out;
    assert!(plan.contains("will run  solid"), "{plan}");
    assert!(plan.contains("4 nodes have never run here"), "{plan}");
    place.run("run small.toml").code(0);
    let plan = place.run("plan small.toml --json").code(0).json();
    let cached = [
        ("body", "cached"),
        ("ring", "cached"),
        ("solid", "cached"),
        ("sway", "cached"),
    ];
    assert_eq!(states(&plan), pairs(cached));
    let change = "--set solid.stature_mm=1500 --json";
    let plan = place
        .run(&format!("plan small.toml {change}"))
        .code(0)
        .json();
    let stale = [
        ("body", "may run"),
        ("ring", "cached"),
        ("solid", "will run"),
        ("sway", "cached"),
    ];
    assert_eq!(states(&plan), pairs(stale));
    assert!(
        plan["will_seconds"].as_f64().unwrap() > 0.0,
        "history tells how long"
    );
    let why = place
        .run(&format!("why body small.toml {change}"))
        .code(0)
        .json();
    assert_eq!(why["chain"][0]["node"], "body");
    assert_eq!(why["chain"][1]["node"], "solid");
    let line = &why["chain"][1]["changes"][0];
    assert_eq!(line[0], "with stature_mm");
    assert_eq!(line[2], "1500.0");
    let text = place
        .run("why body small.toml --set solid.stature_mm=1500")
        .code(0)
        .out;
    assert!(text.contains("with stature_mm: 1750.0 -> 1500.0"), "{text}");
    // Once it has run, `why` explains why it ran.
    place
        .run("run small.toml --set solid.stature_mm=1500")
        .code(0);
    let why = place
        .run(&format!("why body small.toml {change}"))
        .code(0)
        .json();
    assert_eq!(why["chain"][0]["state"], "cached");
    assert_eq!(why["chain"][0]["changes"][0][0], "from solid");
    assert_eq!(why["chain"][1]["changes"][0][0], "with stature_mm");
}

#[test]
fn a_drawing_is_coloured_by_state() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let change = "--set body.cell_mm=30";
    for format in ["dot", "mermaid"] {
        let drawn = place
            .run(&format!("graph small.toml --as {format} {change}"))
            .code(0)
            .out;
        let count = |color: &str| drawn.matches(color).count();
        assert_eq!(
            (count("#b7e4c7"), count("#ffb4a2")),
            (3, 1),
            "{format}: {drawn}"
        );
    }
    let json = place
        .run(&format!("graph small.toml --json {change}"))
        .code(0)
        .json();
    let nodes = json["nodes"].as_array().unwrap();
    let body = nodes.iter().find(|n| n["node"] == "body").unwrap();
    assert_eq!(body["state"], "will run");
    assert_eq!(body["from"]["solid"], "solid");
}

#[test]
fn every_answer_comes_in_json() {
    let place = Place::new();
    let sweep = "[sweep.cells]\nover.body = { cell_mm = [40.0, 30.0] }\ntell = [\"body.volume\"]\n\
        [variant.rough]\nwith.body = { cell_mm = 45.0 }\n";
    place.write("more.toml", SMALL.to_owned() + sweep);
    for args in [
        "check more.toml",
        "stages",
        "stages synth.body",
        "stages --json-schema",
        "plan more.toml",
        "run more.toml",
        "run more.toml --verify",
        "why body more.toml",
        "graph more.toml",
        "show body --pipeline more.toml -o body.ply",
        "sweep more.toml cells",
        "compare more.toml as-is rough",
        "compare last last~1",
        "impact more.toml body.cell_mm",
        "mat --diameter-mm 600 -o mat.svg",
        "cache ls",
        "cache du",
        "cache runs",
        "cache pin talk",
        "cache pins",
        "cache unpin talk",
        "cache gc --max-size 1G",
        "cache verify",
    ] {
        let answer = place.run(&format!("{args} --json")).code(0);
        answer.json();
        assert_eq!(answer.err, "", "{args} --json is for programs");
    }
    place.write(
        "thin.toml",
        SMALL.replace("40.0", "50.0").replace(
            "synth.solid\"",
            "synth.solid\"\nwith = { stature_mm = 300.0 }",
        ),
    );
    for (args, code) in [("run more.toml nobody", 2), ("check absent.toml", 2)] {
        let answer = place.run(&format!("{args} --json")).code(code).json();
        assert_eq!(answer["code"], code);
        assert!(answer["error"].is_string());
    }
}

#[test]
fn runs_are_recorded_with_provenance_and_an_event_log_and_pins_hold() {
    let place = Place::new();
    place.run("run small.toml --out out").code(0);
    let record = std::fs::read(place.path("out/run.json")).unwrap();
    let record: Value = serde_json::from_slice(&record).unwrap();
    for node in record["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "made");
        assert_eq!(node["key"].as_str().unwrap().len(), 64);
        assert!(!node["provenance"].as_array().unwrap().is_empty());
    }
    for node in ["solid", "body", "ring", "sway"] {
        assert!(place.has(node, "done", "made"), "{node}");
    }
    place.run("cache pin first").code(0);
    place.run("run small.toml --set body.cell_mm=30").code(0);
    let runs = place.run("cache runs --json").code(0).json();
    assert_eq!(
        (&runs[0]["made"], &runs[0]["found"]),
        (&1.into(), &3.into())
    );
    assert_eq!(runs[1]["made"], 4);
    let gc = "cache gc --max-size 0 --keep-runs 0 --keep-records 1";
    let dry = place.run(&format!("{gc} --dry-run --json")).code(0).json();
    let done = place.run(&format!("{gc} --json")).code(0).json();
    assert_eq!(
        (&dry["removed"], &dry["bytes"]),
        (&done["removed"], &done["bytes"])
    );
    assert_eq!(done["removed"], 1, "the body that is not pinned");
    let again = place.run("run small.toml --json").code(0).json();
    let nodes = again["nodes"].as_array().unwrap();
    assert!(
        nodes.iter().all(|n| n["status"] == "found"),
        "what is pinned stays"
    );
    let pins = place.run("cache pins").code(0).out;
    assert!(pins.starts_with("first "), "{pins}");
    place.run("compare first last").code(0);
    place.run("cache pin ../../up").code(2);
    place.run("cache pin other 000-1").code(2);
    place.run("cache unpin nobody").code(2);
    place.run("cache unpin first").code(0);
    place.sound();
}

#[test]
fn who_does_not_listen_does_no_harm_and_a_lost_answer_is_reported() {
    let place = Place::new();
    place.run_into_full("2", "run small.toml").code(0);
    let printed = place.run_into_full("1", "plan small.toml").code(1);
    assert!(
        printed.err.contains("could not be written"),
        "{}",
        printed.err
    );
}

#[test]
fn lines_are_plain_where_nobody_looks_and_quiet_is_quiet() {
    let place = Place::new();
    let printed = place.run("run small.toml").code(0);
    assert_eq!(printed.out, "");
    assert!(!printed.err.contains(['\r', '\u{1b}']), "{:?}", printed.err);
    assert_eq!(
        printed
            .err
            .lines()
            .filter(|l| l.contains("made in"))
            .count(),
        4
    );
    let printed = place
        .run("run small.toml --quiet --set body.cell_mm=30")
        .code(0);
    assert_eq!((printed.out, printed.err), (String::new(), String::new()));
}

#[test]
fn what_is_shown_is_of_the_folder_that_is_given() {
    let place = Place::new();
    place.write(
        "two.toml",
        "goal = [\"tags\"]\n[input.photos]\nfiles = [\"*.jpg\", \"capture.toml\"]\n\
         [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
         [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n",
    );
    for (folder, count) in [("three", 3), ("four", 4)] {
        place.photos(folder, count);
        let mat = "[mat]\ntag_size_mm = 60.0\nring_radius_mm = 187.0\ncount = 12\nids = [0, 11]\n";
        place.write(&format!("{folder}/capture.toml"), mat);
        place
            .run(&format!("run two.toml --input photos={folder}"))
            .code(0);
    }
    place.photos("five", 5);
    let shown = |args: &str| {
        place.run(&format!("show {args} -o shown")).code(0);
        let photos = std::fs::read_dir(place.path("shown/images"))
            .unwrap()
            .count();
        std::fs::remove_dir_all(place.path("shown")).unwrap();
        photos
    };
    assert_eq!(shown("photos --pipeline two.toml"), 4, "the newest");
    for (folder, count) in [("three", 3), ("four", 4)] {
        let of = format!("--input photos={folder}");
        assert_eq!(shown(&format!("photos --pipeline two.toml {of}")), count);
        assert_eq!(shown(&format!("photos {of}")), count, "of `measure`");
        let tags = place.run(&format!("show tags --pipeline two.toml {of} -o tags.json"));
        tags.code(0);
        let tags = std::fs::read(place.path("tags.json")).unwrap();
        let tags: Value = serde_json::from_slice(&tags).unwrap();
        assert_eq!(tags.as_array().unwrap().len(), count);
        let printed = format!("show tags --pipeline two.toml {of} -o -");
        assert_eq!(place.run(&printed).code(0).json(), tags, "standard output");
    }
    let several = place.run("show photos --pipeline two.toml -o -").code(2);
    assert!(several.err.contains("several files"), "{}", several.err);
    assert!(!place.path("-").exists());
    let never = place
        .run("show tags --pipeline two.toml --input photos=five -o x")
        .code(2);
    assert!(never.err.contains("`tags` of this input"), "{}", never.err);
    place.run("show tags --input photo=four -o x").code(2);
    place.run("show tags --input photos=none -o x").code(2);
}
