//! A killed run goes on: `measure` on the sample, killed at twenty random moments.
//!
//! Takes minutes, so it is asked for: `cargo test --release --test resume -- --ignored --nocapture`.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const KILLS: usize = 20;

fn measure(cache: &Path, out: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command.args(["measure", "samples/mannequin", "--quiet", "--cache"]);
    command.arg(cache).arg("--out").arg(out);
    command.stdout(Stdio::null()).spawn().unwrap()
}

/// All files below a folder by their name, run.json left out: it holds times.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let (mut open, mut found) = (vec![folder.to_owned()], Vec::new());
    while let Some(at) = open.pop() {
        for entry in std::fs::read_dir(&at).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.file_name().unwrap() != "run.json" {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                found.push((name, std::fs::read(&path).unwrap()));
            }
        }
    }
    found.sort();
    found
}

/// The report ends with a table of times; what stands before it is the result.
fn result(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = files(folder);
    all.retain(|(name, _)| name != Path::new("report.html"));
    assert!(all.len() > 5, "{} files", all.len());
    all
}

/// Names of the records and parts of a store.
fn kept(cache: &Path) -> Vec<PathBuf> {
    let mut names = Vec::new();
    for shelf in ["ac", "part"] {
        let folder = cache.join(shelf);
        let inner = |d: PathBuf| {
            std::fs::read_dir(d)
                .into_iter()
                .flatten()
                .map(|e| e.unwrap().path())
        };
        names.extend(inner(folder).flat_map(inner));
    }
    names.sort();
    names
}

#[test]
#[ignore = "runs for minutes: kills `measure` on the sample twenty times"]
fn killed_at_twenty_random_moments_it_goes_on_and_ends_with_the_same_bytes() {
    let place = tempfile::tempdir().unwrap();
    let path = |name: &str| place.path().join(name);
    let start = Instant::now();
    assert!(
        measure(&path("clean"), &path("out"))
            .wait()
            .unwrap()
            .success()
    );
    let clean = start.elapsed();
    let want = result(&path("out"));
    eprintln!("one run: {:.1} s", clean.as_secs_f64());
    let (mut dice, mut kills, mut round) = (proof::Dice(2026), 0, 0);
    while kills < KILLS {
        round += 1;
        let (cache, out) = (path(&format!("cache{round}")), path(&format!("out{round}")));
        let (mut in_all, mut killed) = (Duration::ZERO, 0);
        loop {
            let before = kept(&cache);
            let start = Instant::now();
            let mut child = measure(&cache, &out);
            let moment = clean.mul_f64(dice.within(0.0, 0.4));
            let ended = loop {
                if let Some(status) = child.try_wait().unwrap() {
                    break Some(status);
                }
                if kills < KILLS && start.elapsed() >= moment {
                    child.kill().unwrap();
                    child.wait().unwrap();
                    (kills, killed) = (kills + 1, killed + 1);
                    break None;
                }
                std::thread::sleep(Duration::from_millis(5));
            };
            in_all += start.elapsed();
            let after = kept(&cache);
            let records = |all: &[PathBuf]| {
                all.iter()
                    .filter(|p| p.starts_with(cache.join("ac")))
                    .cloned()
                    .collect::<Vec<_>>()
            };
            let still = |p: &PathBuf| after.binary_search(p).is_ok();
            assert!(records(&before).iter().all(still), "a record went away");
            if let Some(status) = ended {
                assert!(status.success());
                break;
            }
        }
        assert!(result(&out) == want, "round {round} ended with other bytes");
        eprintln!(
            "round {round}: {killed} kills, {:.1} s in all; same bytes",
            in_all.as_secs_f64()
        );
        let _ = std::fs::remove_dir_all(&cache);
    }
    eprintln!("{kills} kills in {round} rounds");
}
