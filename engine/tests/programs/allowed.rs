//! Nothing runs that the user has not allowed, and what was allowed is that and nothing else.

use crate::trade::{Nobody, Place, shell};
use engine::foreign;
use engine::plan::{State, plan};
use std::os::unix::fs::PermissionsExt;

const NODE: &str = "[node.x]\nstage = \"exec\"\nout = \"text\"\n\
     command = [\"sh\", \"{here}/a.sh\", \"{out}\", \"{with.n}\", \"{with.word}\"]\n\
     files = [\"a.sh\"]\nwith = { n = 1, word = \"a\" }\n";

fn runs(place: &Place, nodes: &str, sets: &[&str]) -> Result<(), String> {
    let graph = place.open(nodes, sets).unwrap();
    let outcome = place.run(&graph, &Nobody, &false.into())?;
    match outcome.failure(&graph) {
        Some((_, why)) => panic!("{why}"),
        None => Ok(()),
    }
}

#[test]
fn nothing_runs_that_was_not_allowed() {
    let place = Place::new();
    place.write("a.sh", "echo $2 $3 > $1\n");
    let told = runs(&place, NODE, &[]).unwrap_err();
    let lines = [
        "x: sh {here}/a.sh {out} {with.n} {with.word}",
        "with word = \"a\"",
        "file \"a.sh\"",
        "--allow-exec",
    ];
    assert!(lines.iter().all(|line| told.contains(line)), "{told}");
    place.allow(&place.graph(NODE));
    runs(&place, NODE, &[]).unwrap();
    // Numbers may change, what may say anything may not.
    runs(&place, NODE, &["x.n=2"]).unwrap();
    runs(&place, NODE, &["x.word=b"]).unwrap_err();
    runs(&place, &NODE.replace("\"sh\"", "\"dash\""), &[]).unwrap_err();
    runs(&place, &format!("{NODE}network = true\n"), &[]).unwrap_err();
    runs(&place, &format!("{NODE}env = [\"USER\"]\n"), &[]).unwrap_err();
    runs(&place, &format!("{NODE}identity = [\"date\"]\n"), &[]).unwrap_err();
    runs(&place, &format!("{NODE}timeout_s = 7\n"), &[]).unwrap();
    place.write("a.sh", "echo $2 $3 >> $1\n");
    runs(&place, NODE, &[]).unwrap_err();
    place.write("a.sh", "echo $2 $3 > $1\n");
    runs(&place, NODE, &[]).unwrap();
}

#[test]
fn a_plan_runs_no_identity_that_was_not_allowed() {
    let place = Place::new();
    // A program that is slow to end is seen by the time that it takes.
    let nodes = shell(
        "echo a > $1",
        "identity = [\"sh\", \"-c\", \"sleep 30; echo 1\"]\n",
    );
    let graph = place.graph(&nodes);
    let start = std::time::Instant::now();
    let planned = plan(&graph, &[], &graph.goal, &place.store());
    assert!(start.elapsed().as_secs() < 20);
    assert!(matches!(
        planned[0].as_ref().unwrap().state,
        State::Stale(_)
    ));
    let lines = graph.nodes[0].program.as_ref().unwrap().lines();
    let identity = lines.iter().find(|(what, _)| what == "identity").unwrap();
    assert!(identity.1.starts_with("unknown until allowed"), "{lines:?}");
    assert!(place.run(&graph, &Nobody, &false.into()).is_err());
}

#[test]
fn a_permission_counts_only_where_nobody_else_may_write() {
    let place = Place::new();
    let graph = place.graph(&shell("echo a > $1", ""));
    place.allow(&graph);
    let permission = graph.nodes[0].program.as_ref().unwrap().permission();
    let store = place.store();
    assert!(foreign::is_allowed(&store, permission));
    let folder = store.root().join("allowed");
    let file = folder.join(permission.to_hex().as_str());
    for (path, open, closed) in [(&file, 0o666, 0o600), (&folder, 0o777, 0o700)] {
        let set = |mode| std::fs::set_permissions(path, PermissionsExt::from_mode(mode)).unwrap();
        set(open);
        assert!(
            !foreign::is_allowed(&store, permission),
            "{}",
            path.display()
        );
        set(closed);
        assert!(foreign::is_allowed(&store, permission));
    }
    let elsewhere = place.path("elsewhere");
    std::fs::rename(&file, &elsewhere).unwrap();
    std::os::unix::fs::symlink(&elsewhere, &file).unwrap();
    assert!(!foreign::is_allowed(&store, permission), "through a link");
}
