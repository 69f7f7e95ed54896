//! Results in a user's folder: whole, never through a link, never another's, and what is left is listed.

use super::place::{Place, SMALL};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::symlink;
use std::time::{Duration, SystemTime};

/// A capture of three photos: a run of these nodes reads `photos` and makes masks.
const TURN: &str = "goal = [\"tags\", \"photos\"]\n[input.photos]\nfiles = [\"images/*.jpg\", \"*.jpg\"]\n\
    [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
    [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n";

fn names(folder: std::path::PathBuf) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn run_json(place: &Place, out: &str) -> Value {
    serde_json::from_slice(&fs::read(place.path(out).join("run.json")).unwrap()).unwrap()
}

#[test]
fn what_did_not_change_keeps_its_time_and_what_is_left_is_listed() {
    let place = Place::new();
    let command = "run small.toml --out out";
    place.run(command).code(0);
    let past = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
    let body = place.path("out/body.ply");
    let file = fs::File::options().write(true).open(&body).unwrap();
    file.set_modified(past).unwrap();
    place.write("out/mine.txt", "a user's own");
    // A process that was killed left this.
    place.write("out/.writing-4000000-0-1f", "half");
    place.write("out/.writing-notes", "a user's own");
    let printed = place.run(command).code(0);
    assert!(!printed.err.contains("left from"), "{}", printed.err);
    let time = |path| fs::metadata(path).unwrap().modified().unwrap();
    assert_eq!(time(&body), past);
    assert!(!place.path("out/.writing-4000000-0-1f").exists());
    place
        .run(&format!("{command} --set body.cell_mm=30"))
        .code(0);
    assert_ne!(time(&body), past);
    // One node less: what it wrote is listed, and goes where that is asked for.
    let less = "run small.toml sway --out out";
    let printed = place.run(less).code(0);
    assert!(
        printed.err.contains("--clean removes it): body.ply"),
        "{}",
        printed.err
    );
    assert!(body.exists());
    let printed = place.run(&format!("{less} --clean")).code(0);
    assert!(
        printed.err.contains("removed, of an earlier run: body.ply"),
        "{}",
        printed.err
    );
    let there = [".writing-notes", "mine.txt", "run.json", "sway.artifact"];
    assert_eq!(names(place.path("out")), there);
    // What somebody has changed since is not removed.
    place.run("run small.toml --out out").code(0);
    fs::write(&body, "mine now").unwrap();
    let printed = place.run(&format!("{less} --clean")).code(0);
    assert!(printed.err.contains("changed since"), "{}", printed.err);
    assert_eq!(fs::read(&body).unwrap(), b"mine now");
    place.run("run small.toml --clean").code(2);
}

#[test]
fn nothing_is_written_through_a_link() {
    let place = Place::new();
    place.photos("turn", 3);
    place.write("turn.toml", TURN);
    place.write("victim/body.ply", "precious");
    fs::create_dir(place.path("out")).unwrap();
    symlink("../victim/body.ply", place.path("out/body.ply")).unwrap();
    symlink("../victim", place.path("out/photos")).unwrap();
    place.run("run small.toml --out out").code(0);
    assert!(!place.path("out/body.ply").is_symlink());
    let printed = place.run("run turn.toml --input photos=turn --out out");
    let printed = printed.code(1);
    assert!(
        printed.err.contains("out/photos is a link"),
        "{}",
        printed.err
    );
    assert_eq!(names(place.path("victim")), ["body.ply"]);
    assert_eq!(
        fs::read(place.path("victim/body.ply")).unwrap(),
        b"precious"
    );
    // Nor removed.
    fs::remove_file(place.path("out/photos")).unwrap();
    place
        .run("run turn.toml --input photos=turn --out out")
        .code(0);
    let folder = place.path("out/photos");
    fs::rename(&folder, place.path("moved")).unwrap();
    symlink("../moved", &folder).unwrap();
    place.run("run small.toml --out out --clean").code(0);
    assert_eq!(names(place.path("moved/images")).len(), 3);
}

#[test]
fn a_wrong_folder_for_results_is_refused_before_anything_runs() {
    let place = Place::new();
    place.photos("turn", 3);
    place.photos("deep/images", 3);
    place.write("turn.toml", TURN);
    place.write("file", "x");
    symlink("nowhere", place.path("dangling")).unwrap();
    for (args, expected) in [
        ("run small.toml --out file", "file is no folder"),
        ("run small.toml --out file/below", "file is no folder"),
        ("run small.toml --out dangling", "dangling"),
        (
            "sweep small.toml --sweep body.cell_mm=30,40 --out file",
            "file is no folder",
        ),
        (
            "compare small.toml as-is body.cell_mm=30 --out file",
            "file is no folder",
        ),
        (
            "run turn.toml --input photos=turn --out turn",
            "read as input",
        ),
        (
            "run turn.toml --input photos=deep --out deep/images",
            "read as input",
        ),
        ("measure turn --out turn/masks", "read as input"),
        ("measure turn --out turn/any/where", "read as input"),
    ] {
        let printed = place.run(args).code(2);
        assert!(printed.err.contains(expected), "{args}: {}", printed.err);
        assert!(!place.path("cache").exists(), "{args}");
    }
    place
        .run("run turn.toml --input photos=deep --out deep/out")
        .code(0);
}

#[test]
fn the_results_of_two_captures_do_not_get_into_one_folder_unasked() {
    let place = Place::new();
    for capture in ["p1/scan", "p2/scan"] {
        place.write(&format!("{capture}/letter.txt"), "no photo");
    }
    place.write("p2/scan/0000.jpg", "no photo");
    // Whose a folder is, its run.json shows: here of the first, as `run` writes it.
    place.photos("p1/scan", 3);
    place.write("turn.toml", TURN);
    place
        .run("run turn.toml --input photos=p1/scan --out scan-out")
        .code(0);
    let before = fs::read(place.path("scan-out/run.json")).unwrap();
    let printed = place.run("measure p2/scan").code(2);
    assert!(
        printed
            .err
            .contains("something else than the results of p2/scan"),
        "{}",
        printed.err
    );
    assert!(printed.err.contains("--out"), "{}", printed.err);
    assert_eq!(fs::read(place.path("scan-out/run.json")).unwrap(), before);
    // The same capture, and a folder that somebody names, are no matter: there is another fault.
    fs::rename(place.path("p1/scan/0000.jpg"), place.path("kept.jpg")).unwrap();
    for command in ["measure p1/scan", "measure p2/scan --out scan-out"] {
        let printed = place.run(command);
        assert!(!printed.err.contains("something else"), "{}", printed.err);
    }
    // A folder of a user's own of that name.
    place.write("q/own/0000.jpg", "no photo");
    place.write("own-out/diary.txt", "x");
    let printed = place.run("measure q/own").code(2);
    assert!(printed.err.contains("something else"), "{}", printed.err);
}

#[test]
fn keep_going_writes_what_succeeded() {
    let place = Place::new();
    let broken = "goal = [\"body\", \"loaded\", \"read\"]\n[input.f]\nfiles = \"*.jpg\"\n\
        [node.loaded]\nstage = \"capture.load\"\nfrom = { files = \"@f\" }\n\
        [node.read]\nstage = \"pose.tags\"\nfrom = [\"loaded\"]\n";
    let body = SMALL.split_once("[node.solid]").unwrap().1;
    let body = body.split_once("[node.ring]").unwrap().0;
    place.write("broken.toml", format!("{broken}[node.solid]{body}"));
    place.write("turn/a.jpg", "no photo");
    let command = "run broken.toml --input f=turn --out out";
    place.run(command).code(1);
    assert!(!place.path("out").exists());
    let printed = place.run(&format!("{command} --keep-going")).code(1);
    assert_eq!(names(place.path("out")), ["body.ply", "run.json"]);
    let last = printed.err.lines().rev().take(2).collect::<Vec<_>>();
    assert!(last[0].starts_with("to repeat it: "), "{}", printed.err);
    assert!(last[1].starts_with("loaded failed: "), "{}", printed.err);
    let run = run_json(&place, "out");
    let statuses: Vec<_> = run["nodes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| &n["status"])
        .collect();
    assert!(statuses.contains(&&"failed".into()) && statuses.contains(&&"skipped".into()));
}

#[test]
fn a_node_called_run_does_not_write_over_the_record() {
    let place = Place::new();
    place.write("run.toml", "goal = [\"run\", \"body\"]\n[node.run]\nstage = \"synth.ring\"\n\
        [node.solid]\nstage = \"synth.solid\"\n[node.body]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = 40.0 }\n");
    place.run("run run.toml --out out").code(0);
    assert_eq!(
        names(place.path("out")),
        ["body.ply", "run.json", "run.node.json"]
    );
    let files = run_json(&place, "out")["files"].clone();
    let files: Vec<&String> = files.as_object().unwrap().keys().collect();
    assert_eq!(files, ["body.ply", "run.node.json"]);
}

#[test]
fn two_processes_with_one_folder_end_well() {
    let place = Place::new();
    for round in 0..4 {
        let cells = [40, 30].map(|mm| {
            let command =
                format!("run small.toml --out out --set body.cell_mm={mm} --cache cache{mm}");
            place.start(&command)
        });
        for mut child in cells {
            assert!(child.wait().unwrap().success(), "{round}");
        }
        // Not a mixture: what is there is what run.json tells.
        let run = run_json(&place, "out");
        for (name, hash) in run["files"].as_object().unwrap() {
            let there = fs::read(place.path("out").join(name)).unwrap();
            assert_eq!(
                blake3::hash(&there).to_hex().as_str(),
                hash,
                "{round}: {name}"
            );
        }
        assert_eq!(
            names(place.path("out")),
            ["body.ply", "run.json", "sway.artifact"]
        );
    }
}

#[test]
fn what_is_somebody_elses_is_not_replaced_nor_taken_for_results() {
    let place = Place::sharing();
    place.photos("turn", 12);
    place.photos("another", 12);
    place.write("mine/report.html", "my own");
    place.write("words/notes.txt", "beside");
    place.write("model/body.mtl", "my own");
    for (out, file) in [
        ("another", "another/0000.jpg"),
        ("mine", "mine/report.html"),
        ("model", "model/body.mtl"),
    ] {
        let printed = place
            .run(&format!("measure turn --fast --out {out}"))
            .code(2);
        let wrong = format!("{file} was not written by tailor");
        assert!(printed.err.contains(&wrong), "{}", printed.err);
        assert!(!place.path(out).join("masks").exists());
    }
    // What is read is named before it is used, and an empty folder has no photos.
    place.write("another/masks/0000.png", "x");
    let printed = place.run("measure another --fast --out o").err;
    assert!(printed.contains("masks of its"), "{printed}");
    let printed = place.run("measure turn/0000.jpg turn/0001.jpg").code(2).err;
    assert!(printed.contains("tailor measure turn"), "{printed}");
    let printed = place.run("measure words").code(2).err;
    assert!(
        printed.contains("there are no photos in words"),
        "{printed}"
    );
}
