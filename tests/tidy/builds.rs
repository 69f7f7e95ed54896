//! Nothing is built twice: what `cargo run` compiled, `cargo test` finds, for tests' own dependencies change no feature of it.

use std::collections::BTreeSet;
use std::process::Command;

/// Each crate with its features, as a command builds it.
fn crates(of: &[&str]) -> BTreeSet<String> {
    let mut command = Command::new(env!("CARGO"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command.args(["tree", "--offline", "--prefix", "none", "-f", "{p} {f}"]);
    let ran = command.args(of).output().unwrap();
    let text = String::from_utf8(ran.stdout).unwrap();
    assert!(
        ran.status.success(),
        "{}",
        String::from_utf8_lossy(&ran.stderr)
    );
    let plain = text
        .lines()
        .map(|l| l.trim_end_matches(" (*)").trim().to_owned());
    plain.filter(|l| !l.is_empty()).collect()
}

#[test]
fn tests_build_no_crate_anew_that_the_program_is_built_of() {
    let program = crates(&["-e", "normal,build"]);
    let tests = crates(&["-e", "normal,build,dev", "--workspace"]);
    let more: Vec<&String> = tests.difference(&program).collect();
    let name = |line: &&String| line.split(' ').next().unwrap().to_owned();
    let names: BTreeSet<String> = program.iter().map(|l| name(&l)).collect();
    let anew: Vec<_> = more.iter().filter(|l| names.contains(&name(l))).collect();
    assert!(program.len() > 100 && anew.is_empty(), "{anew:#?}");
}
