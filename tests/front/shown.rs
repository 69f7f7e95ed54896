//! What is shown where no output is chosen, how a run ends, and which length of a girth is printed.

use super::place::{Place, SMALL};

/// The doll with its girths.
const GIRTHS: &str = "[node.features]\nstage = \"measure.body\"\nfrom = { mesh = \"body\" }\n\
    [node.landmarks]\nstage = \"measure.landmarks\"\nfrom = { mesh = \"body\", features = \"features\" }\n\
    [node.girths]\nstage = \"measure.girths\"\nfrom = { mesh = \"body\", features = \"features\", landmarks = \"landmarks\" }\n";

/// A pipeline that makes girths of a doll within a second.
fn doll() -> String {
    let finer = SMALL.replace("40.0", "14.0");
    finer.replace("\"sway\", \"body\"", "\"sway\", \"girths\"") + GIRTHS
}

#[test]
fn what_is_shown_without_a_place_is_printed_or_written_under_its_nodes_name() {
    let place = Place::new();
    place.write("doll.toml", doll());
    place.run("run doll.toml --out out").code(0);
    let show = |args: &str| place.run(&format!("show {args} --pipeline doll.toml"));
    let csv = show("girths --as csv").code(0).out;
    assert!(
        csv.starts_with("name,label,tape_cm") && csv.contains("\nWC,"),
        "{csv}"
    );
    let json = show("girths").code(0).out;
    assert_eq!(
        json.as_bytes(),
        std::fs::read(place.path("out/girths.json")).unwrap()
    );
    // What nobody reads on a terminal is a file, and its name is the answer.
    assert_eq!(show("body").code(0).out, "body.ply\n");
    assert_eq!(show("body --as views").code(0).out, "body.jpg\n");
    assert_eq!(show("body --as obj").code(0).out, "body\n");
    assert!(place.path("body/body.obj").exists() || place.path("body").is_dir());
    // The same again is no matter; nothing else is written over unasked.
    assert_eq!(show("body").code(0).out, "body.ply\n");
    place.write("body.ply", "mine");
    let printed = show("body").code(2).err;
    assert!(
        printed.contains("body.ply is there already") && printed.contains("-o"),
        "{printed}"
    );
    assert!(
        show("body --as obj")
            .code(2)
            .err
            .contains("body is there already")
    );
    show("body -o body.ply").code(0);
    assert_ne!(std::fs::read(place.path("body.ply")).unwrap(), b"mine");
    let files = show("girths --as csv --json").code(0).json();
    assert_eq!(files["files"][0]["file"], "girths.csv");
    // A terminal is no place for a picture.
    let exe = env!("CARGO_BIN_EXE_tailor");
    if proof::program("script", "script") {
        let line = format!("script -qec '{exe} show body --pipeline doll.toml -o -' /dev/null");
        let printed = place.bash(&line);
        assert!(
            printed.out.contains("no text for a terminal"),
            "{}",
            printed.out
        );
    }
}

#[test]
fn what_was_otherwise_in_the_run_that_made_it_is_named() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let show = || {
        place
            .run("show body --pipeline small.toml -o body.ply")
            .code(0)
    };
    assert_eq!(show().err, "");
    let runs = std::fs::read_dir(place.path("cache/runs")).unwrap();
    let mut paths = runs.map(|entry| entry.unwrap().path());
    let run = paths
        .find(|path| path.extension().is_some_and(|e| e == "json"))
        .unwrap();
    let record = std::fs::read_to_string(&run).unwrap();
    let stage = "[\"stage\",\"synth.body v";
    assert_eq!(record.matches(stage).count(), 1, "{record}");
    std::fs::write(&run, record.replace(stage, &format!("{stage}9"))).unwrap();
    let named = show().err;
    assert!(
        named.contains("the stage of `body` was synth.body v9"),
        "{named}"
    );
    // So is an edited pipeline's param; a value that is asked for is found, the default's, too.
    let place = Place::new();
    place.run("run small.toml").code(0);
    let coarse = SMALL.replace("cell_mm = 40.0", "cell_mm = 50.0");
    place.write("small.toml", &coarse);
    let show = |more: &str| {
        place.run(&format!(
            "show body --pipeline small.toml -o body.ply {more}"
        ))
    };
    let named = show("").code(0).err;
    let was = "body is of an earlier run, in which body.cell_mm was 40.0 and would be 50.0;";
    assert!(named.starts_with(was), "{named}");
    assert_eq!(show("--set body.cell_mm=40").code(0).err, "");
    let none = show("--set body.cell_mm=50").code(2).err;
    assert!(none.contains("with these changes"), "{none}");
}

#[test]
fn a_girth_is_its_tape_wherever_it_is_asked_for() {
    let place = Place::new();
    place.write("doll.toml", doll());
    let asked = "--over body.cell_mm=14 --tell girths.WC --tell girths.WC.contour";
    let swept = place.run(&format!("sweep doll.toml {asked} --json"));
    let swept = swept.code(0).json();
    let [tape, contour] =
        [0, 1].map(|i| swept["points"][0]["metrics"][i]["value"].as_f64().unwrap());
    let girths = place.run("show girths --pipeline doll.toml").code(0).json();
    let all = girths["girths"].as_array().unwrap();
    let waist = all.iter().find(|g| g["name"] == "WC").unwrap();
    for (reported, key) in [(tape, "tape_cm"), (contour, "cm")] {
        assert!(
            (reported - waist[key].as_f64().unwrap()).abs() < 0.006,
            "{reported}: {waist}"
        );
    }
    assert!(contour > tape + 0.1, "{contour} {tape}");
    let head = place.run(&format!("sweep doll.toml {asked}")).code(0).out;
    assert!(
        head.contains("girths.WC cm tape  girths.WC.contour cm"),
        "{head}"
    );
}

#[test]
fn a_run_ends_with_its_girths_its_warnings_and_its_folder() {
    let place = Place::new();
    place.write("doll.toml", doll());
    let printed = place.run("run doll.toml --out out").code(0);
    let warned = printed.err.matches("        warning: ").count();
    assert!(warned > 1, "{}", printed.err);
    let lines: Vec<&str> = printed.out.lines().collect();
    assert!(
        lines[0].starts_with("girth ") && lines[0].contains("tape cm"),
        "{}",
        printed.out
    );
    let at = |line: &str| lines.iter().position(|l| *l == line);
    let counted = at(&format!("{warned} warnings")).expect(&printed.out);
    assert!(
        lines[counted + 1].starts_with("  landmarks: "),
        "{}",
        printed.out
    );
    assert_eq!(
        at("all files: out"),
        Some(lines.len() - 1),
        "{}",
        printed.out
    );
    // Without girths there is the folder alone, in JSON the record alone.
    let printed = place.run("run small.toml --out small").code(0);
    assert_eq!(printed.out, "all files: small\n");
    place.run("run doll.toml --json").code(0).json();
}
