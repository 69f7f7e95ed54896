//! Pipelines that begin with a foreign program: what they are over, and what their keys hold.

use tailor::catalog::CATALOG;
use tailor::graph::Graph;
use tailor::key::provenance;
use tailor::recipe::{Overrides, Pipeline};

fn over(name: &str, under: &str) -> Graph {
    let pipeline = Pipeline::built_in_over(name, under, &CATALOG);
    let graph = pipeline.and_then(|p| p.graph(&Overrides::default()));
    graph.unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn a_video_and_raw_photos_go_before_every_pipeline_that_measures() {
    for name in ["video", "raw"] {
        for under in ["body", "own-masks", "walk", "doctor"] {
            let graph = over(name, under);
            let inputs: Vec<&str> = graph.inputs.iter().map(|i| i.name.as_str()).collect();
            assert!(
                inputs.contains(&"photos") && inputs.contains(&name),
                "{under}: {inputs:?}"
            );
            let own = Pipeline::built_in(under, &CATALOG).unwrap();
            let own = own.graph(&Overrides::default()).unwrap();
            assert_eq!(
                graph.nodes.len(),
                own.nodes.len() + 1,
                "{name} over {under}"
            );
        }
    }
    assert!(Pipeline::built_in_over("no-such", "body", &CATALOG).is_err());
}

#[test]
fn versions_of_foreign_programs_are_in_the_key_and_nowhere_else() {
    let graph = over("video", "body");
    for node in &graph.nodes {
        let inputs = vec![None; node.ports.len()];
        let provenance = provenance(node, &inputs).0;
        let programs = provenance
            .iter()
            .filter(|(what, _)| what.starts_with("program "));
        let programs: Vec<&(String, String)> = programs.collect();
        let installed: Vec<String> = node
            .stage
            .programs()
            .iter()
            .map(|(n, v)| format!("{n} {v}"))
            .collect();
        let in_key: Vec<String> = programs
            .iter()
            .map(|(what, version)| format!("{} {version}", &what["program ".len()..]))
            .collect();
        assert_eq!(in_key, installed, "{}", node.name);
        assert_eq!(
            in_key.len(),
            if node.name == "frames" { 2 } else { 0 },
            "{}",
            node.name
        );
        assert!(
            in_key
                .iter()
                .all(|t| t.split(' ').nth(1).is_some_and(|v| !v.is_empty()))
        );
    }
}
