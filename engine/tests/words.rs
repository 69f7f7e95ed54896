//! The example of another application: its pipeline, a sweep, a program, its command line.

#[path = "../examples/words/application.rs"]
mod application;
#[path = "../examples/words/nouns.rs"]
mod nouns;

use application::{CATALOG, WORDS};
use engine::Options;
use engine::recipe::{Overrides, open};
use nouns::Text;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

fn example() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/words")
}

/// A copy of the texts, so that one of them can be changed.
fn texts(place: &Path) -> PathBuf {
    let texts = place.join("texts");
    std::fs::create_dir(&texts).unwrap();
    for name in ["one.txt", "two.txt"] {
        std::fs::copy(example().join("texts").join(name), texts.join(name)).unwrap();
    }
    texts
}

#[test]
fn ten_lines_have_the_whole_command_line() {
    let place = tempfile::tempdir().unwrap();
    let (texts, example) = (texts(place.path()), example());
    let printed = |line: &str| {
        let input = format!("texts={}", texts.display());
        let pipeline = example.join("words.toml").display().to_string();
        let cache = place.path().join("cache").display().to_string();
        let out = place.path().join("out").display().to_string();
        let words = line.split(' ').map(|word| match word {
            "PIPELINE" => pipeline.clone(),
            "INPUT" => input.clone(),
            "OUT" => out.clone(),
            "OUT2" => format!("{out}.txt"),
            word => word.to_owned(),
        });
        let all = ["words".to_owned()].into_iter().chain(words);
        command::run(
            &WORDS,
            all.chain(["--cache".into(), cache, "--quiet".into()]),
        )
    };
    assert_eq!(printed("run PIPELINE --input INPUT --out OUT"), 0);
    let written =
        |name: &str| std::fs::read_to_string(place.path().join("out").join(name)).unwrap();
    assert!(written("report.txt").starts_with("11 words in all\n"));
    assert!(written("counts.csv").contains("\ntwo.txt,again,1\n"));
    assert!(written("run.json").contains("\"program\": \"words 1\""));
    assert_eq!(printed("check PIPELINE"), 0);
    assert_eq!(printed("plan PIPELINE --input INPUT"), 0);
    assert_eq!(printed("sweep PIPELINE letters --input INPUT --out OUT"), 0);
    let table = written("sweep.csv");
    let rows: Vec<&str> = table
        .lines()
        .map(|line| line.split(",,").next().unwrap())
        .collect();
    assert!(
        rows[0].starts_with("counts.least_letters,counts.words,counts.distinct"),
        "{table}"
    );
    assert!(
        rows[1].starts_with("1,19,11,") && rows[3].starts_with("5,5,5,"),
        "{table}"
    );
    // What is in no catalog is reported, with what was meant.
    assert_eq!(
        printed("sweep PIPELINE letters --input INPUT --tell counts.wrds"),
        2
    );
    assert_eq!(
        printed("show report --pipeline PIPELINE --input INPUT -o OUT2"),
        0
    );
    assert_eq!(printed("stages words.count"), 0);
    assert_eq!(printed("run PIPELINE"), 2);
}

/// Permissions of these tests, and not of who runs them.
fn permissions() {
    static STATE: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());
    engine::permission::keep_permissions_in(STATE.path().to_owned());
}

#[test]
fn a_program_of_the_example_counts_on_what_our_stage_made() {
    let place = tempfile::tempdir().unwrap();
    let texts = texts(place.path());
    let overrides = Overrides::default();
    // Another test runs the example itself, and asks first.
    let own = place.path().join("own.toml");
    let extended = example().join("program.toml").canonicalize().unwrap();
    std::fs::write(
        &own,
        format!("extends = {extended:?}\n[node.longest]\nenv = [\"LANG\"]\n"),
    )
    .unwrap();
    let graph = open(&own, &overrides, &CATALOG);
    let graph = graph.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    let cache = place.path().join("cache");
    permissions();
    engine::permission::allow(&graph, &all).unwrap();
    let options = Options {
        cache,
        threads: Some(2),
        keep_going: false,
    };
    let folders = [("texts".to_owned(), texts)];
    let go = AtomicBool::new(false);
    let outcome = engine::run(&graph, &folders, &graph.goal, &options, &(), &go).unwrap();
    let text = outcome.read::<Text>("longest").unwrap();
    let lengths = |line: &str| line.split(' ').next().map(str::len);
    assert_eq!(text.0.lines().count(), 2, "{text:?}");
    assert!(text.0.lines().all(|line| lengths(line) > Some(0)));
}

#[test]
fn the_command_line_asks_before_a_program_runs() {
    let place = tempfile::tempdir().unwrap();
    let texts = texts(place.path());
    let (input, cache) = (
        format!("texts={}", texts.display()),
        place.path().join("cache"),
    );
    permissions();
    let pipeline = example().join("program.toml");
    let run = |verb: &str, more: &[&str]| {
        let words = [
            "words",
            verb,
            pipeline.to_str().unwrap(),
            "--input",
            &input,
            "--quiet",
        ];
        let words = words
            .iter()
            .copied()
            .chain(["--cache", cache.to_str().unwrap()]);
        let words = words.chain(more.iter().copied()).map(String::from);
        command::run(&WORDS, words.collect::<Vec<_>>())
    };
    assert_eq!(run("run", &[]), 2);
    assert_eq!(run("plan", &[]), 0);
    assert_eq!(run("run", &["--allow-exec"]), 0);
    assert_eq!(run("run", &[]), 0, "it is remembered");
    assert_eq!(
        run("run", &["--set", "longest.most=1"]),
        0,
        "a number may change"
    );
    assert_eq!(run("run", &["--set", "longest.most=\"1; rm\""]), 2);
}
