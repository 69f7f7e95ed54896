//! What a sweep costs the engine: `cargo bench --bench sweep`, with `--features remote` beside a shared folder, too.
//!
//! Points of next to no work, each time a whole process: made first, then found. The least of several, since
//! other people use the machine too; found points are the ones that come back with every question.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// A program a point.
const PROGRAM: &str = r#"goal = "x"
[node.x]
stage = "exec"
out = "document"
with = { n = 0 }
command = ["sh", "-c", "echo $2 > $1/a.txt", "sh", "{out}", "{with.n}"]
"#;

/// How often what is found is timed.
const TIMES: usize = 5;

/// Runs a sweep in a cache; how long it took, and how many results it made. \[s\]
fn swept(words: &[&str], cache: &Path) -> (f64, u64) {
    let start = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_tailor"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("XDG_STATE_HOME", cache)
        .arg("sweep")
        .args(words);
    command
        .args(["--yes", "--json", "--allow-exec", "--cache"])
        .arg(cache);
    let ran = command.stderr(Stdio::inherit()).output().unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert!(ran.status.success(), "{words:?}");
    let table: serde_json::Value = serde_json::from_slice(&ran.stdout).unwrap();
    let points = table["points"].as_array().unwrap();
    (
        seconds,
        points.iter().map(|p| p["made"].as_u64().unwrap()).sum(),
    )
}

fn row(name: &str, words: &[&str], points: u64, place: &Path) {
    let cache = place.join(name.replace(' ', "-"));
    let (cold, made) = swept(words, &cache);
    assert_eq!(made, points);
    // What was made a moment ago is looked at once more before it is trusted.
    std::thread::sleep(std::time::Duration::from_millis(2100));
    swept(words, &cache);
    let found = (0..TIMES).map(|_| {
        let (seconds, made) = swept(words, &cache);
        assert_eq!(made, 0);
        seconds
    });
    let found = found.fold(f64::INFINITY, f64::min);
    let each = 1e3 * found / points as f64;
    println!("| {name} | {points} | {cold:.2} s | {found:.2} s | {each:.2} ms |");
}

fn main() {
    let place = tempfile::tempdir().unwrap();
    let place = place.path();
    let program = place.join("x.toml");
    std::fs::write(&program, PROGRAM).unwrap();
    let program = program.to_str().unwrap();
    println!("| sweep | points | made | found | a point |\n|---|---|---|---|---|");
    let solid = ["pipelines/synth.toml", "--nodes", "solid"];
    let over = "--sweep=solid.stature_mm=1500..1900/1000";
    row(
        "built-in stage",
        &[&solid[..], &[over]].concat(),
        1000,
        place,
    );
    row("program", &[program, "--sweep=x.n=1..200/200"], 200, place);
    if cfg!(feature = "remote") {
        let shared = place.join("shared");
        std::fs::create_dir(&shared).unwrap();
        let store = format!("--store=file://{}", shared.display());
        row(
            "built-in stage beside a shared folder",
            &[&solid[..], &[over, &store]].concat(),
            1000,
            place,
        );
    }
}
