//! What the program makes of captures: pipelines, results beside each other, pages, formats.

mod comparisons;
mod films;
mod formats;
mod over_time;
mod pages;
mod picker;
mod pipelines;
mod plots;
mod repeats;
mod resume;
mod sections;
mod sides;
mod synth;
#[path = "../../stages/report/tests/tube/mod.rs"]
mod tube;

use super::chromium;
use std::path::Path;

/// Runs the program with a cache: its exit code, and what it prints.
fn ran(args: &[&str], cache: &Path) -> (Option<i32>, String, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_tailor"));
    let ran = command.args(args).arg("--cache").arg(cache).output();
    let ran = ran.unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (ran.status.code(), text(ran.stdout), text(ran.stderr))
}
