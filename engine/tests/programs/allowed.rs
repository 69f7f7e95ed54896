//! Nothing runs that the user has not allowed, and what was allowed is that and nothing else.

use crate::application::{Place, shell};
use engine::plan::{State, plan};
use std::os::unix::fs::PermissionsExt;

const NODE: &str = "[node.x]\nstage = \"exec\"\nout = \"text\"\n\
     command = [\"sh\", \"{here}/a.sh\", \"{out}\", \"{with.n}\", \"{with.word}\"]\n\
     files = [\"a.sh\"]\nwith = { n = 1, word = \"a\" }\n";

fn runs(place: &Place, nodes: &str, sets: &[&str]) -> Result<(), String> {
    let graph = place.open(nodes, sets).unwrap();
    let outcome = place.run(&graph, &(), &false.into())?;
    match outcome.failure(&graph) {
        Some((_, why)) => panic!("{why}"),
        None => Ok(()),
    }
}

#[test]
fn nothing_runs_that_was_not_allowed() {
    let place = Place::new();
    place.write("a.sh", "echo $2 $3 > $1\n");
    let reported = runs(&place, NODE, &[]).unwrap_err();
    let lines = [
        "x: sh {here}/a.sh {out} {with.n} {with.word}",
        "with word = \"a\"",
        "file \"a.sh\"",
        "--allow-exec",
    ];
    assert!(
        lines.iter().all(|line| reported.contains(line)),
        "{reported}"
    );
    place.allow(&place.graph(NODE));
    runs(&place, NODE, &[]).unwrap();
    // Numbers may change, free text may not.
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
    assert!(place.run(&graph, &(), &false.into()).is_err());
}

#[test]
fn a_permission_that_came_with_a_cache_is_none() {
    let place = Place::new();
    let graph = place.graph(&shell("echo downloaded > $1", ""));
    let permission = graph.nodes[0].program.as_ref().unwrap().permission();
    // As it lay in a cache that somebody hands out with a pipeline.
    let folder = place.store().root().join("allowed");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::set_permissions(&folder, PermissionsExt::from_mode(0o700)).unwrap();
    let file = folder.join(permission.to_hex().as_str());
    std::fs::write(&file, "x: sh\n").unwrap();
    std::fs::set_permissions(&file, PermissionsExt::from_mode(0o600)).unwrap();
    let reported = place.run(&graph, &(), &false.into()).err();
    assert!(reported.expect("it is refused").contains("--allow-exec"));
}

#[test]
fn to_stay_is_a_permission_of_its_own() {
    let place = Place::new();
    let node = "[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [\"sh\", \"-c\", \"echo stay > $0\", \"{out}\"]\n";
    place.allow(&place.graph(node));
    runs(&place, node, &[]).unwrap();
    let reported = runs(&place, &format!("{node}keep = true\n"), &[]).unwrap_err();
    assert!(reported.contains("stays for further jobs"), "{reported}");
}

#[test]
fn what_it_may_read_and_what_is_at_its_place_are_parts_of_a_permission() {
    let place = Place::new();
    place.write("tool", "#!/bin/sh\necho one > $1\n");
    let tool = place.path("tool");
    std::fs::set_permissions(&tool, PermissionsExt::from_mode(0o700)).unwrap();
    let node =
        format!("[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [{tool:?}, \"{{out}}\"]\n");
    place.allow(&place.graph(&node));
    runs(&place, &node, &[]).unwrap();
    let reported = runs(&place, &format!("{node}reads = [\"/usr/share\"]\n"), &[]).unwrap_err();
    assert!(reported.contains("may read \"/usr/share\""), "{reported}");
    place.write("tool", "#!/bin/sh\necho two > $1\n");
    runs(&place, &node, &[]).unwrap_err();
}

#[test]
fn a_file_of_a_nodes_is_no_link_to_what_is_elsewhere() {
    let place = Place::new();
    let elsewhere = tempfile::NamedTempFile::new().unwrap();
    std::os::unix::fs::symlink(elsewhere.path(), place.path("model.bin")).unwrap();
    place.write("own.bin", "");
    std::os::unix::fs::symlink("own.bin", place.path("same.bin")).unwrap();
    let node = |file: &str| {
        format!(
            "[node.x]\nstage = \"exec\"\nout = \"text\"\ncommand = [\"sh\", \"{{out}}\"]\nfiles = [\"{file}\"]\n"
        )
    };
    let reported = place
        .open(&node("model.bin"), &[])
        .err()
        .unwrap_or_default();
    assert!(
        reported.contains("is a link out of the pipeline's folder"),
        "{reported}"
    );
    place.graph(&node("same.bin"));
}
