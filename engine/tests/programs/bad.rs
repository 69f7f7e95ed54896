//! Programs that fail, in every way there is: each is reported, nothing of them is kept, nothing stays.

use crate::application::{Place, done, left, shell};
use crate::node::installed;
use engine::walk::Status;
use programs::Sandbox;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Whether a process runs that has a word among its arguments.
fn runs(word: &str) -> bool {
    let entries = std::fs::read_dir("/proc").unwrap().flatten();
    let mut lines = entries.filter_map(|e| std::fs::read(e.path().join("cmdline")).ok());
    lines.any(|line| line.split(|b| *b == 0).any(|w| w == word.as_bytes()))
}

#[test]
fn every_way_to_fail_is_reported() {
    let place = Place::new();
    place.write("none.sh", "exit 0\n");
    let cases = [
        (
            "echo gone wrong >&2; exit 3",
            "ended with exit code 3; its last lines:\n  | gone wrong",
        ),
        ("kill -9 $$", "ended with "),
        ("true", "wrote nothing to {out}"),
        (
            "echo a > $1.part",
            "text.txt.part, which is no file of text (text.txt)",
        ),
        (
            "echo a > $1; echo b > $(dirname $1)/b.txt",
            "b.txt, which is no file of text",
        ),
        ("ln -s /etc/passwd $1", "text.txt, which is a link"),
        (
            "mkfifo $1",
            "text.txt, which is a device, a pipe or a socket",
        ),
        ("mkdir $1", "wrote nothing to {out}"),
        (
            "printf '\\377\\376' > $1",
            "is not taken as text: invalid utf-8",
        ),
        (
            "truncate -s 5G $1; sleep 1",
            "more than 4294 MB in 100000 files is not taken",
        ),
        (
            "truncate -s 5G $1",
            "more than 4294 MB in 100000 files is not taken",
        ),
        ("printf '\\033[2J\\n' >&2; exit 1", "| \\u{1b}[2J"),
        (
            "yes | head -c 3000000; exit 1",
            "exit code 1; its last lines:\n  | y\n",
        ),
    ];
    for (line, reported) in cases {
        let why = place.failure(&shell(line, ""));
        assert!(why.contains(reported), "{line}: {why}");
    }
    let absent = "[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [\"no-such-program-7\", \"{out}\"]\n";
    let why = place.failure(absent);
    assert!(
        why.contains("there is no program `no-such-program-7`: install it"),
        "{why}"
    );
    let start = absent.replace("no-such-program-7", "{here}/none.sh") + "files = [\"none.sh\"]\n";
    let why = place.failure(&start);
    assert!(why.contains("{here}") || why.contains("none.sh"), "{why}");
    assert_eq!(
        engine::store::retention::list(&place.store())
            .unwrap()
            .len(),
        0,
        "a failure is never kept"
    );
}

#[test]
fn half_of_a_result_is_none() {
    let place = Place::new();
    let nodes = "[node.names]\nstage = \"text.take\"\nfrom = { files = \"@src\" }\n\
         [node.x]\nstage = \"exec\"\nout = \"pages\"\nfrom = [\"names\"]\n\
         command = [\"sh\", \"-c\", 'echo 1 > \"$1/one.txt\"', \"sh\", \"{out}\"]\n";
    let why = place.failure(nodes);
    assert!(why.contains("is not taken as pages: no page two"), "{why}");
}

#[test]
fn who_takes_for_ever_is_ended_with_all_children() {
    let place = Place::new();
    let start = Instant::now();
    let line = "(sleep 4711.25 & sleep 4711.25 & wait) & echo waiting; wait";
    let why = place.failure(&shell(line, "timeout_s = 2\n"));
    assert!(
        why.contains("was ended after 2 s") && why.contains("| waiting"),
        "{why}"
    );
    assert!(start.elapsed() < Duration::from_secs(20));
    assert!(!runs("4711.25"));
}

#[test]
fn who_forks_and_stays_is_ended() {
    let place = Place::new();
    let nodes = shell("setsid sleep 4712.25 > /dev/null 2>&1 & echo a > $1", "");
    match programs::sandbox() {
        // It ends with its sandbox.
        Sandbox::Bubblewrap(_) => assert_eq!(place.text(&nodes), "a\n"),
        _ => {
            let why = place.failure(&nodes);
            assert!(why.contains("left processes behind ("), "{why}");
        }
    }
    assert!(!runs("4712.25"));
}

#[test]
fn who_holds_too_much_memory_is_ended() {
    let place = Place::new();
    let line = "python3 -c 'x = bytearray(300_000_000); import time; time.sleep(60)'";
    let why = place.failure(&shell(line, "memory_mb = 100\n"));
    assert!(why.contains("took more than 100 MB"), "{why}");
}

#[test]
fn who_is_stopped_takes_children_along_and_is_no_failure() {
    let place = Place::new();
    let graph = place.graph(&shell("sleep 4713.25 & sleep 4713.25", ""));
    place.allow(&graph);
    let cancel = AtomicBool::new(false);
    let outcome = std::thread::scope(|scope| {
        let run = scope.spawn(|| place.run(&graph, &(), &cancel).unwrap());
        let start = Instant::now();
        while !runs("4713.25") && start.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(5));
        }
        cancel.store(true, Ordering::Relaxed);
        run.join().unwrap()
    });
    assert!(outcome.cancelled());
    assert_eq!(done(&outcome, &graph, "x").status, Status::Cancelled);
    assert!(!runs("4713.25"));
    assert_eq!(left(&place.path("cache")), Vec::<PathBuf>::new());
}

#[test]
fn an_identity_that_changes_while_the_program_runs_is_reported_and_nothing_is_kept() {
    let place = Place::new();
    let tool = installed(&place, "1\n");
    let nodes = shell("sleep 1; echo a > $1", &format!("identity = [{tool:?}]\n"));
    let graph = place.graph(&nodes);
    place.allow(&graph);
    let why = std::thread::scope(|scope| {
        let run = scope.spawn(|| place.run(&graph, &(), &false.into()).unwrap());
        std::thread::sleep(Duration::from_millis(500));
        installed(&place, "2\n");
        let outcome = run.join().unwrap();
        outcome.failure(&graph).map(|(_, why)| why.to_owned())
    });
    let why = why.expect("it fails");
    assert!(
        why.contains("changed while it ran, from \"1\" to \"2\""),
        "{why}"
    );
    assert_eq!(
        engine::store::retention::list(&place.store())
            .unwrap()
            .len(),
        0
    );
}

#[test]
fn an_identity_that_fails_is_reported_before_anything_runs() {
    let place = Place::new();
    let graph = place.graph(&shell(
        "echo a > $1",
        "identity = [\"sh\", \"-c\", \"echo no module; exit 1\"]\n",
    ));
    place.allow(&graph);
    let why = place
        .run(&graph, &(), &false.into())
        .err()
        .expect("it fails");
    assert!(
        why.contains("node `x`: the identity cannot be found: `sh` ended with exit code 1"),
        "{why}"
    );
}

#[test]
fn a_file_that_changes_after_the_pipeline_was_read_is_reported() {
    let place = Place::new();
    place.write("a.sh", "echo a > $1\n");
    let nodes = "[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [\"sh\", \"{here}/a.sh\", \"{out}\"]\nfiles = [\"a.sh\"]\n";
    let graph = place.graph(nodes);
    place.allow(&graph);
    place.write("a.sh", "echo b > $1\n");
    let outcome = place.run(&graph, &(), &false.into()).unwrap();
    let why = outcome.failure(&graph).unwrap().1;
    assert!(
        why.contains("a.sh changed while the run was using it"),
        "{why}"
    );
}

#[test]
fn mistakes_of_a_program_are_reported_with_their_places() {
    let place = Place::new();
    let cases = [
        (
            "command = [\"sh\"]",
            "the command does not name the place of the result: write {out}",
        ),
        ("", "node `x` runs nothing"),
        (
            "command = [\"sh\", \"{out}\", \"{from.src}\"]",
            "there is no port `src`",
        ),
        (
            "command = [\"sh\", \"{out}\", \"{with.n}\"]",
            "there is no param `n`",
        ),
        (
            "command = [\"sh\", \"{out}\"]\nwith = { n = 1 }",
            "the command has no {with.n}",
        ),
        (
            "command = [\"{with.n}\", \"{out}\"]\nwith = { n = \"rm\" }",
            "the program itself is in the command",
        ),
        (
            "command = [\"./a\", \"{out}\"]",
            "write {here}/./a and name it in `files`",
        ),
        ("command = [\"sh\", \"{out\"]", "a brace is open"),
        (
            "command = [\"sh\", \"{out}\"]\nfiles = [\"../a\"]",
            "no `..`",
        ),
        (
            "command = [\"sh\", \"{out}\"]\nfiles = [\"gone.py\"]",
            "gone.py: No such file",
        ),
        (
            "command = [\"sh\", \"{out}\"]\nenv = [\"A=1\"]",
            "a variable is called by letters",
        ),
        (
            "command = [\"sh\", \"{out}\"]\ntimeout_s = 0",
            "must be a number above 0",
        ),
        (
            "command = [\"sh\", \"{out}\"]\nidentity = [\"echo\", \"{out}\"]",
            "no placeholder but {here}",
        ),
        (
            "command = [\"sh\", \"{out}\"]\nnetwork = 1",
            "must be true or false",
        ),
    ];
    for (more, reported) in cases {
        let text = format!("[node.x]\nstage = \"exec\"\nout = \"text\"\n{more}\n");
        let mistakes = place.open(&text, &[]).err().unwrap_or_default();
        assert!(
            mistakes.contains(reported) && mistakes.contains("x.toml:"),
            "{more}: {mistakes}"
        );
    }
    let of = |text: &str| place.open(text, &[]).err().unwrap_or_default();
    let out = of("[node.x]\nstage = \"exec\"\nout = \"texts\"\ncommand = [\"sh\", \"{out}\"]\n");
    assert!(out.contains("did you mean `text`"), "{out}");
    let out = of("[node.x]\nstage = \"exec\"\ncommand = [\"sh\", \"{out}\"]\n");
    assert!(out.contains("of text, pages"), "{out}");
    let beside = of("[node.x]\nstage = \"exec\"\nout = \"pages\"\ncommand = [\"sh\", \"{out}\"]\n");
    assert!(beside.contains("pages are read with text"), "{beside}");
    let unread = of(
        "[node.x]\nstage = \"exec\"\nout = \"text\"\nfrom = { a = \"@src\" }\ncommand = [\"sh\", \"{out}\"]\n",
    );
    assert!(unread.contains("the command has no {from.a}"), "{unread}");
    let own = of("[node.x]\nstage = \"text.take\"\nfrom = { files = \"@src\" }\ntimeout_s = 3\n");
    assert!(
        own.contains("only a node with `stage = \"exec\"` has `timeout_s`"),
        "{own}"
    );
}
