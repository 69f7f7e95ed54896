//! What plots are drawn from: points with their params and metrics, axes, and what metrics are compared with.

use super::plotted::{Reference, References};
use super::scale::Scale;
use crate::spread::Group;
use engine::sweep::ENDS;

/// A metric: its name, unit, and the axis of all its plots.
pub(super) struct Metric {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) scale: Scale,
    pub(super) references: Vec<Reference>,
}

impl Metric {
    /// With its unit.
    pub(super) fn title(&self) -> String {
        match self.unit.is_empty() {
            true => self.name.clone(),
            false => format!("{} [{}]", self.name, self.unit),
        }
    }
}

/// A point's number with what holds it.
#[derive(Clone, Copy)]
pub(super) struct Reported {
    pub(super) value: f64,
    pub(super) interval: Option<[f64; 2]>,
}

/// A point.
pub(super) struct Point {
    /// One entry a param.
    pub(super) params: Vec<String>,
    /// One entry a metric.
    pub(super) reported: Vec<Option<Reported>>,
}

/// All of them.
pub(super) struct Field {
    /// The params that vary, a variant first.
    pub(super) params: Vec<String>,
    /// Their axes.
    pub(super) axes: Vec<Scale>,
    /// The metrics that vary.
    pub(super) metrics: Vec<Metric>,
    pub(super) points: Vec<Point>,
}

impl Field {
    pub(super) fn new(groups: &[Group], references: &References<'_>) -> Field {
        let all = |group: &Group| -> Vec<(String, String)> {
            let variant = group.variant.iter();
            let variant = variant.map(|v| ("variant".to_owned(), v.clone()));
            variant.chain(group.params.iter().cloned()).collect()
        };
        let rows: Vec<Vec<(String, String)>> = groups.iter().map(all).collect();
        let names: Vec<String> = rows
            .first()
            .map_or(vec![], |r| r.iter().map(|p| p.0.clone()).collect());
        let value = |row: &[(String, String)], name: &str| {
            let found = row.iter().find(|(n, _)| n == name);
            found.map_or(String::new(), |(_, v)| v.clone())
        };
        let varies = |name: &&String| rows.iter().any(|r| value(r, name) != value(&rows[0], name));
        let params: Vec<String> = names.iter().filter(varies).cloned().collect();
        let shown = shown(groups);
        let reported = |group: &Group, at: usize| reported(group, at);
        let points: Vec<Point> = rows
            .iter()
            .zip(groups)
            .map(|(row, group)| Point {
                params: params.iter().map(|name| value(row, name)).collect(),
                reported: shown.iter().map(|at| reported(group, *at)).collect(),
            })
            .collect();
        let axis = |p: usize| {
            let texts: Vec<&str> = points
                .iter()
                .map(|point| point.params[p].as_str())
                .collect();
            Scale::of(&texts)
        };
        let axes = (0..params.len()).map(axis).collect();
        let metric = |(k, at): (usize, &usize)| {
            let spread = &groups[0].spreads[*at];
            let references = references(&spread.name, &spread.unit);
            Metric {
                name: spread.name.clone(),
                unit: spread.unit.clone(),
                scale: scale(&points, &[k], &references),
                references,
            }
        };
        let mut metrics: Vec<Metric> = shown.iter().enumerate().map(metric).collect();
        equal(&mut metrics, &points);
        Field {
            params,
            axes,
            metrics,
            points,
        }
    }

    /// What else differs between points than a param: the name of a line.
    pub(super) fn rest(&self, point: &Point, but: &[usize]) -> String {
        let each = self.params.iter().zip(&point.params).enumerate();
        let each = each.filter(|(p, _)| !but.contains(p));
        let text: Vec<String> = each
            .map(|(_, (name, value))| format!("{name} = {value}"))
            .collect();
        text.join(", ")
    }

    /// The names of lines, or maps: what differs between points but for some params.
    pub(super) fn names(&self, but: &[usize]) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for point in &self.points {
            let name = self.rest(point, but);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// The text of a dot: its params and its number.
    pub(super) fn title(&self, point: &Point, metric: usize) -> String {
        let reported = point.reported[metric].map_or(String::new(), |t| t.value.to_string());
        format!(
            "{}: {} {reported}",
            self.rest(point, &[]),
            self.metrics[metric].name
        )
    }
}

/// The metrics whose numbers differ between points; ends of intervals are shown with what they hold.
fn shown(groups: &[Group]) -> Vec<usize> {
    let Some(first) = groups.first() else {
        return vec![];
    };
    let varies = |at: &usize| {
        let mut values = groups.iter().filter_map(|g| g.spreads[*at].mean);
        let first = values.next();
        values.any(|v| Some(v) != first)
    };
    let end = |at: &usize| ENDS.iter().any(|e| first.spreads[*at].name.ends_with(e));
    (0..first.spreads.len())
        .filter(|at| !end(at) && varies(at))
        .collect()
}

/// A group's number with the interval of its replicates, or its own.
fn reported(group: &Group, at: usize) -> Option<Reported> {
    let spread = &group.spreads[at];
    Some(Reported {
        value: spread.mean?,
        interval: spread.interval.or(spread.own),
    })
}

/// The axis of some metrics with all that they are compared with.
fn scale(points: &[Point], metrics: &[usize], references: &[Reference]) -> Scale {
    let reported = points
        .iter()
        .flat_map(|p| metrics.iter().filter_map(|k| p.reported[*k]));
    let ends = reported.flat_map(|t| {
        let [low, high] = t.interval.unwrap_or([t.value; 2]);
        [t.value, low, high]
    });
    let all = ends.chain(references.iter().map(|r| r.value));
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    Scale::around(low, high)
}

/// Metrics that are compared with the same in the same unit have the same axis: their plots can be laid side by side.
fn equal(metrics: &mut [Metric], points: &[Point]) {
    for k in 0..metrics.len() {
        let alike = |m: &Metric| {
            !m.references.is_empty()
                && m.unit == metrics[k].unit
                && m.references == metrics[k].references
        };
        let same: Vec<usize> = (0..metrics.len()).filter(|j| alike(&metrics[*j])).collect();
        if same.first() == Some(&k) {
            let scale = scale(points, &same, &metrics[k].references);
            same.iter().for_each(|j| metrics[*j].scale = scale.clone());
        }
    }
}
