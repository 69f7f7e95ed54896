//! Pipelines that extend other pipelines, and params that nodes share.

use crate::toys::CATALOG;
use engine::graph::Graph;
use engine::recipe::{Mistakes, Overrides, Pipeline};
use std::path::Path;
use tempfile::TempDir;

const BASE: &str = "goal = [\"final\", \"other\"]\n[params]\nn = 4\n[input.src]\nfiles = \"*.txt\"\n\
    [node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n\
    [node.mid]\nstage = \"toy.mid\"\nfrom = [\"clean\"]\nwith = { n = \"$n\" }\n\
    [node.final]\nstage = \"toy.mid\"\nfrom = { text = \"mid\" }\nwith = { n = \"$n\", sleep_ms = 1 }\n\
    [node.other]\nstage = \"toy.mid\"\nfrom = { text = \"clean\" }\n\
    [variant.more]\nwith.params = { n = 9 }\n\
    [sweep.s]\nover.params = { n = [1, 2] }\ntell = \"other.seconds\"\n";

/// `base.toml` and `own.toml` in a folder, the second opened.
fn opened(own: &str, overrides: &Overrides) -> (Result<Graph, Mistakes>, TempDir) {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("base.toml"), BASE).unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(&path, own).unwrap();
    let graph = Pipeline::read(&path, &CATALOG).and_then(|p| p.graph(overrides));
    (graph, folder)
}

fn graph(own: &str, variant: Option<&str>, sets: &[&str]) -> Graph {
    let overrides = Overrides {
        variant: variant.map(str::to_owned),
        sets: sets.iter().map(|s| (*s).to_owned()).collect(),
    };
    opened(own, &overrides).0.unwrap_or_else(|m| panic!("{m}"))
}

#[track_caller]
fn wrong(own: &str, file: &str, place: [u64; 2], what: &str) {
    let (graph, _) = opened(own, &Overrides::default());
    let Err(mistakes) = graph else {
        panic!("no mistake was found")
    };
    let found = &mistakes.json()["mistakes"][0];
    let name = Path::new(found["file"].as_str().unwrap());
    assert!(name.ends_with(file), "{mistakes}");
    assert_eq!([&found["line"], &found["column"]], place, "{mistakes}");
    let error = found["what"].as_str().unwrap();
    assert!(error.contains(what), "{error}");
}

/// The names of the nodes, and a param of one.
fn names(graph: &Graph) -> Vec<&str> {
    graph.nodes.iter().map(|n| n.name.as_str()).collect()
}

fn n(graph: &Graph, node: &str) -> String {
    let params = &graph.nodes[graph.node(node).unwrap()].params.values;
    let (_, value) = params.iter().find(|(name, _)| *name == "n").unwrap();
    value.to_string()
}

#[test]
fn what_is_not_set_is_inherited_and_what_the_goal_does_not_need_is_left_out() {
    let graph = graph(
        "extends = \"base.toml\"\ngoal = [\"final\"]\n[node.mid]\nwith = { n = 2 }\n",
        None,
        &[],
    );
    assert_eq!(names(&graph), ["clean", "mid", "final"]);
    assert_eq!(n(&graph, "mid"), "2");
    assert_eq!(n(&graph, "final"), "4");
}

#[test]
fn ports_are_rewired_one_by_one_and_nodes_added_and_taken_out() {
    let own = "extends = \"base.toml\"\nwithout = \"mid\"\n\
        [node.new]\nstage = \"toy.mid\"\nfrom = [\"clean\"]\n[node.other]\nfrom = { text = \"new\" }\n";
    let graph = graph(own, None, &[]);
    let mut found = names(&graph);
    found.sort_unstable();
    assert_eq!(found, ["clean", "final", "new", "other"]);
    let other = &graph.nodes[graph.node("other").unwrap()];
    let source = engine::graph::Source::Node(graph.node("new").unwrap());
    assert_eq!(other.from, [Some(source)]);
}

#[test]
fn a_shared_param_reaches_all_that_read_it_by_variant_and_by_set() {
    let own = "extends = \"base.toml\"\n";
    for (variant, set, value) in [
        (None, "params.n=7", "7"),
        (Some("more"), "final.sleep_ms=2", "9"),
    ] {
        let graph = graph(own, variant, &[set]);
        assert_eq!([n(&graph, "mid"), n(&graph, "final")], [value, value]);
        assert_eq!(
            graph.holders("params", "n"),
            [graph.node("mid").unwrap(), graph.node("final").unwrap()]
        );
    }
}

#[test]
fn mistakes_name_the_file_that_has_their_line() {
    let own = |rest: &str| format!("extends = \"base.toml\"\n{rest}");
    wrong(&own("[params]\nn = \"x\"\n"), "own.toml", [3, 5], "`n`");
    let nobody = "[node.mid]\nwith = { n = 1 }\n[node.final]\nwith = { n = 1 }\n[params]\nn = 4\n";
    wrong(&own(nobody), "own.toml", [7, 1], "no node reads");
    wrong(
        &own(
            "[input.src]\nfiles = \"*.txt\"\n[node.mid]\nstage = \"toy.mid\"\nfrom = [\"@src\"]\n",
        ),
        "own.toml",
        [6, 9],
        "files",
    );
    wrong(&own("[node.extra]\n"), "own.toml", [2, 7], "no `stage`");
    wrong(&own("without = \"gone\"\n"), "own.toml", [2, 11], "gone");
    wrong(
        "extends = \"x.toml\"\n",
        "own.toml",
        [1, 11],
        "cannot be read",
    );
    wrong("extends = \"own.toml\"\n", "own.toml", [1, 11], "in turn");
    // The inherited node reads what the new stage does not make: the base's line is wrong now.
    let files = "[node.clean]\nstage = \"toy.nothing\"\n";
    wrong(&own(files), "own.toml", [3, 9], "no stage `toy.nothing`");
    wrong(
        &own("[variant.bad]\nwith.params = { m = 1 }\n"),
        "own.toml",
        [3, 17],
        "shared param",
    );
    wrong(
        &own("[sweep.bad]\nover.params = { n = [1, \"x\"] }\n"),
        "own.toml",
        [3, 25],
        "`n`",
    );
    let (graph, folder) = opened("extends = \"middle.toml\"\n", &Overrides::default());
    assert!(graph.is_err());
    std::fs::write(
        folder.path().join("middle.toml"),
        "extends = \"base.toml\"\n[node.mid]\nwith = { m = 1 }\n",
    )
    .unwrap();
    let path = folder.path().join("own.toml");
    let found = Pipeline::read(&path, &CATALOG).and_then(|p| p.graph(&Overrides::default()));
    let text = found.err().unwrap().to_string();
    assert!(text.contains("middle.toml:3:10"), "{text}");
}

#[test]
fn an_inherited_sweep_goes_over_shared_params_and_one_that_lost_a_node_is_left_out() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("base.toml"), BASE).unwrap();
    let sweeps = |own: &str| {
        let path = folder.path().join("own.toml");
        std::fs::write(&path, own).unwrap();
        let pipeline = Pipeline::read(&path, &CATALOG).unwrap();
        pipeline.graph(&Overrides::default()).unwrap();
        pipeline.recipe().sweeps.len()
    };
    assert_eq!(sweeps("extends = \"base.toml\"\n"), 1);
    assert_eq!(sweeps("extends = \"base.toml\"\ngoal = \"final\"\n"), 0);
    let other = "[node.other]\nstage = \"toy.mid\"\nfrom = { text = \"clean\" }\n";
    assert_eq!(sweeps(&format!("extends = \"base.toml\"\n{other}")), 0);
}

#[cfg(unix)]
#[test]
fn what_has_no_end_or_is_no_plain_file_is_not_extended() {
    let folder = TempDir::new().unwrap();
    let (pipe, large) = (folder.path().join("pipe"), folder.path().join("large.toml"));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let file = std::fs::File::create(&large).unwrap();
    file.set_len(300 << 20).unwrap();
    for (name, why) in [
        ("pipe", "is a device, a pipe or a socket"),
        ("/dev/zero", "is a device, a pipe or a socket"),
        ("large.toml", "is larger than 268 MB"),
        (".", "is a folder"),
    ] {
        let path = folder.path().join("own.toml");
        std::fs::write(&path, format!("extends = \"{name}\"\n")).unwrap();
        let (reported, hears) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            let read = Pipeline::read(&path, &CATALOG);
            let read = read.and_then(|read| read.graph(&Overrides::default()));
            reported.send(read.err().map(|mistakes| mistakes.to_string()))
        });
        let reported = hears.recv_timeout(std::time::Duration::from_secs(10));
        let reported = reported.expect("it is refused at once").unwrap_or_default();
        assert!(
            reported.contains(&format!("`{name}` ")) && reported.contains(why),
            "{reported}"
        );
    }
}

#[test]
fn of_a_file_that_is_no_toml_nothing_is_quoted() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(
        folder.path().join("accounts"),
        "about = \"x\"\nroot:secret:0\n",
    )
    .unwrap();
    std::fs::write(&path, "extends = \"accounts\"\n").unwrap();
    let read = Pipeline::read(&path, &CATALOG);
    let read = read.and_then(|read| read.graph(&Overrides::default()));
    let mistakes = read.err().expect("it is no pipeline");
    let reported = format!("{mistakes}{}", mistakes.json());
    assert!(
        reported.contains("`accounts` is no TOML: line 2, column 14"),
        "{reported}"
    );
    assert!(reported.contains("own.toml:1:11"), "{reported}");
    assert!(
        !reported.contains("secret") && !reported.contains("root"),
        "{reported}"
    );
}
