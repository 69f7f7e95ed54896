//! Cuts a graph into strands: nodes that the same goals need, and that hang together, are one.
//!
//! What all points of a sweep share is needed by all goals: one strand, or one a connected part. What
//! only some share is one strand for these; what is one point's own is one strand. A node that reads
//! another is needed by no more goals than it, so strands never wait for each other in a circle.

use crate::done::sources;
use crate::graph::Graph;
use std::collections::HashMap;

/// Nodes that one worker makes in one go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strand {
    /// All that it reads is in lower layers.
    pub layer: usize,
    /// Its nodes, in the graph's order.
    pub nodes: Vec<usize>,
    /// The strands that it reads, in their order.
    pub reads: Vec<usize>,
    /// The first goal that needs it.
    pub goal: usize,
}

/// The strands of a graph, lower layers first. `goals` has the nodes that each goal needs; what no goal
/// needs is in no strand.
pub fn cut(graph: &Graph, goals: &[Vec<usize>]) -> Vec<Strand> {
    let n = graph.nodes.len();
    let mut needed_by: Vec<Vec<usize>> = vec![vec![]; n];
    for (goal, nodes) in goals.iter().enumerate() {
        nodes.iter().for_each(|i| needed_by[*i].push(goal));
    }
    let needed = |i: &usize| !needed_by[*i].is_empty();
    let mut above: Vec<usize> = (0..n).collect();
    for i in (0..n).filter(needed) {
        for j in sources(graph, i).filter(|j| needed_by[*j] == needed_by[i]) {
            let (a, b) = (root(&mut above, i), root(&mut above, j));
            above[a.max(b)] = a.min(b);
        }
    }
    let mut place: HashMap<usize, usize> = HashMap::new();
    let mut strands: Vec<Strand> = Vec::new();
    let mut of = vec![usize::MAX; n];
    for i in (0..n).filter(needed) {
        let first = root(&mut above, i);
        let at = *place.entry(first).or_insert_with(|| {
            strands.push(Strand {
                layer: 0,
                nodes: vec![],
                reads: vec![],
                goal: needed_by[i][0],
            });
            strands.len() - 1
        });
        strands[at].nodes.push(i);
        of[i] = at;
    }
    for (at, strand) in strands.iter_mut().enumerate() {
        let from = strand.nodes.iter().flat_map(|i| sources(graph, *i));
        let mut reads: Vec<usize> = from.map(|j| of[j]).filter(|s| *s != at).collect();
        reads.sort_unstable();
        reads.dedup();
        strand.reads = reads;
    }
    by_layer(strands)
}

/// The least node of a part.
fn root(above: &mut [usize], mut i: usize) -> usize {
    while above[i] != i {
        above[i] = above[above[i]];
        i = above[i];
    }
    i
}

/// Gives each strand its layer, and sorts: lower layers first, then by the first node.
fn by_layer(mut strands: Vec<Strand>) -> Vec<Strand> {
    let mut left: Vec<usize> = strands.iter().map(|s| s.reads.len()).collect();
    let mut readers: Vec<Vec<usize>> = vec![vec![]; strands.len()];
    for (at, strand) in strands.iter().enumerate() {
        strand.reads.iter().for_each(|from| readers[*from].push(at));
    }
    let mut open: Vec<usize> = (0..strands.len()).filter(|s| left[*s] == 0).collect();
    while let Some(at) = open.pop() {
        for reader in &readers[at] {
            let above = strands[at].layer + 1;
            strands[*reader].layer = strands[*reader].layer.max(above);
            left[*reader] -= 1;
            if left[*reader] == 0 {
                open.push(*reader);
            }
        }
    }
    let mut order: Vec<usize> = (0..strands.len()).collect();
    order.sort_by_key(|s| (strands[*s].layer, strands[*s].nodes[0]));
    let mut place = vec![0; strands.len()];
    order
        .iter()
        .enumerate()
        .for_each(|(to, from)| place[*from] = to);
    let moved = |s: &usize| {
        let mut strand = strands[*s].clone();
        strand
            .reads
            .iter_mut()
            .for_each(|from| *from = place[*from]);
        strand.reads.sort_unstable();
        strand
    };
    order.iter().map(moved).collect()
}
