//! `tailor work`, as any cluster starts it: in any order within a layer, twice, killed and again.

use super::place::Place;
use std::process::Stdio;

const CELLS: &str = "50,45,40";

#[test]
fn processes_make_each_strand_once_and_come_to_what_one_sweep_does() {
    let place = Place::new();
    let (plan, strands) = place.plan(CELLS);
    assert_eq!(strands, 4, "what all share, and one a point");
    let work = |strand: &str| place.run(&["work", "--plan", &plan, "--strand", strand]);
    let early = work("2");
    let stderr = String::from_utf8_lossy(&early.stderr).into_owned();
    assert_eq!(early.status.code(), Some(1), "{stderr}");
    assert!(
        stderr.contains("which strand 0 has not made yet"),
        "{stderr}"
    );
    assert!(work("0").status.success());
    // Two processes on the same strands, and one on all: side by side.
    let all = ["1-3", "3,2,1", "0-3"].map(|strands| {
        let mut command = place.tailor(&["work", "--plan", &plan, "--strand", strands, "--quiet"]);
        command.stderr(Stdio::piped()).spawn().unwrap()
    });
    for child in all {
        let ended = child.wait_with_output().unwrap();
        let stderr = String::from_utf8_lossy(&ended.stderr);
        assert!(ended.status.success(), "{stderr}");
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
fn what_cannot_be_worked_on_is_refused() {
    let place = Place::new();
    let (plan, _) = place.plan("50");
    for (arguments, code, part) in [
        (
            vec!["--plan", "abcdef", "--strand", "0"],
            2,
            "there is no plan abcdef",
        ),
        (vec!["--plan", &plan, "--strand", "x"], 2, "give 3, or 0-63"),
        (
            vec!["--plan", &plan, "--strand", "3-1"],
            2,
            "give 3, or 0-63",
        ),
        (
            vec!["--plan", &plan, "--strand", "9"],
            1,
            "strand 9 is not in the plan, which has 1",
        ),
    ] {
        let ran = place.run(&[&["work"], &arguments[..]].concat());
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(code), "{arguments:?}: {stderr}");
        assert!(stderr.contains(part), "{stderr}");
    }
}

/// Reads a folder; fails where it holds thirteen.
const READER: &str = r#"goal = "x"
[input.src]
files = "*.txt"
[node.x]
stage = "exec"
out = "document"
from = { src = "@src" }
command = ["sh", "-c", "cat $2/a.txt > $1/a.txt; ! grep -q 13 $1/a.txt", "sh", "{out}", "{from.src}"]
"#;

#[test]
fn a_cohort_is_a_strand_a_folder_and_one_that_fails_fails_alone() {
    let place = Place::new();
    std::fs::write(place.path("x.toml"), READER).unwrap();
    // Two folders with equal files are two strands, and one result.
    for (folder, text) in [("p1", "one"), ("p2", "13"), ("p10", "ten"), ("p11", "one")] {
        let folder = place.path("all").join(folder);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("a.txt"), text).unwrap();
    }
    let (file, all) = (place.path("x.toml"), place.path("all"));
    let (file, each) = (file.display().to_string(), format!("src={}", all.display()));
    let answer = place.json(&["plan", &file, "--strands", "--each", &each, "--allow-exec"]);
    assert_eq!(
        (&answer["points"], &answer["strands"]),
        (&4.into(), &4.into()),
        "{answer}"
    );
    let plan = answer["plan"].as_str().unwrap();
    let worked = place.json(&["work", "--plan", plan, "--strand", "0-3"]);
    let whys: Vec<bool> = worked["strands"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["why"].is_null())
        .collect();
    assert_eq!(
        whys,
        [true, false, true, true],
        "in natural order of their names: {worked}"
    );
    assert_eq!(place.made(), 2, "equal files have one result");
    // A run of one of them finds what its strand made.
    let input = format!("src={}", all.join("p10").display());
    let run = place.json(&["run", &file, "--input", &input]);
    assert_eq!(run["nodes"][0]["status"], "found", "{run}");
    for (each, part) in [
        ("src", "give NAME=FOLDER"),
        ("src=nowhere", "No such file"),
        ("other=all", "No such file"),
    ] {
        let ran = place.run(&["plan", &file, "--strands", "--each", each]);
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(2));
        assert!(stderr.contains(part), "{stderr}");
    }
    std::fs::create_dir(all.join("p3")).unwrap();
    let ran = place.run(&["plan", &file, "--strands", "--each", &each]);
    let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert_eq!(ran.status.code(), Some(2));
    assert!(stderr.contains("p3 has no file that fits"), "{stderr}");
}

#[test]
fn work_lets_programs_run_that_are_allowed_and_none_without_the_sandbox_that_is_chosen() {
    let place = Place::new();
    std::fs::write(place.path("x.toml"), READER).unwrap();
    std::fs::create_dir_all(place.path("src")).unwrap();
    std::fs::write(place.path("src/a.txt"), "one").unwrap();
    let (file, src) = (place.path("x.toml"), place.path("src"));
    let (file, src) = (file.display().to_string(), format!("src={}", src.display()));
    let words = ["plan", &file, "--strands", "--input", &src, "--allow-exec"];
    let answer = place.json(&words);
    let plan = answer["plan"].as_str().unwrap();
    let work = |more: &[&str], variable: &str, value: &std::path::Path| {
        let words = [&["work", "--plan", plan, "--strand", "0"][..], more].concat();
        let ran = place.tailor(&words).env(variable, value).output().unwrap();
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        (ran.status.code(), stderr)
    };
    // Nobody else's programs, as of a folder of links: `bwrap` is not among them.
    let bare = place.path("bare");
    std::fs::create_dir(&bare).unwrap();
    for name in ["sh", "cat", "grep"] {
        let programs = ["/usr/bin", "/bin"].map(|folder| std::path::Path::new(folder).join(name));
        let found = programs.iter().find(|program| program.exists()).unwrap();
        std::os::unix::fs::symlink(found, bare.join(name)).unwrap();
    }
    let (code, stderr) = work(&["--sandbox", "required"], "PATH", &bare);
    assert!(
        code == Some(1) && stderr.contains("not installed"),
        "{stderr}"
    );
    assert_eq!(place.made(), 0);
    // Another home, of which nobody knows what may run.
    let home = place.path("home");
    let (code, stderr) = work(&[], "XDG_STATE_HOME", &home);
    assert!(
        code == Some(1) && stderr.contains("--allow-exec"),
        "{stderr}"
    );
    let (code, stderr) = work(&["--allow-exec"], "XDG_STATE_HOME", &home);
    assert_eq!((code, place.made()), (Some(0), 1), "{stderr}");
}
