//! Workers killed in the midst of publishing: while a result is written, and between it and its record.

use crate::place::Place;
use crate::site::Site;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// base → x: a result of 40 MB a point, after as long as it takes to be worth syncing.
const PIPELINE: &str = r#"goal = "x"
[node.base]
stage = "exec"
out = "document"
command = ["sh", "-c", "echo base > $1/a.txt", "sh", "{out}"]
[node.x]
stage = "exec"
out = "document"
from = { base = "base" }
with = { n = 0 }
command = ["sh", "-c", "sleep 3.1; yes \"$2 $(cat $3)\" | head -c 40000000 > $1/a.txt", "sh", "{out}", "{with.n}", "{from.base}"]
"#;

/// A file that is being written and is so large is a result. \[bytes\]
const LARGE: u64 = 100_000;

/// When a worker is killed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Moment {
    Writing,
    BeforeTheRecord,
}

fn files(folder: PathBuf) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries.flatten().map(|entry| entry.path()).collect()
}

/// How many files are on a shelf.
fn on(place: &Place, shelf: &str) -> usize {
    let inner = files(place.cache().join(shelf));
    inner.into_iter().map(|folder| files(folder).len()).sum()
}

/// The processes that write a result just now; those that were killed leave their files.
fn writers(place: &Place) -> Vec<String> {
    let large = |file: &PathBuf| std::fs::metadata(file).is_ok_and(|m| m.len() >= LARGE);
    let pid = |file: PathBuf| {
        let name = file.file_name()?.to_str()?.to_owned();
        Some(name.split('-').next()?.to_owned())
    };
    let written = files(place.cache().join("tmp")).into_iter().filter(large);
    let alive = |pid: &String| PathBuf::from("/proc").join(pid).exists();
    written.filter_map(pid).filter(alive).collect()
}

fn planned(place: &Place, points: &str, more: &[&str]) -> serde_json::Value {
    std::fs::write(place.path("large.toml"), PIPELINE).unwrap();
    let file = place.path("large.toml").display().to_string();
    let over = format!("--sweep=x.n={points}");
    place.json(&[&["sweep", &file, &over][..], more].concat())
}

fn plan(place: &Place, points: &str) -> String {
    let answer = planned(place, points, &["--strands", "--allow-exec"]);
    answer["plan"]
        .as_str()
        .unwrap_or_else(|| panic!("{answer}"))
        .to_owned()
}

/// Works on a strand and is killed at a moment; whether it was, before the result was there for other workers.
fn killed(place: &Place, plan: &str, strand: &str, moment: Moment) -> bool {
    let (blobs, records) = (on(place, "cas"), on(place, "ac"));
    let mut worker = place
        .tailor(&["work", "--plan", plan, "--strand", strand, "--quiet"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    let now = || match moment {
        Moment::Writing => !writers(place).is_empty(),
        Moment::BeforeTheRecord => on(place, "cas") > blobs,
    };
    while !now() {
        assert!(
            worker.try_wait().unwrap().is_none(),
            "it ended before {moment:?}"
        );
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "{moment:?} did not come"
        );
        std::thread::sleep(Duration::from_micros(200));
    }
    worker.kill().unwrap();
    worker.wait().unwrap();
    let more = (on(place, "cas") - blobs, on(place, "ac") - records);
    match moment {
        Moment::Writing => more == (0, 0),
        Moment::BeforeTheRecord => more == (1, 0),
    }
}

#[test]
fn a_worker_killed_while_it_publishes_loses_nothing_and_nothing_else_is_made_again() {
    let place = Place::new();
    let plan = plan(&place, "1,2,3,4,5,6");
    let work = |strand: &str| {
        let ran = place.run(&["work", "--plan", &plan, "--strand", strand, "--quiet"]);
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert!(ran.status.success(), "{stderr}");
    };
    work("0");
    let (mut strand, mut late) = (0, 0);
    for moment in [Moment::Writing, Moment::BeforeTheRecord] {
        // The moment may be over before the signal comes: then the next strand.
        loop {
            strand += 1;
            assert!(strand <= 6, "{moment:?} was never met");
            let met = killed(&place, &plan, &strand.to_string(), moment);
            work(&strand.to_string());
            if met {
                break;
            }
            late += 1;
        }
    }
    // Who was killed once all was there has written no log, and nobody made it again.
    assert!(place.made() + late > strand, "lost: {}", place.made());
    assert!(place.made() <= 1 + strand, "twice: {}", place.made());
    assert_eq!(
        (on(&place, "ac"), on(&place, "cas")),
        (1 + strand, 1 + strand)
    );
    let points: Vec<String> = (1..=strand).map(|n| n.to_string()).collect();
    let table = planned(&place, &points.join(","), &[]);
    let points = table["points"].as_array().unwrap();
    assert!(
        points.iter().all(|p| p["done"] == true && p["made"] == 0),
        "{table}"
    );
    let checked = place.json(&["cache", "verify"]);
    assert_eq!(checked["bad"], 0, "{checked}");
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn an_element_requeued_or_killed_while_it_publishes_is_made_whole() {
    let site = Site::new(1001);
    let place = &site.place;
    let plan = plan(place, "1,2");
    site.submit(&plan);
    let publishing = || writers(place).into_iter().next();
    let running = || site.ask("squeue", &["-h", "-r", "-t", "R", "-o", "%i"]);
    let signal = |name: &str, pid: &str| {
        let sent = Command::new("kill").args([name, pid]).status();
        assert!(sent.unwrap().success(), "{pid} is gone");
    };
    // Stopped in the midst of writing, then back into the queue with whatever else runs.
    let mut pid = None;
    let start = Instant::now();
    while pid.is_none() {
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "nothing was written"
        );
        pid = publishing();
    }
    signal("-STOP", &pid.unwrap());
    running()
        .lines()
        .for_each(|element| _ = site.ask("scontrol", &["requeue", element]));
    // Killed outright in the midst of writing, when it comes to that again.
    let start = Instant::now();
    let ended = || site.ask("squeue", &["-h"]).trim().is_empty();
    while !ended() && start.elapsed() < Duration::from_secs(120) {
        if let Some(pid) = publishing() {
            signal("-KILL", &pid);
            break;
        }
    }
    site.settle();
    site.submit(&plan);
    site.settle();
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(
        (on(place, "ac"), on(place, "cas")),
        (3, 3),
        "none lost, none beside"
    );
    let table = planned(place, "1,2", &[]);
    let points = table["points"].as_array().unwrap();
    assert!(
        points.iter().all(|p| p["done"] == true && p["made"] == 0),
        "{table}"
    );
    let checked = place.json(&["cache", "verify"]);
    assert_eq!(checked["bad"], 0, "{checked}");
}
