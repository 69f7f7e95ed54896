//! Replicates: each point again and again, each time with other seeds of what is by chance.

use super::axis::{Axis, AxisError};
use crate::graph::{Bound, Graph};
use crate::recipe::no_seed;
use crate::walk::all;
use stage::Value;

/// A seed: node, param, and the value that it has by itself.
pub(super) type Seed = (String, String, i64);

/// How often each point is repeated, and with which seeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Replicates {
    /// How often; none is once, with the seeds as they are.
    pub(super) times: Option<u32>,
    /// The seeds that are reached, one entry a variant.
    pub(super) seeds: Vec<Vec<Seed>>,
}

impl Replicates {
    /// Replicates of these graphs, one a variant; `nodes` are those that are wanted, none is the goal. The first
    /// replicate has the seeds as they are, each further one the next numbers: what was made for few is found for many,
    /// and equal replicates of two variants are given the same.
    ///
    /// # Errors
    ///
    /// No seed is reached, a seed has no further numbers, or an axis varies one by itself.
    pub fn of(
        times: u32,
        graphs: &[Graph],
        nodes: &[String],
        axes: &[Axis],
    ) -> Result<Replicates, AxisError> {
        let mut seeds = Vec::new();
        for graph in graphs {
            let named: Vec<usize> = nodes.iter().filter_map(|name| graph.node(name)).collect();
            let wanted = if nodes.is_empty() {
                &graph.goal
            } else {
                &named
            };
            let needed = all(graph, wanted);
            let of: Vec<(Seed, f64)> = needed
                .iter()
                .flat_map(|i| seeds_of(&graph.nodes[*i]))
                .collect();
            if of.is_empty() {
                return Err(AxisError::NoSeed(no_seed(graph.catalog)));
            }
            for ((node, param, own), most) in &of {
                let varies = |a: &&Axis| {
                    let mut params = a.params.iter();
                    params.any(|(n, p)| {
                        p == param
                            && graph
                                .holders(n, p)
                                .contains(&graph.node(node).unwrap_or(usize::MAX))
                    })
                };
                if axes.iter().any(|a| varies(&a)) {
                    return Err(AxisError::SeedVaries(format!("{node}.{param}")));
                }
                if *own as f64 + f64::from(times) - 1.0 > *most {
                    return Err(AxisError::SeedEnds(format!("{node}.{param}"), *own, *most));
                }
            }
            seeds.push(of.into_iter().map(|(seed, _)| seed).collect());
        }
        let times = Some(times);
        Ok(Replicates { times, seeds })
    }

    /// How often each point runs.
    pub(super) fn count(&self) -> u32 {
        self.times.unwrap_or(1)
    }

    /// What a replicate of a variant sets.
    pub(super) fn set(&self, variant: usize, replicate: u32) -> Vec<(String, String, Value)> {
        let seeds = self.seeds.get(variant).into_iter().flatten();
        let set = |(node, param, own): &Seed| {
            let value = Value::Int(own + i64::from(replicate));
            (node.clone(), param.clone(), value)
        };
        seeds.map(set).collect()
    }

    /// The params that are set in any variant.
    pub(super) fn params(&self) -> Vec<(String, String)> {
        let mut params: Vec<(String, String)> = Vec::new();
        for (node, param, _) in self.seeds.iter().flatten() {
            let one = (node.clone(), param.clone());
            if !params.contains(&one) {
                params.push(one);
            }
        }
        params
    }
}

/// The seeds of a node, each with the greatest number that it may be; of a program its param `seed`.
fn seeds_of(node: &Bound) -> Vec<(Seed, f64)> {
    let specs = node.stage.params();
    let seed = |name: &str| match node.program.is_some() {
        true => (name == "seed").then_some(1e15),
        false => {
            let spec = specs.iter().find(|s| s.name == name && s.seed)?;
            Some(spec.range.map_or(f64::from(u32::MAX), |(_, most)| most))
        }
    };
    let values = node.params.values.iter();
    values
        .filter_map(|(name, value)| match value {
            Value::Int(own) => Some(((node.name.clone(), (*name).to_owned(), *own), seed(name)?)),
            _ => None,
        })
        .collect()
}
