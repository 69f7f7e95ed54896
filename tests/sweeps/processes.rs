//! Sweeps as processes: one that is killed goes on, two at once share their points.

use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A sweep over the cells of a body given by formula: one result that all share, one a point.
fn sweep(cells: &str, cache: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
    command.current_dir(PathBuf::from(env!("CARGO_MANIFEST_DIR")));
    command.args(["sweep", "pipelines/synth.toml", "--nodes", "true_body"]);
    command.args(["--sweep", &format!("true_body.cell_mm={cells}"), "--cache"]);
    command.arg(cache);
    command
}

/// Points, and how many results were made for all of them.
fn made(json: &[u8]) -> (usize, u64) {
    let table: Value = serde_json::from_slice(json).unwrap();
    let points = table["points"].as_array().unwrap();
    assert!(points.iter().all(|p| p["done"] == true), "{table}");
    let made = points.iter().map(|p| p["made"].as_u64().unwrap());
    (points.len(), made.sum())
}

fn run(cells: &str, cache: &Path) -> (usize, u64) {
    let ran = sweep(cells, cache).arg("--json").output().unwrap();
    assert!(ran.status.success());
    made(&ran.stdout)
}

/// How many results the store has.
fn records(cache: &Path) -> u64 {
    let inner = |d: PathBuf| {
        let entries = std::fs::read_dir(d).into_iter().flatten();
        entries.map(|e| e.unwrap().path())
    };
    inner(cache.join("ac")).flat_map(inner).count() as u64
}

#[test]
fn a_killed_sweep_goes_on_and_added_points_make_only_what_is_new() {
    let cache = tempfile::tempdir().unwrap();
    let mut child = sweep("50,45,40,35", cache.path());
    let mut child = child
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let first = lines.map(Result::unwrap).find(|l| l.starts_with("[  1/4]"));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(first.is_some(), "the first point is printed as it comes");
    let before = records(cache.path());
    assert!(before >= 2, "{before} results of the first point");
    assert_eq!(run("50,45,40,35", cache.path()), (4, 5 - before));
    assert_eq!(run("50,48,45,40,35,30", cache.path()), (6, 2));
    assert_eq!(run("50,48,45,40,35,30", cache.path()), (6, 0));
}

#[test]
fn two_sweeps_at_once_make_what_they_share_once() {
    let cache = tempfile::tempdir().unwrap();
    let start = |cells: &str| {
        let mut command = sweep(cells, cache.path());
        let command = command.arg("--json").stdout(Stdio::piped());
        command.spawn().unwrap()
    };
    let both = [start("50,45,40,35"), start("50,45,40,30")];
    let ended = both.map(|child| child.wait_with_output().unwrap());
    let [a, b] = ended.map(|ran| made(&ran.stdout));
    assert_eq!((a.0, b.0), (4, 4));
    assert_eq!(a.1 + b.1, 1 + 5, "one solid and five bodies");
}
