//! How much a sweep is before any of it runs.

use super::points::Points;
use crate::graph::Graph;
use crate::impact;
use system::text::count;

/// What a sweep would make if nothing of it were in the store.
#[derive(Debug, Clone, PartialEq)]
pub struct Outlook {
    /// How many points.
    pub points: u128,
    /// How many distinct results: what points share is counted once.
    pub results: u128,
    /// How long, going by what each node took the last time. \[s\]
    pub seconds: f64,
    /// Nodes that never ran in this store: their time is not in `seconds`.
    pub unknown: Vec<String>,
}

/// `last` gives how long a node took the last time \[s\]. Counts results: a node has as many as the axes that reach it
/// have combinations.
pub fn outlook(
    points: &Points,
    graph: &Graph,
    wanted: &[usize],
    last: &dyn Fn(&str) -> Option<f64>,
) -> Outlook {
    let needed = crate::walk::needed(graph, wanted);
    let mut combinations = vec![points.variants.len() as u128; graph.nodes.len()];
    let again = (
        points.replicates.params(),
        points.replicates.count() as usize,
    );
    let axes = points.axes.iter().map(|a| (a.params.clone(), a.rows.len()));
    for (params, steps) in axes.chain([again]) {
        let mut reached = vec![false; graph.nodes.len()];
        for (node, param) in &params {
            for at in graph.holders(node, param) {
                for i in impact::reached(graph, wanted, at) {
                    reached[i] = true;
                }
            }
        }
        for (count, _) in combinations.iter_mut().zip(&reached).filter(|(_, r)| **r) {
            *count = count.saturating_mul(steps as u128);
        }
    }
    let mut outlook = Outlook {
        points: points.count(),
        results: 0,
        seconds: 0.0,
        unknown: vec![],
    };
    for (i, node) in graph.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
        outlook.results = outlook.results.saturating_add(combinations[i]);
        match last(&node.name) {
            Some(seconds) => outlook.seconds += seconds * combinations[i] as f64,
            None => outlook.unknown.push(node.name.clone()),
        }
    }
    outlook
}

impl std::fmt::Display for Outlook {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{}, {} unless cached",
            count(self.points, "point"),
            count(self.results, "result")
        )?;
        let s = self.seconds;
        if self.unknown.is_empty() || s > 0.0 {
            let time = match s {
                s if s < 120.0 => format!("{s:.0} s"),
                s if s < 7200.0 => format!("{:.0} min", s / 60.0),
                s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
                s => format!("{:.1} days", s / 86_400.0),
            };
            write!(f, ", about {time} if none is, going by earlier runs")?;
        }
        if !self.unknown.is_empty() {
            write!(f, " (not known how long: {})", self.unknown.join(", "))?;
        }
        Ok(())
    }
}
