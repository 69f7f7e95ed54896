//! What a search found: every point that was tried, the best, and that as a variant.

use stage::Value;
use std::fmt::Write;

/// Node, param and value.
pub type Set = (String, String, Value);

/// A point that was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// The round, from 1 on.
    pub round: usize,
    /// The variant, if there is one.
    pub variant: Option<String>,
    /// What it sets.
    pub sets: Vec<Set>,
    /// What was searched for: the mean of its replicates; `None` where it was refused or failed.
    pub value: Option<f64>,
    /// What the point cost of the budget: less than 1 where it was not made in full.
    pub cost: f64,
}

/// All that was tried, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// All of them.
    pub tried: Vec<Tried>,
    /// The best of those that were made in full.
    pub best: Option<Tried>,
}

impl Found {
    /// What was spent of the budget.
    pub fn cost(&self) -> f64 {
        self.tried.iter().map(|t| t.cost).sum()
    }
}

/// The best set as a variant in a pipeline that extends another.
pub fn variant(pipeline: &str, name: &str, best: &Tried) -> String {
    let mut text = format!(
        "extends = \"{}\"\n\n[variant.{name}_best]\nabout = \"Found by the search `{name}`",
        escaped(pipeline)
    );
    if let Some(variant) = &best.variant {
        let _ = write!(text, ", on top of the variant `{variant}`");
    }
    text += ".\"\n";
    let mut nodes: Vec<&str> = Vec::new();
    for (node, _, _) in &best.sets {
        if !nodes.contains(&node.as_str()) {
            nodes.push(node);
        }
    }
    for node in nodes {
        let own = best.sets.iter().filter(|(n, _, _)| n == node);
        let params: Vec<String> = own.map(|(_, p, v)| format!("{p} = {v}")).collect();
        let _ = writeln!(text, "with.{node} = {{ {} }}", params.join(", "));
    }
    text
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}
