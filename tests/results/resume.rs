//! A killed run goes on: `measure` on the sample, killed at twenty random moments. Whatever a part
//! or a checkpoint holds is never done again: no more of them are written than by a run that
//! nobody disturbs.
//!
//! Takes minutes, so it is asked for: `cargo test --release --test product resume -- --ignored --nocapture`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

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

/// The report ends with a table of times; what comes before it is the result.
fn result(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = files(folder);
    all.retain(|(name, _)| name != Path::new("report.html"));
    assert!(all.len() > 5, "{} files", all.len());
    all
}

/// The files of a shelf of a store, and when each was written.
fn shelf(cache: &Path, name: &str) -> Vec<(PathBuf, SystemTime)> {
    let inner = |d: PathBuf| {
        let entries = std::fs::read_dir(d).into_iter().flatten();
        entries.map(|e| e.unwrap().path())
    };
    let written = |path: PathBuf| {
        let at = std::fs::metadata(&path).and_then(|m| m.modified());
        at.ok().map(|at| (path, at))
    };
    let files = inner(cache.join(name)).flat_map(inner);
    files.filter_map(written).collect()
}

/// Waits for the end, or kills at the moment; notes every part and checkpoint that is written.
/// Whether it came to its end, and how long it took.
fn watched(
    mut child: Child,
    cache: &Path,
    kill_at: Option<Duration>,
    written: &mut BTreeSet<(PathBuf, SystemTime)>,
) -> (bool, Duration) {
    let start = Instant::now();
    loop {
        let status = child.try_wait().unwrap();
        let due = kill_at.is_some_and(|moment| start.elapsed() >= moment);
        if status.is_none() && due {
            child.kill().unwrap();
            child.wait().unwrap();
        }
        written.extend(shelf(cache, "parts"));
        match status {
            Some(status) => {
                assert!(status.success());
                return (true, start.elapsed());
            }
            None if due => return (false, start.elapsed()),
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    }
}

#[test]
#[ignore = "runs for minutes: kills `measure` on the sample twenty times"]
fn killed_at_twenty_random_moments_it_goes_on_and_ends_with_the_same_bytes() {
    let place = tempfile::tempdir().unwrap();
    let path = |name: &str| place.path().join(name);
    let mut once = BTreeSet::new();
    let child = measure(&path("clean"), &path("out"));
    let (_, clean) = watched(child, &path("clean"), None, &mut once);
    let want = result(&path("out"));
    let (secs, count) = (clean.as_secs_f64(), once.len());
    eprintln!("one run: {secs:.1} s, {count} parts and checkpoints");
    assert!(count > 50, "{count} parts and checkpoints");
    let (mut dice, mut kills, mut round) = (proof::Dice(2026), 0, 0);
    while kills < KILLS {
        round += 1;
        let (cache, out) = (path(&format!("cache{round}")), path(&format!("out{round}")));
        let (mut in_all, mut killed, mut written) = (Duration::ZERO, 0, BTreeSet::new());
        loop {
            let records = shelf(&cache, "ac");
            let moment = clean.mul_f64(dice.within(0.0, 0.4));
            let kill_at = (kills < KILLS).then_some(moment);
            let (ended, took) = watched(measure(&cache, &out), &cache, kill_at, &mut written);
            in_all += took;
            let after = shelf(&cache, "ac");
            let still = |r: &(PathBuf, SystemTime)| after.contains(r);
            assert!(
                records.iter().all(still),
                "a record went away or was made again"
            );
            if ended {
                break;
            }
            (kills, killed) = (kills + 1, killed + 1);
        }
        assert!(result(&out) == want, "round {round} ended with other bytes");
        eprintln!(
            "round {round}: {killed} kills, {:.1} s in all, {} parts and checkpoints; same bytes",
            in_all.as_secs_f64(),
            written.len()
        );
        assert!(
            written.len() <= count,
            "what a checkpoint had was done again"
        );
        let _ = std::fs::remove_dir_all(&cache);
    }
    eprintln!("{kills} kills in {round} rounds");
}
