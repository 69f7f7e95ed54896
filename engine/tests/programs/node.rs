//! A program is a node as any other: what it gets, its key, its progress.

use crate::application::{Pages, Place, Text, done, is_made, shell};
use crate::sandboxed::full_sandbox;
use engine::plan::{State, plan};
use engine::store::retention::{Budget, gc};
use engine::verify;
use engine::walk::Watch;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

/// A program that is installed here, of this version; where it is. It prints its version.
pub(crate) fn installed(place: &Place, version: &str) -> PathBuf {
    for folder in ["tool/bin", "tool/lib"] {
        std::fs::create_dir_all(place.path(folder)).unwrap();
    }
    place.write("tool/lib/version", version);
    let tool = place.path("tool/bin/tool");
    if !tool.exists() {
        place.write(
            "tool/bin/tool",
            "#!/bin/sh\ncat $(dirname $0)/../lib/version\n",
        );
        std::fs::set_permissions(&tool, PermissionsExt::from_mode(0o755)).unwrap();
    }
    tool
}

const COPY: &str = "[node.x]\nstage = \"exec\"\nout = \"text\"\nfrom = { given = \"@src\" }\n\
     command = [\"sh\", \"{here}/copy.sh\", \"{from.given}\", \"{out}\", \"{with.size}\"]\n\
     files = [\"copy.sh\"]\nwith = { size = 3 }\n";

#[test]
fn a_program_is_found_again_until_something_of_it_changes() {
    let place = Place::new();
    place.write("copy.sh", "head -c $3 $1/a.txt > $2\n");
    let made = |sets: &[&str]| {
        let graph = place.open(COPY, sets).unwrap();
        let outcome = place.made(&graph);
        assert_eq!(outcome.failure(&graph), None);
        let text = outcome.read::<Text>("x").unwrap().0.clone();
        (text, is_made(&outcome, &graph, "x"))
    };
    assert_eq!(made(&[]), ("one".into(), true));
    assert_eq!(made(&[]), ("one".into(), false));
    assert_eq!(made(&["x.size=5"]), ("one t".into(), true));
    assert_eq!(made(&[]), ("one".into(), false));
    place.write("copy.sh", "head -c $3 $1/a.txt > $2 # the same\n");
    assert_eq!(made(&[]), ("one".into(), true));
    place.write("src/a.txt", "two\n");
    assert_eq!(made(&[]), ("two".into(), true));
    std::fs::create_dir(place.path("src/b")).unwrap();
    assert_eq!(made(&[]), ("two".into(), false));
}

#[test]
fn keys_of_programs_know_no_places() {
    let keys = [Place::new(), Place::new()].map(|place| {
        place.write("copy.sh", "head -c $3 $1/a.txt > $2\n");
        let graph = place.graph(COPY);
        let outcome = place.made(&graph);
        let done = done(&outcome, &graph, "x");
        let whole = format!("{:?}", done.provenance);
        assert!(!whole.contains(place.path("").to_str().unwrap()), "{whole}");
        (done.key, done.content)
    });
    assert_eq!(keys[0], keys[1]);
}

#[test]
fn what_comes_out_equal_reruns_nothing_downstream() {
    let place = Place::new();
    place.write("copy.sh", "head -c $3 $1/a.txt | wc -l > $2\n");
    let nodes = COPY.replace("node.x", "node.first")
        + "[node.x]\nstage = \"text.length\"\nfrom = { text = \"first\" }\n";
    let made = |sets: &[&str]| {
        let graph = place.open(&nodes, sets).unwrap();
        let outcome = place.made(&graph);
        ["first", "x"].map(|node| is_made(&outcome, &graph, node))
    };
    assert_eq!(made(&[]), [true, true]);
    assert_eq!(made(&["first.size=4"]), [true, false]);
}

#[test]
fn artifacts_are_laid_out_as_their_kinds_are_written() {
    let place = Place::new();
    let first = "[node.first]\nstage = \"text.take\"\nfrom = { files = \"@src\" }\n";
    let loud = "[node.x]\nstage = \"exec\"\nout = \"text\"\nfrom = [\"first\"]\n\
         command = [\"sh\", \"-c\", 'cat \"$1\" \"$2\" > \"$3\"', \"sh\", \"{from.first}\", \"{from.first:loud}\", \"{out}\"]\n";
    assert_eq!(place.text(&format!("{first}{loud}")), "one two\nONE TWO\n");
    let pages = "[node.pages]\nstage = \"exec\"\nout = \"pages\"\nfrom = { names = \"first\" }\n\
         command = [\"sh\", \"-c\", 'for n in one two; do echo \"p $n\" > \"$1/$n.txt\"; done', \"sh\", \"{out}\"]\n";
    let x = "[node.x]\nstage = \"exec\"\nout = \"text\"\nfrom = [\"pages\"]\n\
         command = [\"sh\", \"-c\", 'cat \"$1\"/* > \"$2\"', \"sh\", \"{from.pages}\", \"{out}\"]\n";
    let graph = place.graph(&format!("{first}{pages}{x}"));
    let outcome = place.made(&graph);
    assert_eq!(outcome.failure(&graph), None);
    assert_eq!(outcome.read::<Text>("x").unwrap().0, "p one\np two\n");
    let node = graph.node("pages").unwrap();
    let pages = outcome.artifact(&graph, node).unwrap();
    assert_eq!(pages.downcast::<Pages>().unwrap().0.len(), 2);
}

#[test]
fn a_program_gets_a_cleared_environment_and_a_folder_of_its_own() {
    let place = Place::new();
    let line = "env | sed 's/=.*//' | sort | tr '\\n' ' ' > $1; pwd | sed 's,.*/,,' >> $1; ls -A | wc -l >> $1";
    let printed = place.text(&shell(
        line,
        "env = [\"CARGO_MANIFEST_DIR\", \"NOT_THERE\"]\n",
    ));
    let names: Vec<&str> = printed.split_whitespace().collect();
    let shells = ["PWD", "SHLVL", "_", "OLDPWD", "STAGE_EXEC_FOLDER"];
    let names: Vec<&str> = names.into_iter().filter(|n| !shells.contains(n)).collect();
    let own = ["CARGO_MANIFEST_DIR", "HOME", "LC_ALL", "PATH", "TMPDIR"];
    assert_eq!(names, [&own[..], &["work", "0"]].concat());
}

#[test]
fn progress_is_shown_and_is_not_among_the_last_lines() {
    #[derive(Default)]
    struct Heard(Mutex<Vec<usize>>);
    impl Watch for Heard {
        fn progress(&self, _: &str, _: &str, done: usize, of: usize) {
            assert_eq!(of, 100);
            self.0.lock().unwrap().push(done);
        }
    }
    let place = Place::new();
    let line = "echo '{\"progress\": 0.4}'; echo '{\"progress\": 7}'; echo '{\"progress\": true}'; echo {; exit 4";
    let graph = place.graph(&shell(line, ""));
    place.allow(&graph);
    let heard = Heard::default();
    let outcome = place.run(&graph, &heard, &false.into()).unwrap();
    let why = outcome.failure(&graph).unwrap().1;
    assert!(why.contains("exit code 4") && !why.contains("0.4"), "{why}");
    assert!(why.contains("| {\"progress\": true}\n  | {"), "{why}");
    assert_eq!(heard.0.into_inner().unwrap().last(), Some(&100));
}

#[test]
fn an_identity_is_in_the_key_and_why_tells_it() {
    let place = Place::new();
    let tool = installed(&place, " 1.0\n\n");
    let nodes = shell("echo hi > $1", &format!("identity = [{tool:?}]\n"));
    let made = |nodes: &str| {
        let graph = place.graph(nodes);
        let outcome = place.made(&graph);
        let made = is_made(&outcome, &graph, "x");
        (made, done(&outcome, &graph, "x").provenance.clone())
    };
    let (first, provenance) = made(&nodes);
    let identity = ("identity".to_owned(), "\"1.0\"".to_owned());
    assert!(first && provenance.contains(&identity), "{provenance:?}");
    assert!(!made(&nodes).0);
    installed(&place, "1.1\n");
    let graph = place.graph(&nodes);
    let planned = plan(&graph, &[], &graph.goal, &place.store());
    let line = ["identity", "\"1.0\"", "\"1.1\""].map(String::from);
    let line = State::Stale(vec![line.into()]);
    assert_eq!(planned[0].as_ref().unwrap().state, line);
    assert!(made(&nodes).0);
    installed(&place, "1.0\n");
    assert!(!made(&nodes).0, "a revert is found");
}

#[test]
fn a_program_that_is_not_the_same_twice_is_found() {
    let place = Place::new();
    let graph = place.graph(&shell("date +%N > $1", ""));
    let outcome = place.made(&graph);
    let options = place.options();
    let again = |_: &str| {};
    let found = verify::verify(&graph, &[], &outcome, &options, &false.into(), &again).unwrap();
    assert_eq!(found.len(), 1);
    assert!(found[0].what.contains("not deterministic"), "{found:?}");
    let steady = place.graph(&shell("echo 1 > $1", ""));
    let outcome = place.made(&steady);
    let found = verify::verify(&steady, &[], &outcome, &options, &false.into(), &again);
    assert_eq!(found.unwrap(), vec![]);
}

#[test]
fn where_bubblewrap_is_a_program_writes_nowhere_else_and_reaches_no_network() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let reach =
        format!("timeout 5 bash -c 'exec 3<>/dev/tcp/127.0.0.1/{port}' 2>/dev/null; echo $? > $1");
    assert_ne!(place.text(&shell(&reach, "")), "0\n");
    assert_eq!(place.text(&shell(&reach, "network = true\n")), "0\n");
    let keys = "test -e /etc/ssl/private || test -e /etc/shadow; echo $? > $1";
    assert_ne!(place.text(&shell(keys, "network = true\n")), "0\n");
    let other = place.path("other");
    let line = format!("echo x > {}; echo $? > $1", other.display());
    assert_ne!(place.text(&shell(&line, "")), "0\n");
    assert!(!other.exists());
    let read_only = "[node.x]\nstage = \"exec\"\nout = \"text\"\nfrom = { src = \"@src\" }\n\
         command = [\"sh\", \"-c\", 'chmod u+w $2/a.txt; echo x > $2/a.txt; echo $? > $1', \"sh\", \"{out}\", \"{from.src}\"]\n";
    assert_ne!(place.text(read_only), "0\n");
    assert_eq!(
        std::fs::read_to_string(place.path("src/a.txt")).unwrap(),
        "one two\n"
    );
}

#[test]
fn what_a_killed_run_left_is_ended_and_removed() {
    let place = Place::new();
    let store = place.store();
    let stale = store.root().join("exec/4194399-0-1f/work");
    std::fs::create_dir_all(&stale).unwrap();
    let folder = stale.parent().unwrap().canonicalize().unwrap();
    let mut orphan = std::process::Command::new("sleep")
        .arg("60")
        .env("STAGE_EXEC_FOLDER", &folder)
        .spawn()
        .unwrap();
    let start = Instant::now();
    assert_eq!(place.text(&shell("echo 1 > $1", "")), "1\n");
    assert!(!orphan.wait().unwrap().success() && start.elapsed().as_secs() < 50);
}

#[test]
fn gc_and_forget_clear_what_killed_programs_left_and_nothing_behind_a_link() {
    let place = Place::new();
    let store = place.store();
    let exec = store.root().join("exec");
    let (stale, apart) = (exec.join("4194399-0-1f"), store.root().join("../apart"));
    let (linked, strange) = (exec.join("4194399-1-1f"), exec.join("notes"));
    let whole = Budget {
        most: u64::MAX,
        keep_runs: 1,
        keep_records: 1,
    };
    let sweeps: [&dyn Fn(); 2] = [&|| drop(gc(&store, &whole, false).unwrap()), &|| {
        drop(engine::store::forget(&store, &exec).unwrap())
    }];
    for sweep in sweeps {
        for folder in [&stale, &apart, &strange] {
            std::fs::create_dir_all(folder.join("in")).unwrap();
            std::fs::write(folder.join("in/photo.jpg"), "private").unwrap();
        }
        if !linked.is_symlink() {
            std::os::unix::fs::symlink(&apart, &linked).unwrap();
        }
        gc(&store, &whole, true).unwrap();
        assert!(stale.exists(), "a dry run removes nothing");
        sweep();
        assert!(!stale.exists());
        assert!(apart.join("in/photo.jpg").exists() && strange.join("in/photo.jpg").exists());
    }
}
