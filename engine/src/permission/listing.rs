//! What a pipeline would run, for the user to look at before it does.

use crate::graph::Graph;
use programs::Catalog;
use programs::{EXEC, Program, Template, VERSION};
use std::fmt::Write;
use std::sync::Arc;

/// Nodes that are programs, of some of a graph's, with their places.
pub fn programs<'a>(
    graph: &'a Graph,
    nodes: &'a [usize],
) -> impl Iterator<Item = (usize, &'a Arc<Program>)> {
    let program = |i: &usize| Some((*i, graph.nodes[*i].program.as_ref()?));
    nodes.iter().filter_map(program)
}

fn words(words: &[Template]) -> String {
    let words: Vec<String> = words.iter().map(Template::to_string).collect();
    words.join(" ")
}

/// A node's program: its command first, then what it may.
pub fn lines(node: &str, program: &Program) -> Vec<String> {
    let mut lines = vec![format!("{node}: {}", words(&program.command))];
    for (name, value) in program.texts() {
        lines.push(format!("  with {name} = {value}"));
    }
    for file in &program.files {
        let content = &file.content.to_hex()[..12];
        lines.push(format!("  file {:?}  {content}", file.name));
    }
    if !program.identity.is_empty() {
        lines.push(format!("  identity: {}", words(&program.identity)));
    }
    if !program.env.is_empty() {
        lines.push(format!(
            "  gets from the environment: {}",
            program.env.join(", ")
        ));
    }
    for path in &program.reads {
        lines.push(format!("  may read {path:?}"));
    }
    if program.keep {
        lines.push("  stays for further jobs, which come on its standard input".into());
    }
    if program.network {
        lines.push("  may reach the network".into());
    }
    lines
}

/// The reference of the stage itself: the keys of a node, and which kinds programs can make.
pub fn reference(catalog: &Catalog) -> String {
    let mut text = format!(
        "{EXEC} v{} → what `out` names\n  Runs a program of yours: see docs/pipelines.md.\n",
        VERSION
    );
    for (key, what) in KEYS {
        let _ = writeln!(text, "  {key}  {what}");
    }
    for importer in catalog.importers {
        let (stage, files) = (importer.stage, importer.files.join(", "));
        let (kind, name) = (stage.yields(), stage.name());
        let _ = writeln!(text, "  out = \"{kind}\": {files}, read by {name}");
    }
    text + "\n"
}

/// The keys of a program's node.
const KEYS: [(&str, &str); 12] = [
    (
        "command",
        "= [\"python3\", \"{here}/a.py\", \"{from.PORT}\", \"{out}\", \"{with.NAME}\"]; {from.PORT:FORMAT} for a format of `show --as`",
    ),
    (
        "out",
        "= the kind that it makes; {out} is a file, or a folder that is there",
    ),
    ("from", "= { PORT = \"node\" }: any names"),
    (
        "with",
        "= { NAME = value }: any names, each in the command as {with.NAME}",
    ),
    (
        "files",
        "= [\"a.py\"]: beside the pipeline; laid out in {here}, content in the key",
    ),
    (
        "identity",
        "= [\"python3\", \"--version\"]: what it prints is in the key",
    ),
    (
        "env",
        "= [\"NAME\"]: variables of the environment that it gets; the rest is cleared",
    ),
    (
        "reads",
        "= [\"/usr/local/share/model\"]: files and folders that it reads besides, by whole paths; content in the key",
    ),
    ("timeout_s", "= 3600.0: how long it may take"),
    ("memory_mb", "= what it may hold with its children"),
    (
        "network",
        "= false: whether it may reach the network (kept by bubblewrap)",
    ),
    (
        "keep",
        "= false: whether it stays, and gets further jobs on its standard input",
    ),
];

/// The message for somebody who has not allowed these nodes' programs.
pub fn refusal(graph: &Graph, nodes: &[usize]) -> String {
    let all = programs(graph, nodes).flat_map(|(i, p)| lines(&graph.nodes[i].name, p));
    let all: Vec<String> = all.map(|line| format!("  {line}\n")).collect();
    format!(
        "this pipeline runs programs that you have not allowed:\n{}look at them and at their files; \
         then give --allow-exec, which is remembered until a command or a file changes",
        all.concat()
    )
}
