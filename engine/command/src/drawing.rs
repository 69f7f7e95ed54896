//! A pipeline as DOT or Mermaid, coloured by what a run would do.

use engine::graph::{Bound, Graph, Source};
use engine::plan::{Planned, State};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The same for other programs: nodes with their states and what their ports read.
pub(super) fn json(graph: &Graph, plan: &[Option<Planned>]) -> Value {
    let word = |state: &State| match state {
        State::Cached => "cached",
        State::Stale(_) => "will run",
        State::May => "may run",
    };
    let read = |source: &Option<Source>| {
        source.map(|source| match source {
            Source::Node(j) => graph.nodes[j].name.clone(),
            Source::Input(j) => format!("@{}", graph.inputs[j].name),
        })
    };
    let node = |(node, planned): (&Bound, &Option<Planned>)| {
        let ports = node.ports.iter().map(|p| p.name.to_owned());
        let from = ports.zip(node.from.iter().map(|s| read(s).into()));
        json!({
            "node": node.name, "stage": node.stage.name(), "from": from.collect::<Map<_, _>>(),
            "state": planned.as_ref().map(|p| word(&p.state)),
        })
    };
    let inputs = graph.inputs.iter();
    let inputs: Value = inputs
        .map(|i| json!({ "input": i.name, "files": i.files }))
        .collect();
    let nodes: Value = graph.nodes.iter().zip(plan).map(node).collect();
    json!({ "inputs": inputs, "nodes": nodes })
}

/// The drawing in a format: `dot` or `mermaid`.
///
/// # Errors
///
/// No such format.
pub(super) fn draw(
    graph: &Graph,
    plan: &[Option<Planned>],
    format: &str,
) -> Result<String, String> {
    let color = |i: usize| color(plan[i].as_ref().map(|p| &p.state));
    let source = |s: &Source| match s {
        Source::Node(j) => graph.nodes[*j].name.clone(),
        Source::Input(j) => graph.inputs[*j].name.clone(),
    };
    let mut text = String::new();
    let dot = match format {
        "dot" => true,
        "mermaid" => false,
        "svg" => {
            return Err("no picture is drawn here: give --as dot, and `dot -Tsvg` draws it".into());
        }
        other => return Err(stage::unknown("format", other, &["dot", "mermaid"]).into()),
    };
    let _ = writeln!(
        text,
        "{}",
        if dot {
            "digraph pipeline {\n  node [shape=box, style=filled]"
        } else {
            "flowchart TD"
        }
    );
    for input in &graph.inputs {
        let name = &input.name;
        let _ = match dot {
            true => writeln!(text, "  \"@{name}\" [shape=folder, fillcolor=\"#ffffff\"]"),
            false => writeln!(text, "  in_{name}[/\"@{name}\"/]"),
        };
    }
    for (i, node) in graph.nodes.iter().enumerate() {
        let (name, stage) = (&node.name, node.stage.name());
        let _ = match dot {
            true => writeln!(
                text,
                "  \"{name}\" [label=\"{name}\\n{stage}\", fillcolor=\"{}\"]",
                color(i)
            ),
            false => writeln!(
                text,
                "  {name}[\"{name}<br/>{stage}\"]\n  style {name} fill:{}",
                color(i)
            ),
        };
        for from in node.from.iter().flatten() {
            let (at, input) = (source(from), matches!(from, Source::Input(_)));
            let _ = match (dot, input) {
                (true, true) => writeln!(text, "  \"@{at}\" -> \"{name}\""),
                (true, false) => writeln!(text, "  \"{at}\" -> \"{name}\""),
                (false, true) => writeln!(text, "  in_{at} --> {name}"),
                (false, false) => writeln!(text, "  {at} --> {name}"),
            };
        }
    }
    if dot {
        text += "}\n";
    }
    Ok(text)
}

/// The colour of a node; `None` is not asked.
fn color(state: Option<&State>) -> &'static str {
    match state {
        Some(State::Cached) => "#b7e4c7",
        Some(State::Stale(_)) => "#ffb4a2",
        Some(State::May) => "#ffe8a3",
        None => "#e5e5e5",
    }
}
