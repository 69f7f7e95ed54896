//! Points that would all be the same: an axis that reaches nothing wanted, or whose place another one takes; variants
//! that differ only in what varies by itself.

use super::points::{Point, Points};
use crate::graph::{Graph, Source};
use crate::key::{self, Digest, Ledger};
use stage::Hash;

/// So many rows of an axis are looked at for one that differs.
const ROWS: usize = 10_000;

/// The pipeline at a point.
type At<'a, E> = &'a dyn Fn(&Point) -> Result<Graph, E>;

/// Why some points would be the same whatever varies, if they would; `nodes` are those that are wanted, none is the goal.
///
/// # Errors
///
/// What `at` gives.
pub fn alike<E>(points: &Points, nodes: &[String], at: At<'_, E>) -> Result<Option<String>, E> {
    let look = Look { points, nodes, at };
    for axis in 0..points.axes.len() {
        if points.axes[axis].rows.len() > 1 && !look.changes(axis, None)? {
            return look.idle(axis).map(Some);
        }
    }
    look.variants()
}

struct Look<'a, E> {
    points: &'a Points,
    nodes: &'a [String],
    at: At<'a, E>,
}

impl<E> Look<'_, E> {
    /// What is made at a point: a variant, a row of an axis and the first of all other ones, but for one left out.
    fn made(&self, variant: usize, row: (usize, usize), out: Option<usize>) -> Result<Hash, E> {
        let mut values = Vec::new();
        for (k, axis) in self.points.axes.iter().enumerate() {
            if Some(k) == out || row.0 == usize::MAX {
                continue;
            }
            let at = if k == row.0 { row.1 } else { 0 };
            let pairs = axis.params.iter().zip(&axis.rows[at]);
            values.extend(pairs.map(|((n, p), v)| (n.clone(), p.clone(), v.clone())));
        }
        let graph = (self.at)(&Point {
            variant: self.points.variants[variant].clone(),
            values,
            ..Point::default()
        })?;
        Ok(recipe(&graph, self.nodes))
    }

    /// Whether some row of an axis makes something else than its first, in some variant.
    fn changes(&self, axis: usize, out: Option<usize>) -> Result<bool, E> {
        for variant in 0..self.points.variants.len() {
            let first = self.made(variant, (axis, 0), out)?;
            for row in 1..self.points.axes[axis].rows.len().min(ROWS) {
                if self.made(variant, (axis, row), out)? != first {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// What to answer for an axis that changes nothing.
    fn idle(&self, axis: usize) -> Result<String, E> {
        for other in (0..self.points.axes.len()).filter(|k| *k != axis) {
            if self.changes(axis, Some(other))? {
                return Ok(format!(
                    "{} changes nothing where {} varies, which takes its place: leave one of them out",
                    self.name(axis),
                    self.name(other)
                ));
            }
        }
        Ok(format!(
            "{} changes nothing that is wanted: all its points would be the same",
            self.name(axis)
        ))
    }

    /// Variants that differ, and no more once the axes are set.
    fn variants(&self) -> Result<Option<String>, E> {
        let count = self.points.variants.len();
        if self.points.axes.is_empty() || count < 2 {
            return Ok(None);
        }
        let all = |row: (usize, usize)| -> Result<Vec<Hash>, E> {
            (0..count).map(|v| self.made(v, row, None)).collect()
        };
        let (alone, set) = (all((usize::MAX, 0))?, all((0, 0))?);
        for b in 1..count {
            for a in 0..b {
                if alone[a] != alone[b] && set[a] == set[b] {
                    let name = |v: usize| self.points.variants[v].as_deref().unwrap_or("as-is");
                    let (a, b) = (name(a), name(b));
                    return Ok(Some(format!(
                        "the variants `{a}` and `{b}` make the same of every point: what they differ in varies by itself; leave out one of them, or the axis"
                    )));
                }
            }
        }
        Ok(None)
    }

    /// An axis by its params.
    fn name(&self, axis: usize) -> String {
        let params = self.points.axes[axis].params.iter();
        let names: Vec<String> = params.map(|(n, p)| format!("`{n}.{p}`")).collect();
        names.join(", ")
    }
}

/// All that is wanted of a graph: what each node does, and from where it reads.
fn recipe(graph: &Graph, nodes: &[String]) -> Hash {
    let mut digest = Digest::default();
    let named: Vec<usize> = nodes.iter().filter_map(|name| graph.node(name)).collect();
    let wanted = if nodes.is_empty() {
        &graph.goal
    } else {
        &named
    };
    for i in crate::walk::all(graph, wanted) {
        let node = &graph.nodes[i];
        digest.line("node", &node.name);
        key::describe_recipe(node, &mut digest);
        for (port, source) in node.ports.iter().zip(&node.from) {
            let name = match source {
                None => "",
                Some(Source::Input(j)) => &graph.inputs[*j].name,
                Some(Source::Node(j)) => &graph.nodes[*j].name,
            };
            digest.line(port.name, name);
        }
    }
    digest.finish()
}
