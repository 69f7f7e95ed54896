//! The pipelines that ship, and the mistakes reported of a pipeline file.

use std::path::Path;
use tailor::catalog::CATALOG;
use tailor::graph::{Bound, Graph};
use tailor::recipe::{Overrides, Pipeline, open, open_text};

fn shipped() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines");
    let inside = |folder: &Path| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.map(|e| e.unwrap().path()).collect::<Vec<_>>()
    };
    // Those with foreign programs are with them in a folder.
    let mut files = inside(&folder);
    files.extend(inside(&folder.join("foreign")));
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    assert!(files.len() >= 15);
    files
}

#[test]
fn every_shipped_pipeline_has_no_mistake() {
    for path in shipped() {
        if let Err(mistakes) = open(&path, &Overrides::default(), &CATALOG) {
            panic!("{mistakes}");
        }
    }
}

#[test]
fn a_first_answer_reads_all_that_the_whole_way_reads() {
    let open_ports = |graph: &Graph, name: &str| {
        let node = &graph.nodes[graph.node(name).unwrap()];
        node.from.iter().map(Option::is_none).collect::<Vec<_>>()
    };
    for name in ["body", "own-masks", "walk", "walk-own-masks"] {
        let of = |variant: Option<&str>| {
            let overrides = Overrides {
                variant: variant.map(str::to_owned),
                ..Overrides::default()
            };
            let graph = Pipeline::built_in(name, &CATALOG).and_then(|p| p.graph(&overrides));
            graph.unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"))
        };
        let (whole, fast) = (of(None), of(Some("fast")));
        for node in ["landmarks", "girths", "report", "textured"] {
            let ports = [&whole, &fast].map(|graph| open_ports(graph, node));
            assert_eq!(ports[0], ports[1], "{name}: {node}");
        }
        if !name.starts_with("walk") {
            let first = of(Some("first"));
            for node in ["masks", "landmarks", "girths"] {
                let ports = [&whole, &first].map(|graph| open_ports(graph, node));
                assert_eq!(ports[0], ports[1], "{name}: {node}");
            }
        }
    }
}

#[test]
fn the_product_has_the_nodes_that_its_files_come_from() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/body.toml");
    let graph = open(&path, &Overrides::default(), &CATALOG).unwrap();
    for node in ["girths", "landmarks", "cameras", "masks", "hull", "report"] {
        assert!(graph.node(node).is_some(), "{node}");
    }
}

/// The mistakes of a text, as `line:column what`.
#[track_caller]
fn mistakes(text: &str) -> Vec<String> {
    let found = open_text("p.toml", text, &Overrides::default(), &CATALOG);
    let Err(mistakes) = found else {
        panic!("no mistake was found")
    };
    let json = mistakes.json();
    let one = |m: &serde_json::Value| {
        format!(
            "{}:{} {}",
            m["line"],
            m["column"],
            m["what"].as_str().unwrap()
        )
    };
    json["mistakes"]
        .as_array()
        .unwrap()
        .iter()
        .map(one)
        .collect()
}

const HEAD: &str = "goal = \"photos\"\n[input.files]\nfiles = \"*.jpg\"\n[node.photos]\n";

#[test]
fn a_slip_in_a_stage_is_named_with_its_place_and_what_was_meant() {
    let list = mistakes(&format!(
        "{HEAD}stage = \"capture.lode\"\nfrom = {{ files = \"@files\" }}\n"
    ));
    assert!(
        list[0].starts_with("5:9 there is no stage `capture.lode`; did you mean `capture.load`?"),
        "{list:?}"
    );
}

#[test]
fn params_are_checked_for_name_type_and_range_all_at_once() {
    let with = "with = { fewest = 1, fewst = 4 }";
    let list = mistakes(&format!(
        "{HEAD}stage = \"capture.load\"\nfrom = {{ files = \"@files\" }}\n{with}\n"
    ));
    assert!(
        list.iter().any(|t| t.contains("did you mean `fewest`")),
        "{list:?}"
    );
    assert!(
        list.iter()
            .any(|t| t.starts_with("7:19") && t.contains("3..=1000")),
        "{list:?}"
    );
}

#[test]
fn circles_unused_nodes_and_wrong_kinds_are_refused() {
    let circle = "goal = \"a\"\n[node.a]\nstage = \"pose.frame\"\nfrom = { cameras = \"b\", photos = \"p\" }\n\
                  [node.b]\nstage = \"pose.frame\"\nfrom = { cameras = \"a\", photos = \"p\" }\n\
                  [input.f]\nfiles = \"*\"\n[node.p]\nstage = \"capture.load\"\nfrom = { files = \"@f\" }\n";
    assert!(
        mistakes(circle)
            .iter()
            .any(|t| t.contains("in a circle: a, b"))
    );
    let unused = format!(
        "{HEAD}stage = \"capture.load\"\nfrom = {{ files = \"@files\" }}\n[node.tags]\nstage = \"pose.tags\"\nfrom = [\"photos\"]\n"
    );
    assert!(
        mistakes(&unused)
            .iter()
            .any(|t| t.contains("does not need node `tags`"))
    );
    let kind = "goal = \"t\"\n[input.f]\nfiles = \"*\"\n[node.t]\nstage = \"pose.tags\"\nfrom = { photos = \"@f\" }\n";
    assert!(
        mistakes(kind)
            .iter()
            .any(|t| t.contains("port `photos` wants photos, but `@f` makes files"))
    );
}

#[test]
fn broken_toml_is_a_mistake_with_a_place() {
    let list = mistakes("goal = \n[node");
    assert!(
        list.len() >= 2 && list.iter().all(|t| !t.starts_with("null")),
        "{list:?}"
    );
}

#[test]
fn a_set_must_name_a_node_and_a_param() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/body.toml");
    let with = |set: &str| {
        open(
            &path,
            &Overrides {
                variant: None,
                sets: vec![set.into()],
            },
            &CATALOG,
        )
    };
    // Although nobody reads the shared param then.
    assert!(with("hull.voxel_mm=4").is_ok());
    for (set, part) in [
        ("hul.voxel_mm=4", "did you mean `hull`"),
        ("hull.voxel_mm=0.01", "out of range"),
        ("hull.voxel=4", "there is no param `voxel`"),
        ("nonsense", "give NODE.PARAM=VALUE"),
    ] {
        let Err(error) = with(set) else {
            panic!("{set} was taken")
        };
        assert!(error.to_string().contains(part), "{error}");
    }
}

#[test]
fn the_schema_for_editors_knows_every_stage_with_its_ports_and_params() {
    let schema = command::schema::schema(tailor::catalog::stages());
    let rules = &schema["properties"]["node"]["additionalProperties"]["allOf"];
    for stage in tailor::catalog::stages() {
        let rules = rules.as_array().unwrap();
        let of = |r: &&serde_json::Value| r["if"]["properties"]["stage"]["const"] == stage.name();
        let rule = &rules.iter().find(of).unwrap()["then"]["properties"];
        for port in stage.ports() {
            let ports = &rule["from"]["then"];
            assert!(ports["properties"][port.name].is_object(), "{}", port.name);
            let needed = ports["required"].as_array().unwrap();
            assert_eq!(needed.iter().any(|n| n == port.name), !port.optional);
        }
        for param in stage.params() {
            let property = &rule["with"]["properties"][param.name];
            assert_eq!(property["description"], param.doc, "{}", param.name);
            assert_eq!(property["minimum"].as_f64(), param.range.map(|r| r.0));
            assert!(!property["default"].is_null());
        }
    }
}

#[test]
fn the_schema_for_editors_knows_every_key_of_the_shipped_pipelines() {
    let schema = command::schema::schema(tailor::catalog::stages());
    let properties = &schema["properties"];
    for path in shipped() {
        let text = std::fs::read_to_string(&path).unwrap();
        let pipeline: toml::Table = text.parse().unwrap();
        for (section, entries) in &pipeline {
            assert!(properties[section].is_object(), "{section}");
            for (name, entry) in entries.as_table().into_iter().flatten() {
                if section == "params" {
                    continue;
                }
                let known = &properties[section]["additionalProperties"]["properties"];
                for key in entry.as_table().unwrap().keys() {
                    assert!(known[key].is_object(), "{section}.{name}.{key}");
                }
            }
        }
    }
}

#[test]
fn every_shipped_pipeline_and_each_of_its_variants_is_without_mistake() {
    let mut count = 0;
    for path in shipped() {
        let text = std::fs::read_to_string(&path).unwrap();
        let named = text.lines().filter_map(|l| l.strip_prefix("[variant."));
        let variants = named
            .filter_map(|l| l.strip_suffix(']'))
            .map(|v| Some(v.to_string()));
        for variant in std::iter::once(None).chain(variants) {
            let opened = open(
                &path,
                &Overrides {
                    variant: variant.clone(),
                    sets: vec![],
                },
                &CATALOG,
            );
            assert!(opened.is_ok(), "{} {variant:?}", path.display());
            count += 1;
        }
    }
    assert!(count >= 8, "only {count} looked at");
}

#[test]
fn with_own_masks_nothing_but_the_masks_is_made_otherwise() {
    let graph = |name| {
        let pipeline = Pipeline::built_in(name, &CATALOG).unwrap();
        pipeline.graph(&Overrides::default()).unwrap()
    };
    let nodes_of = |graph: &Graph| -> Vec<_> {
        let node = |n: &Bound| {
            (
                n.name.clone(),
                (n.stage.name(), format!("{:?}", n.params.values)),
            )
        };
        graph.nodes.iter().map(node).collect()
    };
    let (body, own) = (graph("body"), graph("own-masks"));
    let (body, own) = (nodes_of(&body), nodes_of(&own));
    assert_eq!(body.len(), own.len() + 5); // the steps from photos to masks
    let otherwise: Vec<_> = own.iter().filter(|n| !body.contains(n)).collect();
    assert_eq!(otherwise.len(), 1, "{otherwise:?}");
    assert_eq!(
        (otherwise[0].0.as_str(), otherwise[0].1.0),
        ("masks", "silhouette.import")
    );
}
