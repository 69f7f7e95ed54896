//! What is in a cell of a sweep's tables.

use engine::sweep::plain;
use engine::sweep::{End, Row};

/// A column of a metric: its name and unit.
pub(crate) fn columns(rows: &[Row]) -> Vec<(String, String)> {
    let mut columns: Vec<(String, String)> = Vec::new();
    for (name, metric) in rows.iter().flat_map(|r| &r.metrics) {
        let at = columns.iter().position(|(n, _)| n == name);
        let at = at.unwrap_or_else(|| {
            columns.push((name.clone(), String::new()));
            columns.len() - 1
        });
        if let Some(metric) = metric {
            columns[at].1 = metric.unit.clone();
        }
    }
    columns
}

/// What a row has in a column.
pub(crate) fn cell(row: &Row, column: &str) -> Option<f64> {
    let metric = row.metrics.iter().find(|(name, _)| name == column);
    metric.and_then(|(_, metric)| Some(metric.as_ref()?.value))
}

/// The params of a row as it names them, the variant first if there is one, the replicate last.
pub(crate) fn params(row: &Row) -> Vec<(String, String)> {
    let variant = row
        .point
        .variant
        .iter()
        .map(|v| ("variant".to_owned(), v.clone()));
    let values = row.point.values.iter();
    let values = values.map(|(n, p, v)| (format!("{n}.{p}"), plain(v)));
    let replicate = row.point.replicate.iter();
    let replicate = replicate.map(|n| ("replicate".to_owned(), n.to_string()));
    variant.chain(values).chain(replicate).collect()
}

/// The names of what varies, as the first row has them.
pub(crate) fn names(rows: &[Row]) -> Vec<String> {
    let first = rows.first().map_or(vec![], params);
    first.into_iter().map(|(name, _)| name).collect()
}

/// What each of them is in a row.
pub(crate) fn values(row: &Row) -> Vec<String> {
    params(row).into_iter().map(|(_, value)| value).collect()
}

/// Why a row has no result.
pub(crate) fn trouble(row: &Row) -> Option<String> {
    match &row.end {
        End::Done => None,
        End::Failed(node, why) => Some(format!("{node} failed: {why}")),
        End::Wrong(why) => Some(why.clone()),
        End::Stopped => Some("stopped".into()),
    }
}

/// A number with as many digits as mean something.
pub(crate) fn short(x: f64) -> String {
    match x.abs() {
        _ if x.fract() == 0.0 && x.abs() < 1e12 => format!("{x:.0}"),
        a if a >= 100.0 => format!("{x:.1}"),
        a if a >= 1.0 => format!("{x:.2}"),
        _ => format!("{x:.4}"),
    }
}
