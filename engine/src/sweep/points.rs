//! The points of a sweep: a grid of axes, crossed with variants; none is written out before its turn.

use super::axis::Axis;
use super::replicates::Replicates;
use crate::graph::Graph;
use crate::recipe::Overrides;
use stage::Value;

/// All points.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// The variants; `None` is the pipeline as it is.
    pub variants: Vec<Option<String>>,
    /// What varies, the slowest first.
    pub axes: Vec<Axis>,
    /// How often each is repeated: the fastest, so that the replicates of a point follow each other.
    pub replicates: Replicates,
}

/// One point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Point {
    /// The variant, if there is one.
    pub variant: Option<String>,
    /// Node, param and value.
    pub values: Vec<(String, String, Value)>,
    /// Which replicate, from 1 on; `None` where points are not repeated.
    pub replicate: Option<u32>,
    /// The seeds that the replicate sets.
    pub seeds: Vec<(String, String, Value)>,
}

impl Points {
    /// A grid; what is upstream in the pipeline varies slowest. A param that is in two axes
    /// keeps the last.
    pub fn new(graph: &Graph, variants: Vec<Option<String>>, axes: Vec<Axis>) -> Points {
        let mut kept: Vec<Axis> = Vec::new();
        for axis in axes {
            kept.retain(|a| !a.params.iter().any(|p| axis.params.contains(p)));
            kept.push(axis);
        }
        let first = |axis: &Axis| {
            let places = axis.params.iter().flat_map(|(n, p)| graph.holders(n, p));
            places.min().unwrap_or(usize::MAX)
        };
        kept.sort_by_key(first);
        Points {
            variants,
            axes: kept,
            replicates: Replicates::default(),
        }
    }

    /// Each point again and again.
    pub fn repeated(self, replicates: Replicates) -> Points {
        Points { replicates, ..self }
    }

    /// How many.
    pub fn count(&self) -> u128 {
        let rows = self.axes.iter().map(|a| a.rows.len() as u128);
        let once = rows.fold(self.variants.len() as u128, u128::saturating_mul);
        once.saturating_mul(self.replicates.count().into())
    }

    /// The params that vary, in the order of the table.
    pub fn params(&self) -> Vec<(String, String)> {
        self.axes.iter().flat_map(|a| a.params.clone()).collect()
    }

    /// All points in the order in which they run.
    pub fn iter(&self) -> impl Iterator<Item = Point> + '_ {
        (0..self.count()).map(|i| self.at(i))
    }

    fn at(&self, mut i: u128) -> Point {
        let times = u128::from(self.replicates.count());
        let replicate = (i % times) as u32;
        i /= times;
        let mut rows = vec![0; self.axes.len()];
        for (axis, row) in self.axes.iter().zip(&mut rows).rev() {
            *row = (i % axis.rows.len() as u128) as usize;
            i /= axis.rows.len() as u128;
        }
        let mut values = Vec::new();
        for (axis, row) in self.axes.iter().zip(rows) {
            for ((node, param), value) in axis.params.iter().zip(&axis.rows[row]) {
                values.push((node.clone(), param.clone(), value.clone()));
            }
        }
        let variant = i as usize;
        Point {
            variant: self.variants[variant].clone(),
            values,
            replicate: self.replicates.times.map(|_| replicate + 1),
            seeds: self.replicates.set(variant, replicate),
        }
    }
}

impl Point {
    /// What the point changes, after what the command line changes for all.
    pub fn overrides(&self, all: &Overrides) -> Overrides {
        let mut sets = all.sets.clone();
        sets.extend(self.sets());
        let both: Vec<String> = [&all.variant, &self.variant]
            .into_iter()
            .flatten()
            .cloned()
            .collect();
        Overrides {
            variant: (!both.is_empty()).then(|| both.join(",")),
            sets,
        }
    }

    /// `NODE.PARAM=VALUE`, as `--set` takes it.
    pub fn sets(&self) -> Vec<String> {
        let set =
            |(node, param, value): &(String, String, Value)| format!("{node}.{param}={value}");
        self.values.iter().chain(&self.seeds).map(set).collect()
    }

    /// What people call it: `voxel@rigid,2.0`.
    pub fn name(&self, sweep: &str) -> String {
        let mut parts: Vec<String> = self.variant.iter().cloned().collect();
        parts.extend(self.values.iter().map(|(_, _, v)| plain(v)));
        let again = self.replicate.map(|n| format!("#{n}"));
        format!("{sweep}@{}{}", parts.join(","), again.unwrap_or_default())
    }
}

/// A value without the quotes of a text.
pub fn plain(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        other => other.to_string(),
    }
}
