//! The numbers of a point, as statistics need them: out of a row, or read back from a `sweep.json`.

use super::cells::params;
use engine::sweep::{End, Row};
use serde_json::Value;

/// A point's numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Reported {
    /// The variant, if there is one.
    pub variant: Option<String>,
    /// What varies, without variant and seeds: `node.param` and the value.
    pub params: Vec<(String, String)>,
    /// Which replicate.
    pub replicate: Option<u32>,
    /// Whether it came to its end.
    pub done: bool,
    /// Name, unit, and the number where there is one.
    pub metrics: Vec<(String, String, Option<f64>)>,
    /// What holds a number, where its result knows.
    pub within: Vec<(String, [f64; 2])>,
}

impl Reported {
    /// Of a row.
    pub fn of(row: &Row) -> Reported {
        let metric = |(name, metric): &(String, Option<stage::Metric>)| {
            let unit = metric.as_ref().map_or(String::new(), |m| m.unit.clone());
            (name.clone(), unit, metric.as_ref().map(|m| m.value))
        };
        let own = params(row).into_iter();
        Reported {
            variant: row.point.variant.clone(),
            params: own.filter(|(name, _)| name.contains('.')).collect(),
            replicate: row.point.replicate,
            done: row.end == End::Done,
            metrics: row.metrics.iter().map(metric).collect(),
            within: row.within.clone(),
        }
    }

    /// Of the points of a `sweep.json`; `None` where it is none.
    pub fn read(sweep: &Value) -> Option<Vec<Reported>> {
        let point = |point: &Value| {
            let text = |v: &Value| v.as_str().map(str::to_owned);
            let params = point["params"].as_object()?.iter();
            let params = params.filter(|(name, _)| name.contains('.'));
            let metric = |m: &Value| {
                let unit = text(&m["unit"]).unwrap_or_default();
                Some((text(&m["name"])?, unit, m["value"].as_f64()))
            };
            let metrics = point["metrics"].as_array()?.iter().map(metric);
            Some(Reported {
                variant: text(&point["variant"]),
                params: params
                    .map(|(k, v)| Some((k.clone(), text(v)?)))
                    .collect::<Option<_>>()?,
                replicate: point["replicate"].as_u64().map(|n| n as u32),
                done: point["done"].as_bool()?,
                metrics: metrics.collect::<Option<_>>()?,
                within: vec![],
            })
        };
        sweep["points"].as_array()?.iter().map(point).collect()
    }

    /// The number of a name.
    pub(crate) fn value(&self, name: &str) -> Option<f64> {
        let metric = self.metrics.iter().find(|(n, _, _)| n == name)?;
        metric.2.filter(|_| self.done)
    }
}

/// The metrics of some points: name and unit, in the order of the table.
pub(crate) fn metrics<'a>(all: impl Iterator<Item = &'a Reported>) -> Vec<(String, String)> {
    let mut known: Vec<(String, String)> = Vec::new();
    for (name, unit, _) in all.flat_map(|t| &t.metrics) {
        match known.iter_mut().find(|(n, _)| n == name) {
            None => known.push((name.clone(), unit.clone())),
            Some((_, empty)) if empty.is_empty() => unit.clone_into(empty),
            Some(_) => {}
        }
    }
    known
}
