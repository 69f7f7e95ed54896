//! Ctrl-C, kills, and a cache that goes away.

use super::place::{Place, SMALL, signal};
use std::io::{BufRead, BufReader};

/// A body so fine that it takes long, and does not ask whether to stop.
fn fine(cell_mm: &str) -> String {
    SMALL.replace("cell_mm = 40.0", &format!("cell_mm = {cell_mm}"))
}

/// Photos that take seconds, and look between two whether to stop.
const PHOTOS: &str = "goal = \"photos\"\n[node.solid]\nstage = \"synth.solid\"\nwith = { stature_mm = 600.0 }\n\
    [node.body]\nstage = \"synth.body\"\nfrom = [\"solid\"]\nwith = { cell_mm = 12.0 }\n\
    [node.ring]\nstage = \"synth.ring\"\nwith = { views = 12, width = 150, height = 195, distance_mm = 1100.0, \
    camera_mm = 560.0, look_mm = 240.0, disk_mm = 300.0 }\n[node.sway]\nstage = \"synth.sway\"\n\
    from = { cameras = \"ring\" }\nwith = { breast_mm = 440.0 }\n[node.photos]\nstage = \"synth.turn\"\n\
    from = { mesh = \"body\", cameras = \"ring\", sway = \"sway\" }\nwith = { rays = 4 }\n";

#[test]
fn the_first_ctrl_c_drains_and_the_same_command_goes_on() {
    let place = Place::new();
    place.write("photos.toml", PHOTOS);
    let mut child = place.start("run photos.toml --threads 1");
    place.wait_for("photos", "progress");
    signal(&child, "INT");
    let status = child.wait().unwrap();
    let printed = BufReader::new(child.stderr.take().unwrap()).lines();
    let printed: Vec<String> = printed.map(Result::unwrap).collect();
    assert_eq!(status.code(), Some(130), "{printed:?}");
    assert!(
        printed.iter().any(|l| l.starts_with("Stopping.")),
        "{printed:?}"
    );
    assert_eq!(
        printed.last().unwrap(),
        "stopped; run the same command to go on"
    );
    assert!(place.has("photos", "done", "cancelled"));
    place.sound();
    let run = place.run("run photos.toml --json").code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        let status = if node["node"] == "photos" {
            "made"
        } else {
            "found"
        };
        assert_eq!(node["status"], status, "what was done is kept: {node}");
    }
}

#[test]
fn what_comes_to_its_end_after_ctrl_c_is_kept() {
    let place = Place::new();
    place.write("fine.toml", fine("5.0"));
    let mut child = place.start("run fine.toml --threads 1");
    place.wait_for("body", "started");
    signal(&child, "INT");
    child.wait().unwrap();
    assert!(place.has("body", "done", "made"));
    place.sound();
}

#[test]
fn the_second_ctrl_c_stops_at_once() {
    let place = Place::new();
    // Minutes of work, so that it cannot have come to its end.
    place.write("fine.toml", fine("0.5"));
    let mut child = place.start("run fine.toml --threads 1");
    place.wait_for("body", "started");
    signal(&child, "INT");
    let mut printed = BufReader::new(child.stderr.take().unwrap()).lines();
    let reported = |line: String| line.starts_with("Stopping.");
    assert!(
        printed.any(|line| reported(line.unwrap())),
        "it reports that it drains"
    );
    signal(&child, "INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(printed.all(|line| !line.unwrap().contains("stopped")));
    let of_body = |e: &&serde_json::Value| e["node"] == "body" && e["event"] == "done";
    assert_eq!(place.events().iter().filter(of_body).count(), 0);
    place.sound();
    place.run("run small.toml").code(0);
    place.sound();
}

#[test]
fn a_cache_deleted_while_it_is_in_use_loses_nothing_but_the_cache() {
    let place = Place::new();
    place.write("fine.toml", fine("5.0"));
    let mut child = place.start("run fine.toml --threads 1 --out first");
    place.wait_for("body", "started");
    std::fs::remove_dir_all(place.path("cache")).unwrap();
    let code = child.wait().unwrap().code();
    assert!(matches!(code, Some(0 | 1)), "{code:?}: done, or reported");
    place.run("run fine.toml --out second").code(0);
    place.sound();
    let body = |out: &str| std::fs::read(place.path(out).join("body.ply"));
    if code == Some(0) {
        assert_eq!(body("first").unwrap(), body("second").unwrap());
    }
    let run = place.run("run fine.toml --json").code(0).json();
    let nodes = run["nodes"].as_array().unwrap();
    assert!(nodes.iter().all(|n| n["status"] == "found"));
}

#[test]
fn a_killed_program_leaves_nothing_to_unlock_and_keeps_what_is_done() {
    let place = Place::new();
    place.write("fine.toml", fine("0.5"));
    let mut child = place.start("run fine.toml --threads 1");
    place.wait_for("body", "started");
    child.kill().unwrap();
    child.wait().unwrap();
    place.sound();
    let plan = place.run("plan fine.toml --json").code(0).json();
    let run = place.run("run small.toml --json").code(0).json();
    let of = |answer: &serde_json::Value, node: &str, what: &str| {
        let nodes = answer["nodes"].as_array().unwrap();
        let found = nodes.iter().find(|n| n["node"] == node).unwrap();
        found[what].as_str().unwrap().to_owned()
    };
    assert_eq!(of(&plan, "solid", "state"), "cached");
    assert_eq!(of(&plan, "body", "state"), "will run");
    assert_eq!(of(&run, "solid", "status"), "found");
    assert_eq!(of(&run, "body", "status"), "made");
    place.sound();
}

#[test]
fn a_sweep_of_the_cache_stops_when_it_is_asked_to() {
    let place = Place::new();
    let values: Vec<String> = (0..1500)
        .map(|i| format!("{}", 300.0 + f64::from(i) * 0.1))
        .collect();
    let line = format!(
        "sweep small.toml --sweep ring.disk_mm={} --nodes ring --quiet --yes",
        values.join(",")
    );
    place.run(&line).code(0);
    let blobs = || {
        let all = super::privacy::all(&place.path("cache/cas")).into_iter();
        all.filter(|path| path.is_file()).collect::<Vec<_>>()
    };
    let before = blobs().len();
    assert!(before > 1000, "{before}");
    let mut child = place.start("cache gc --max-size 1k --keep-runs 0");
    // As soon as it removes something.
    while blobs().len() == before {
        if child.try_wait().unwrap().is_some() {
            break;
        }
    }
    signal(&child, "TERM");
    let code = child.wait().unwrap().code();
    let left = blobs().len();
    place.sound();
    assert!(code == Some(130) && left > 0, "{code:?}, {left} left");
}
