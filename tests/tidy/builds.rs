//! Nothing is built twice: what `cargo run` compiled, `cargo test` finds, for tests' own dependencies change no feature of it.
//! Nor is a crate read again for examples in its comments, or for tests, where it has none.

use super::rules::sources;
use std::collections::BTreeSet;
use std::path::Path;
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

/// How often a file has an example in its comments that a test would run.
fn examples(text: &str) -> usize {
    let comments = text.lines().map(str::trim_start);
    let comments = comments.filter_map(|l| l.strip_prefix("///").or(l.strip_prefix("//!")));
    let fences: Vec<&str> = comments
        .filter_map(|l| l.trim().strip_prefix("```"))
        .collect();
    let opened = fences.iter().step_by(2);
    let shown = |kind: &str| ["text", "toml"].contains(&kind);
    opened.filter(|kind| !shown(kind)).count()
}

/// Crates, and whether their examples, and their own tests, are run.
#[test]
fn examples_and_tests_are_looked_for_where_there_are_some() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = std::fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let folders = ["stages", "engine"].map(|f| std::fs::read_dir(root.join(f)).unwrap());
    let below = folders.into_iter().flatten().map(|e| e.unwrap().path());
    let crates = below.filter(|f| f.join("Cargo.toml").is_file());
    let crates: Vec<_> = crates
        .chain(["", "engine", "study"].map(|f| root.join(f)))
        .collect();
    assert!(
        crates.len() > 20 && manifest.contains("\"study\""),
        "{crates:?}"
    );
    for folder in crates {
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let of = folder.strip_prefix(root).unwrap().join("src");
        let files: Vec<String> = sources()
            .into_iter()
            .filter(|(path, _)| path.starts_with(&of))
            .map(|(_, text)| text)
            .collect();
        let examples: usize = files.iter().map(|text| examples(text)).sum();
        let left_out = manifest.contains("\ndoctest = false\n");
        assert_eq!(left_out, examples == 0, "{folder:?}: {examples} examples");
        let tested = files.iter().any(|text| text.contains("#[test]"));
        let lib = manifest.split("[lib]").nth(1).unwrap_or_default();
        let lib = lib.split("\n[").next().unwrap_or_default();
        assert_eq!(lib.contains("\ntest = false\n"), !tested, "{folder:?}");
    }
}

#[test]
fn an_example_is_distinguished_from_what_is_shown() {
    let text = "//! ```text\n//! a\n//! ```\n/// ```no_run\n/// b();\n/// ```\n/// ```\n/// c();\n/// ```\n";
    assert_eq!(examples(text), 2);
}
