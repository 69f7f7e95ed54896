//! What nobody else may see: what is forgotten is gone, what is private was never there.

use super::place::{Place, SMALL};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

pub(crate) const TURN: &str = "goal = \"tags\"\n[input.photos]\nfiles = \"*.jpg\"\n\
    [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
    [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n";

/// Every file and folder below one.
pub(crate) fn all(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![folder.to_owned()];
    let mut at = 0;
    while at < found.len() {
        for entry in fs::read_dir(&found[at]).into_iter().flatten() {
            found.push(entry.unwrap().path());
        }
        at += 1;
    }
    found
}

/// Whether a file of the cache holds these bytes.
pub(crate) fn holds(place: &Place, bytes: &[u8]) -> bool {
    let has = |path: &PathBuf| {
        let file = fs::read(path).unwrap_or_default();
        file.windows(bytes.len()).any(|w| w == bytes)
    };
    all(&place.path("cache")).iter().any(has)
}

#[test]
fn what_is_forgotten_is_gone_and_the_rest_stays() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    for (folder, count) in [("anna", 3), ("bert", 4), ("anna-too", 3)] {
        place.photos(folder, count);
        place
            .run(&format!("run turn.toml --input photos={folder}"))
            .code(0);
        place
            .run(&format!("run turn.toml --input photos={folder}"))
            .code(0);
    }
    place.run("run small.toml").code(0);
    place.run("cache pin talk").code(0);
    let photo = fs::read(place.path("anna/0000.jpg")).unwrap();
    let inner = &photo[2000..2400];
    assert!(holds(&place, inner) && holds(&place, b"/anna\""));
    // The same photos are elsewhere: reported, and gone all the same.
    let printed = place.run("cache forget anna --json").code(0).json();
    assert_eq!(
        (&printed["runs"], &printed["results"]),
        (&2.into(), &2.into()),
        "{printed}"
    );
    let shared = printed["shared"].as_array().unwrap();
    let reported = |f: &serde_json::Value| f.as_str().unwrap().ends_with("/anna-too");
    assert!(shared.iter().any(reported), "{printed}");
    assert!(!holds(&place, b"/anna\"") && !holds(&place, b"/anna/"));
    place.run("cache forget anna-too").code(0);
    place.run("cache forget bert").code(0);
    assert!(!holds(&place, inner));
    for name in [&b"/anna"[..], b"/bert"] {
        assert!(!holds(&place, name), "{}", String::from_utf8_lossy(name));
    }
    let run = place.run("run small.toml --json").code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{node}");
    }
    assert!(place.run("cache pins").code(0).out.starts_with("talk"));
    place.sound();
    // A folder that is gone is forgotten as well.
    place.run("run turn.toml --input photos=bert").code(0);
    fs::remove_dir_all(place.path("bert")).unwrap();
    place.run("cache forget bert").code(0);
    assert!(!holds(&place, b"/bert"));
}

#[test]
fn a_private_run_leaves_its_results_and_nothing_else() {
    let place = Place::new();
    fs::create_dir(place.path("tmp")).unwrap();
    // Of a process that was killed.
    place.write("tmp/private-cache-4000000-x/cas/ab", "x");
    place.write("tmp/private-cache-notes", "mine");
    let private = |args: &str| {
        let line = format!("TMPDIR=tmp exec {} {args}", env!("CARGO_BIN_EXE_tailor"));
        place.bash(&line)
    };
    private("run small.toml --private --out out").code(0);
    assert!(place.path("out/body.ply").exists());
    assert!(!place.path("cache").exists());
    let left: Vec<_> = fs::read_dir(place.path("tmp")).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
    place.write("torn.toml", SMALL.replace("synth.solid", "synth.sollid"));
    private("run torn.toml --private").code(2);
    assert_eq!(fs::read_dir(place.path("tmp")).unwrap().count(), 1);
}

#[test]
fn all_that_the_cache_holds_is_for_its_owner_only() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("turn", 3);
    place
        .run("run turn.toml --input photos=turn --out out")
        .code(0);
    for path in all(&place.path("cache"))
        .into_iter()
        .chain(all(&place.path("out")))
    {
        let mode = fs::metadata(&path).unwrap().permissions().mode();
        assert_eq!(mode & 0o077, 0, "{}: {mode:o}", path.display());
    }
}

#[test]
fn who_is_measured_is_in_no_key_but_of_what_asks_for_it() {
    let place = Place::new();
    let asks = "goal = [\"tags\", \"person\"]\n[input.photos]\nfiles = [\"*.jpg\", \"capture.toml\"]\n\
        [node.photos]\nstage = \"capture.load\"\nfrom = { files = \"@photos\" }\n\
        [node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n\
        [node.person]\nstage = \"capture.person\"\nfrom = { files = \"@photos\" }\n";
    place.write("turn.toml", asks);
    place.photos("anna", 3);
    let became = |more: &str| {
        let line = format!("run turn.toml --input photos=anna --json {more}");
        let run = place.run(&line).code(0).json();
        ["photos", "tags", "person"].map(|name| {
            let nodes = run["nodes"].as_array().unwrap();
            let node = nodes.iter().find(|n| n["node"] == name).unwrap();
            node["status"].as_str().unwrap().to_owned()
        })
    };
    assert_eq!(became(""), ["made", "made", "made"]);
    let sex = "--set person.facts.subject.sex=female";
    assert_eq!(became(sex), ["found", "found", "made"]);
    // The file itself is read again; what it has about a person stays out of the photos.
    place.write("anna/capture.toml", "[subject]\nage_years = 9.5\n");
    assert_eq!(became(""), ["made", "found", "made"]);
    place.write("anna/capture.toml", "[subject]\nage_years = 10.5\n");
    assert_eq!(became(""), ["made", "found", "made"]);
    let rest = "name = \"Anna\"\ndate = 2026-05-01\n[subject]\nweight_kg = 64\n";
    place.write("anna/capture.toml", rest);
    assert_eq!(became(""), ["made", "found", "made"]);
    place.write("anna/capture.toml", "[subject]\nage_years = 1050\n");
    let printed = place.run("run turn.toml --input photos=anna").code(1).err;
    assert!(
        printed.contains("`subject.age_years` wants a number from 0 to 130"),
        "{printed}"
    );
}

/// A place with a turn that was run into a folder of results.
fn run_into(out: &str) -> Place {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("anna", 3);
    let run = format!("run turn.toml photos tags --input photos=anna --out {out}");
    place.run(&run).code(0);
    place
}

#[test]
fn forget_names_the_folders_of_results_that_stay_and_removes_what_is_theirs() {
    let place = run_into("far/results");
    let photo = place.path("far/results/photos/images/0000.jpg");
    assert!(photo.exists());
    let printed = place.run("cache forget anna").code(0).out;
    for expected in ["far/results", "--out"] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    assert!(photo.exists(), "named, not removed");
    assert!(!holds(&place, b"/anna") && !holds(&place, b"far/results"));
    // Now that nothing else is known of the capture; a file that is somebody else's stays, and links are not followed.
    place.write("far/results/notes.txt", "mine");
    place.write("other/0001.jpg", "mine, too");
    fs::remove_file(place.path("far/results/photos/images/0001.jpg")).unwrap();
    let link = place.path("far/results/photos/images/0001.jpg");
    std::os::unix::fs::symlink(place.path("other/0001.jpg"), &link).unwrap();
    let printed = place.run("cache forget anna --out far/results").code(0).out;
    assert!(
        !photo.exists() && !place.path("far/results/run.json").exists(),
        "{printed}"
    );
    assert!(
        printed.contains("notes.txt") && printed.contains("0001.jpg"),
        "{printed}"
    );
    assert!(place.path("far/results/notes.txt").exists());
    assert!(place.path("other/0001.jpg").exists());
}

#[test]
fn the_folder_of_a_sweep_is_named_and_removed_as_that_of_a_run() {
    let place = Place::new();
    place.write("turn.toml", TURN);
    place.photos("anna", 3);
    let sweep = "sweep turn.toml --input photos=anna --sweep tags.most=1,2 --out far/tables";
    place.run(sweep).code(0);
    let table = place.path("far/tables/sweep.csv");
    assert!(table.exists());
    let printed = place.run("cache forget anna").code(0).out;
    assert!(
        printed.contains("far/tables") && table.exists(),
        "{printed}"
    );
    let printed = place.run("cache forget anna --out far/tables").code(0).out;
    assert!(!place.path("far/tables").exists(), "{printed}");
    // A later sweep reports what an earlier one left.
    place
        .run("run turn.toml --input photos=anna --out far/tables")
        .code(0);
    let printed = place.run(sweep).code(0).err;
    assert!(
        printed.contains("left from an earlier run") && printed.contains("tags.json"),
        "{printed}"
    );
}

#[test]
fn forget_removes_no_results_of_another_capture() {
    let place = run_into("results");
    place.photos("bert", 4);
    place
        .run("run turn.toml --input photos=bert --out theirs")
        .code(0);
    for out in ["theirs", "bert", "nowhere"] {
        let printed = place
            .run(&format!("cache forget anna --out {out}"))
            .code(2)
            .err;
        assert!(printed.contains(out), "{printed}");
    }
    assert!(place.path("theirs/run.json").exists());
    let photo = fs::read(place.path("anna/0000.jpg")).unwrap();
    assert!(
        holds(&place, &photo[2000..2400]),
        "nothing goes if one word is wrong"
    );
    let printed = place
        .run("cache forget anna --out results --json")
        .code(0)
        .json();
    assert_eq!(printed["outs"], serde_json::json!([]), "{printed}");
    assert!(!place.path("results").exists(), "{printed}");
}

#[test]
fn forget_finds_the_folder_beside_a_capture_by_itself() {
    // Of a program that noted no folders, or of a cache that is gone.
    let place = run_into("anna-out");
    fs::remove_dir_all(place.path("cache")).unwrap();
    place.run("run turn.toml --input photos=anna").code(0);
    let printed = place.run("cache forget anna --json").code(0).json();
    let outs = printed["outs"].as_array().unwrap();
    assert!(
        outs.len() == 1 && outs[0].as_str().unwrap().ends_with("anna-out"),
        "{printed}"
    );
}

#[test]
fn nothing_to_forget_is_not_a_success() {
    let place = run_into("results");
    let printed = place.run("cache forget ana").code(1).err;
    assert!(
        printed.contains("ana") && printed.contains("--cache"),
        "{printed}"
    );
    place.run("cache forget anna").code(0);
    place.run("cache forget anna").code(1);
}

#[test]
fn the_log_of_a_killed_run_goes_too() {
    let place = run_into("results");
    let log = "cache/runs/00000000000000000009-1.jsonl";
    place.write(log, "{\"event\":\"started\",\"node\":\"photos\"}\n");
    place.run("cache forget anna").code(0);
    assert!(!place.path(log).exists());
}
