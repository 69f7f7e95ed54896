//! A plan's layers as arrays of jobs: which strands an element works on, and what it waits for.

use engine::strands::Plan;
use std::ops::Range;

/// How strands are packed into elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packing {
    /// The largest array that the site takes.
    pub most_elements: usize,
    /// So many jobs the site holds, of everybody.
    pub most_jobs: usize,
    /// An element should work at least so long, if it is known how long strands take. \[s\]
    pub least_seconds: f64,
}

/// A layer of a plan as one array of jobs.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Its strands.
    pub strands: Range<usize>,
    /// Each element works on so many of them, in their order.
    pub pack: usize,
    /// The elements with something to do.
    pub elements: Vec<usize>,
    /// How long its longest element is expected to take, if that is known. \[s\]
    pub seconds: Option<f64>,
}

impl Layer {
    /// The strands of an element.
    pub fn of(&self, element: usize) -> Range<usize> {
        let first = self.strands.start + element * self.pack;
        first..(first + self.pack).min(self.strands.end)
    }

    /// In Slurm's notation for sets of numbers: `0-3,7`.
    pub fn array(&self) -> String {
        let mut ranges: Vec<(usize, usize)> = Vec::new();
        for at in &self.elements {
            match ranges.last_mut() {
                Some((_, last)) if *last + 1 == *at => *last = *at,
                _ => ranges.push((*at, *at)),
            }
        }
        let range = |(from, to): &(usize, usize)| match from == to {
            true => from.to_string(),
            false => format!("{from}-{to}"),
        };
        ranges.iter().map(range).collect::<Vec<_>>().join(",")
    }

    /// Whether every element reads only what the element of the same number below makes.
    pub fn corresponds(&self, below: &Layer, plan: &Plan) -> bool {
        let fits = |element: &usize| {
            let reads = self.of(*element).flat_map(|s| &plan.strands[s].reads);
            let mut below_ones = reads.filter(|s| below.strands.contains(s));
            below_ones.all(|s| below.of(*element).contains(s))
        };
        self.elements == below.elements && self.elements.iter().all(fits)
    }
}

/// The layers with something to do, lowest first; `seconds` gives how long a strand takes, if known.
pub fn layers(
    plan: &Plan,
    done: &[bool],
    packing: Packing,
    seconds: &dyn Fn(usize) -> Option<f64>,
) -> Vec<Layer> {
    // Half of what the site takes is left to its other users.
    let most =
        (packing.most_jobs / 2 / plan.layers().max(1)).clamp(1, packing.most_elements.max(1));
    let one = |layer: usize| {
        let strands = plan.layer(layer);
        let known: Option<Vec<f64>> = strands.clone().map(seconds).collect();
        let mean = known
            .as_ref()
            .map(|k| k.iter().sum::<f64>() / k.len().max(1) as f64);
        let worth = mean.map_or(1, |mean| (packing.least_seconds / mean.max(1e-3)) as usize);
        // Work is spread over some elements, however short it is.
        let worth = worth.min(strands.len() / SPREAD);
        let pack = strands.len().div_ceil(most).max(worth).max(1);
        let mut layer = Layer {
            pack,
            elements: vec![],
            seconds: None,
            strands,
        };
        let count = layer.strands.len().div_ceil(pack);
        let open = |e: &usize| layer.of(*e).any(|s| !done[s]);
        let elements: Vec<usize> = (0..count).filter(open).collect();
        let sum = |known: &Vec<f64>| {
            let of = |e: &usize| {
                let own = layer.of(*e).map(|s| known[s - layer.strands.start]);
                own.sum::<f64>()
            };
            elements.iter().map(of).fold(0.0, f64::max)
        };
        layer.seconds = known.as_ref().map(sum);
        layer.elements = elements;
        layer
    };
    let all = (0..plan.layers()).map(one);
    all.filter(|layer| !layer.elements.is_empty()).collect()
}

/// So many elements a layer has at least, if it has as many strands.
const SPREAD: usize = 8;
