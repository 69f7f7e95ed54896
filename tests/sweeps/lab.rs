//! The small tables of the lab are what the program comes to now.

use std::path::Path;

/// All but `evolutions`, whose photos are larger.
const SMALL: [&str; 5] = ["silhouettes", "views", "smoothing", "weights", "levels"];

#[test]
fn small_studies_have_not_moved() {
    let cache = tempfile::tempdir().unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_tailor"));
    let command = command.args(["study", "run"]).args(SMALL);
    let command = command.args(["--check", "--quiet"]);
    let ran = command
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")))
        .arg("--cache")
        .arg(cache.path());
    let ran = ran.output().unwrap();
    let told = String::from_utf8([ran.stdout, ran.stderr].concat()).unwrap();
    assert!(
        ran.status.success(),
        "{told}\nif it moved on purpose: cargo run --release -- study run {}",
        SMALL.join(" ")
    );
}
