//! Sections of a pipeline file: girths of the user's own reach the stage that takes them, with every
//! mistake at its place; and the table of girths in the docs is the one in the code.

use stage::Value;
use std::path::Path;
use tailor::graph::Graph;
use tailor::recipe::{Mistakes, Overrides, open_text};

const SURFACE: &str = include_str!("../../pipelines/surface.toml");

fn opened(more: &str, sets: &[&str]) -> Result<Graph, Mistakes> {
    let overrides = Overrides {
        variant: None,
        sets: sets.iter().map(|s| (*s).to_owned()).collect(),
    };
    let text = format!("{SURFACE}{more}");
    open_text("p.toml", &text, &overrides, &tailor::catalog::CATALOG)
}

/// The declared girths as the node's key has them.
#[track_caller]
fn girths(more: &str, sets: &[&str]) -> String {
    let graph = opened(more, sets).unwrap_or_else(|wrong| panic!("{wrong}"));
    let node = &graph.nodes[graph.node("landmarks").unwrap()];
    let values = &node.params.values;
    let found = values.iter().find(|(name, _)| *name == "girth").unwrap();
    assert!(matches!(found.1, Value::Table(_)));
    found.1.to_string()
}

const THIGH: &str = "\n[girth.mid_thigh]\npart = \"thigh\"\nat = 0.5\n";

#[test]
fn a_declared_girth_reaches_the_stage_and_single_values_can_be_set() {
    let at = |at: &str| {
        format!("{{ \"mid_thigh\" = {{ \"at\" = {at}, \"label\" = \"\", \"part\" = \"thigh\" }} }}")
    };
    assert_eq!(girths("", &[]), "{}");
    assert_eq!(girths(THIGH, &[]), at("0.5"));
    assert_eq!(
        girths(THIGH, &["landmarks.girth.mid_thigh.at=0.4"]),
        at("0.4")
    );
    // The layout of the file is not in the key; a whole table on the command line is the same.
    let inline = "\n[girth]\nmid_thigh = { at = 0.5, part = \"thigh\" }\n";
    assert_eq!(girths(inline, &[]), at("0.5"));
    let parts = [
        "landmarks.girth.mid_thigh.at=0.5",
        "landmarks.girth.mid_thigh.part=thigh",
    ];
    assert_eq!(girths("", &parts), at("0.5"));
    let whole = "landmarks.girth={ mid_thigh = { part = \"thigh\", at = 0.5 } }";
    assert_eq!(girths("", &[whole]), at("0.5"));
}

#[test]
fn a_mistake_in_a_section_is_refused_at_its_place() {
    let lines = SURFACE.lines().count();
    for (more, row, column, what) in [
        (
            "[girth.a]\npart = \"thy\"\nat = 0.5\n",
            2,
            8,
            "`girth.a.part` \"thy\" is none of trunk",
        ),
        (
            "[girth.a]\npart = \"calf\"\nat = 1.5\n",
            3,
            6,
            "`girth.a.at` 1.5 is out of range",
        ),
        (
            "[girth.a]\npart = \"calf\"\n",
            1,
            8,
            "`girth.a.at` must be given",
        ),
        (
            "[girth.a]\npart = \"calf\"\nat = 0.5\natt = 1\n",
            4,
            1,
            "`girth.a`: there is no param `att`; did you mean `at`?",
        ),
        (
            "[girt.a]\npart = \"calf\"\nat = 0.5\n",
            1,
            2,
            "there is no key `girt`; did you mean `girth`?",
        ),
        (
            "[girth.\"../a\"]\npart = \"calf\"\nat = 0.5\n",
            1,
            8,
            "is no name",
        ),
        ("[girth]\na = 1\n", 2, 5, "must be a table"),
    ] {
        let Err(wrong) = opened(&format!("\n{more}"), &[]) else {
            panic!("no mistake in {more}")
        };
        let all = wrong.json()["mistakes"].clone();
        let found = all.as_array().unwrap().iter().any(|m| {
            m["line"] == lines + 1 + row
                && m["column"] == column
                && m["what"].as_str().unwrap().contains(what)
        });
        assert!(found, "{row}:{column} {what}: {all}");
    }
}

#[test]
fn a_section_that_no_node_takes_is_refused() {
    let text = format!(
        "goal = \"body\"\n[input.surface]\nfiles = \"*.ply\"\n[node.body]\nstage = \"capture.surface\"\nfrom = {{ files = \"@surface\" }}\n{THIGH}"
    );
    let catalog = &tailor::catalog::CATALOG;
    let Err(wrong) = open_text("p.toml", &text, &Overrides::default(), catalog) else {
        panic!("nobody takes it")
    };
    let message = wrong.json().to_string();
    assert!(
        message.contains("no node of this pipeline takes `[girth.mid_thigh]`"),
        "{message}"
    );
}

#[test]
fn schema_and_reference_know_sections() {
    let schema = command::schema::schema(tailor::catalog::stages());
    let girth = &schema["properties"]["girth"]["additionalProperties"];
    assert_eq!(girth["required"], serde_json::json!(["part", "at"]));
    assert_eq!(girth["properties"]["at"]["maximum"], 1.0);
    let stage = tailor::catalog::find("measure.landmarks").unwrap();
    let text = command::reference::text(stage);
    assert!(
        text.contains("in [girth.NAME] at must be given  (a number, 0..=1)"),
        "{text}"
    );
}

#[test]
fn the_table_of_girths_in_the_docs_is_the_one_in_the_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/girths.md");
    let docs = std::fs::read_to_string(path).unwrap();
    let table = docs.split("<!-- definitions -->\n").nth(1).unwrap();
    let table = table.split("<!-- /definitions -->").next().unwrap();
    assert_eq!(table, io::definitions_to_markdown());
}
