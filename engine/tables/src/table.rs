//! The rows of a sweep as text, CSV and JSON.

use super::aligned;
use super::cells::{cell, columns, names, params, short, trouble, values};
use super::given::{pairs_text, replicates_text};
use super::paired::{Pairs, of_variants};
use super::reported::Reported;
use super::spread::{Group, spread};
use engine::sweep::{End, Row};
use serde_json::{Value, json};
use std::fmt::Write;
use system::text::count;

/// A table for people, and a line that sums up: replicates as one row, with what they scatter.
pub fn text(about: &str, rows: &[Row]) -> String {
    let mut text = String::new();
    if !about.is_empty() {
        let _ = writeln!(text, "{about}");
    }
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    match reported.iter().any(|t| t.replicate.is_some()) {
        false => text += &of_points(rows),
        true => {
            text += &replicates_text(&spread(&reported));
            for ([first, second], pairs) in of_variants(&reported) {
                text += &pairs_text(&first, &second, &pairs);
            }
            let failed = rows.iter().filter_map(|r| Some((r, trouble(r)?)));
            for (row, why) in failed {
                let _ = writeln!(text, "{}: {why}", row.point.name(""));
            }
        }
    }
    let _ = writeln!(text, "{}", summary(rows));
    text
}

/// A row a point.
fn of_points(rows: &[Row]) -> String {
    let columns = columns(rows);
    let named = names(rows);
    let texts = named.len();
    let failed = rows.iter().any(|r| r.end != End::Done);
    let units = columns.iter();
    let units = units.map(|(n, u)| format!("{n} {u}").trim_end().to_owned());
    let mut table = aligned::table();
    let head = named.into_iter().chain(units);
    let head = head.chain(["made".to_owned(), "time".to_owned()]);
    table.add_row(head.chain(failed.then(String::new)));
    for row in rows {
        let number = |(name, _): &(String, String)| cell(row, name).map_or("-".into(), short);
        let mut line = values(row);
        line.extend(columns.iter().map(number));
        line.extend([row.made.to_string(), format!("{:.1} s", row.seconds)]);
        line.extend(failed.then(|| trouble(row).unwrap_or_default()));
        table.add_row(line);
    }
    for column in texts..texts + columns.len() + 2 {
        aligned::to_the_right(&mut table, column);
    }
    aligned::lines(&mut table) + "\n"
}

/// What it cost, and what it would have.
pub(crate) fn summary(rows: &[Row]) -> String {
    let sum = |f: fn(&Row) -> f64| rows.iter().map(f).sum::<f64>();
    let failed = rows.iter().filter(|r| r.end != End::Done).count();
    let failed = match failed {
        0 => String::new(),
        n => format!(" ({n} without a result)"),
    };
    let (made, found) = rows
        .iter()
        .fold((0, 0), |(m, f), r| (m + r.made, f + r.found));
    format!(
        "{}{failed}: {} made in {:.1} s, {found} found; {:.1} s in all, {:.1} s of them while no stage ran; each point alone: {:.1} s",
        count(rows.len(), "point"),
        count(made, "result"),
        sum(|r| r.work),
        sum(|r| r.seconds),
        sum(|r| r.engine),
        sum(|r| r.alone),
    )
}

/// One line a point.
pub fn csv(rows: &[Row]) -> String {
    let columns = columns(rows);
    let mut head = names(rows);
    head.extend(
        columns
            .iter()
            .map(|(n, u)| format!("{n} {u}").trim_end().to_owned()),
    );
    head.extend(
        [
            "made",
            "found",
            "seconds",
            "engine_seconds",
            "alone_seconds",
            "trouble",
        ]
        .map(String::from),
    );
    let mut lines = vec![head];
    for row in rows {
        let mut line = values(row);
        line.extend(
            columns
                .iter()
                .map(|(n, _)| cell(row, n).map_or(String::new(), |x| x.to_string())),
        );
        line.extend([row.made.to_string(), row.found.to_string()]);
        line.extend([row.seconds, row.engine, row.alone].map(|s| format!("{s:.3}")));
        line.push(trouble(row).unwrap_or_default());
        lines.push(line);
    }
    as_csv(lines)
}

/// Rows of equal length as CSV.
pub fn as_csv(lines: Vec<Vec<String>>) -> String {
    let mut table = ::csv::Writer::from_writer(Vec::new());
    for line in lines {
        table
            .write_record(line)
            .expect("bug: a row of another length");
    }
    let bytes = table.into_inner().expect("bug: memory is full");
    String::from_utf8(bytes).expect("bug: texts are UTF-8")
}

/// Replicates and comparisons of variants as tables, a line a set of params and metric; nothing without replicates.
pub fn statistics(rows: &[Row]) -> Vec<(String, String)> {
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    if reported.iter().all(|t| t.replicate.is_none()) {
        return vec![];
    }
    let text = |x: Option<f64>| x.map_or(String::new(), |x| x.to_string());
    let groups = spread(&reported);
    let names = groups
        .first()
        .map_or(vec![], |g| g.params.iter().map(|p| p.0.clone()).collect());
    let own = |words: &[&str]| words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>();
    let head = |before: &[&str], after: &[&str]| [own(before), names.clone(), own(after)].concat();
    let tail = [
        "metric", "unit", "n", "refused", "failed", "mean", "sd", "low95", "high95",
    ];
    let mut spreads = vec![head(&["variant"], &tail)];
    for group in &groups {
        let params: Vec<String> = group.params.iter().map(|p| p.1.clone()).collect();
        for s in &group.spreads {
            let counts = [s.n, s.refused, group.failed].map(|n| n.to_string());
            let ends = [0, 1].map(|k| text(s.interval.map(|i| i[k])));
            let mut line = vec![group.variant.clone().unwrap_or_default()];
            line.extend(params.iter().cloned());
            line.extend([s.name.clone(), s.unit.clone()]);
            line.extend(
                counts
                    .into_iter()
                    .chain([text(s.mean), text(s.sd)])
                    .chain(ends),
            );
            spreads.push(line);
        }
    }
    let tail = [
        "metric",
        "unit",
        "pairs",
        "only_first",
        "only_second",
        "neither",
        "mean_first",
        "mean_second",
        "difference",
        "low95",
        "high95",
        "d",
        "p",
        "exact",
    ];
    let mut pairs = vec![head(&["first", "second"], &tail)];
    for ([first, second], all) in of_variants(&reported) {
        for p in &all {
            let mut line = vec![first.clone(), second.clone()];
            line.extend(p.params.iter().map(|p| p.1.clone()));
            line.extend([p.name.clone(), p.unit.clone(), p.n.to_string()]);
            line.extend(p.alone.map(|n| n.to_string()));
            line.extend([0, 1].map(|k| text(p.means.map(|m| m[k]))));
            line.push(text(p.effect.map(|e| e.0)));
            line.extend([0, 1].map(|k| text(p.effect.and_then(|e| Some(e.1?[k])))));
            line.extend([text(p.size), text(p.p), p.exact.to_string()]);
            pairs.push(line);
        }
    }
    let mut files = vec![("replicates.csv".to_owned(), as_csv(spreads))];
    files.extend((pairs.len() > 1).then(|| ("paired.csv".to_owned(), as_csv(pairs))));
    files
}

/// For other programs.
pub fn json(program: &str, name: &str, about: &str, rows: &[Row]) -> Value {
    let row = |row: &Row| {
        let cell = |(name, metric): &(String, Option<stage::Metric>)| {
            let m = metric.as_ref();
            json!({ "name": name, "value": m.map(|m| m.value), "unit": m.map(|m| m.unit.clone()) })
        };
        let params = params(row).into_iter().map(|(k, v)| (k, Value::from(v)));
        json!({
            "point": row.point.name(name), "variant": row.point.variant, "replicate": row.point.replicate,
            "set": row.point.sets(),
            "params": params.collect::<serde_json::Map<_, _>>(),
            "metrics": row.metrics.iter().map(cell).collect::<Vec<_>>(),
            "done": row.end == End::Done, "why": trouble(row),
            "made": row.made, "found": row.found, "seconds": row.seconds,
            "alone_seconds": row.alone, "work_seconds": row.work, "engine_seconds": row.engine,
        })
    };
    let mut sweep = json!({
        "program": program, "sweep": name, "about": about,
        "points": rows.iter().map(row).collect::<Vec<_>>(), "summary": summary(rows),
    });
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    if reported.iter().any(|t| t.replicate.is_some()) {
        sweep["replicates"] = spread(&reported).iter().map(Group::json).collect();
        let against = |([first, second], pairs): &([String; 2], Vec<Pairs>)| {
            let pairs: Vec<Value> = pairs.iter().map(Pairs::json).collect();
            json!({ "first": first, "second": second, "pairs": pairs })
        };
        sweep["paired"] = of_variants(&reported).iter().map(against).collect();
    }
    sweep
}
