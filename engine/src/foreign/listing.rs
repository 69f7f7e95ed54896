//! What a pipeline would run, for the user to look at before it does.

use super::permit::programs;
use super::program::Program;
use super::template::Template;
use crate::graph::Graph;

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
    if program.network {
        lines.push("  may reach the network".into());
    }
    lines
}

/// What somebody is told who has not allowed these nodes' programs.
pub fn refusal(graph: &Graph, nodes: &[usize]) -> String {
    let all = programs(graph, nodes).flat_map(|(i, p)| lines(&graph.nodes[i].name, p));
    let all: Vec<String> = all.map(|line| format!("  {line}\n")).collect();
    format!(
        "this pipeline runs programs that were not allowed in this cache:\n{}look at them and at their files; \
         then say --allow-exec, which is remembered until a command or a file changes",
        all.concat()
    )
}
