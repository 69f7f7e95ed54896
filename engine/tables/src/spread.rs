//! Replicates of a point as one: how many there are, what they come to, and how far they scatter.

use super::chance::{deviation, interval, mean};
use super::reported::{Reported, metrics};
use serde_json::{Value, json};

/// Points that differ in their replicate alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The variant, if there is one.
    pub variant: Option<String>,
    /// What varies.
    pub params: Vec<(String, String)>,
    /// Which they are, by their places.
    pub places: Vec<usize>,
    /// How many there are.
    pub points: usize,
    /// How many of them came to nothing.
    pub failed: usize,
    /// One entry a metric, in the order of the table.
    pub spreads: Vec<Spread>,
}

/// A metric over replicates.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// How many have it.
    pub n: usize,
    /// How many came to their end and do not: it was refused.
    pub refused: usize,
    /// Mean of those that have it.
    pub mean: Option<f64>,
    /// Standard deviation, by n − 1.
    pub sd: Option<f64>,
    /// Holds the mean of all such replicates nineteen times in twenty (Student).
    pub interval: Option<[f64; 2]>,
    /// Of a point without replicates: its number's own interval.
    pub own: Option<[f64; 2]>,
}

/// Groups in the order in which their first points come.
pub fn spread(all: &[Reported]) -> Vec<Group> {
    let mut groups: Vec<(&Reported, Vec<&Reported>, Vec<usize>)> = Vec::new();
    for (place, point) in all.iter().enumerate() {
        let same = |of: &Reported| of.variant == point.variant && of.params == point.params;
        // Replicates follow each other.
        match groups.iter_mut().rev().find(|(first, ..)| same(first)) {
            Some((_, members, places)) => {
                members.push(point);
                places.push(place);
            }
            None => groups.push((point, vec![point], vec![place])),
        }
    }
    let metrics = metrics(all.iter());
    let group = |(first, members, places): (&Reported, Vec<&Reported>, Vec<usize>)| Group {
        places,
        variant: first.variant.clone(),
        params: first.params.clone(),
        points: members.len(),
        failed: members.iter().filter(|t| !t.done).count(),
        spreads: metrics.iter().map(|m| of(m, &members)).collect(),
    };
    groups.into_iter().map(group).collect()
}

fn of((name, unit): &(String, String), members: &[&Reported]) -> Spread {
    let values: Vec<f64> = members.iter().filter_map(|t| t.value(name)).collect();
    let done = members.iter().filter(|t| t.done).count();
    let own = match members {
        [one] => one.within.iter().find(|(n, _)| n == name).map(|h| h.1),
        _ => None,
    };
    Spread {
        own,
        name: name.clone(),
        unit: unit.clone(),
        n: values.len(),
        refused: done - values.len(),
        mean: (!values.is_empty()).then(|| mean(&values)),
        sd: deviation(&values),
        interval: interval(&values),
    }
}

impl Group {
    /// For other programs.
    pub fn json(&self) -> Value {
        let spread = |s: &Spread| {
            json!({
                "name": s.name, "unit": s.unit, "n": s.n, "refused": s.refused,
                "mean": s.mean, "sd": s.sd, "interval": s.interval,
            })
        };
        let params = self
            .params
            .iter()
            .map(|(k, v)| (k.clone(), Value::from(v.clone())));
        json!({
            "variant": self.variant, "params": params.collect::<serde_json::Map<_, _>>(),
            "points": self.points, "failed": self.failed,
            "metrics": self.spreads.iter().map(spread).collect::<Vec<_>>(),
        })
    }
}
