//! A study's table: out of a sweep's rows, as a page, as data, and against what it was.
//!
//! A study is a pipeline file with a sweep of the file's own name. Its page and data hang on the results alone: no times, no
//! machine, so that what differs from the last time moved by itself.

use super::given::{pairs_cells, spread_cells};
use super::paired::{Pairs, of_variants};
use super::reported::Reported;
use super::spread::{Group, spread};
use engine::sweep::Row;
use serde_json::{Value, json};
use std::fmt::Write;

/// A number that is not what it was.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// Of which set of params, and which metric.
    pub of: String,
    /// As it was; `None` where there was none.
    pub old: Option<f64>,
    /// As it is.
    pub new: Option<f64>,
}

impl std::fmt::Display for Moved {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = |x: Option<f64>| x.map_or("none".to_owned(), |x| x.to_string());
        write!(f, "{}: {} -> {}", self.of, text(self.old), text(self.new))
    }
}

/// The table of a study.
pub struct Table {
    name: String,
    about: String,
    groups: Vec<Group>,
    against: Vec<([String; 2], Vec<Pairs>)>,
}

/// So many digits are kept: more differ between no two systems, but mean nothing. \[significant digits\]
const DIGITS: usize = 6;

fn rounded(x: f64) -> f64 {
    format!("{x:.*e}", DIGITS - 1).parse().unwrap_or(x)
}

/// A group with as many digits as are kept, so that its page and its data are of the same numbers.
fn kept(mut group: Group) -> Group {
    for spread in &mut group.spreads {
        spread.mean = spread.mean.map(rounded);
        spread.sd = spread.sd.map(rounded);
    }
    group
}

impl Table {
    /// Of a sweep's rows.
    pub fn new(name: &str, about: &str, rows: &[Row]) -> Table {
        let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
        let repeated = reported.iter().any(|t| t.replicate.is_some());
        Table {
            name: name.into(),
            about: about.into(),
            groups: spread(&reported).into_iter().map(kept).collect(),
            against: if repeated {
                of_variants(&reported)
            } else {
                vec![]
            },
        }
    }

    /// The data, in an order of its own.
    pub fn data(&self, program: &str) -> Value {
        let round = |mut value: Value| {
            walk(&mut value);
            value
        };
        let pairs = |([first, second], pairs): &([String; 2], Vec<Pairs>)| {
            let pairs: Vec<Value> = pairs.iter().map(|p| round(p.json())).collect();
            json!({ "first": first, "second": second, "pairs": pairs })
        };
        json!({
            "study": self.name, "about": self.about, "program": program,
            "groups": self.groups.iter().map(|g| round(g.json())).collect::<Vec<_>>(),
            "paired": self.against.iter().map(pairs).collect::<Vec<_>>(),
        })
    }

    /// The page.
    pub fn page(&self, program: &str) -> String {
        let called = program.split(' ').next().unwrap_or(program);
        let mut page = format!(
            "# {}\n\n    {called} study run {}\n\n",
            self.about, self.name
        );
        if !self.groups.is_empty() {
            let (head, rows) = spread_cells(&self.groups);
            page += &markdown(&head, &rows);
            let n = self.groups.iter().map(|g| g.points).max().unwrap_or(1);
            if n > 1 {
                let _ = writeln!(page, "\nMean ± standard deviation of {n} replicates.");
            }
        }
        for ([first, second], pairs) in &self.against {
            let (head, row) = pairs_cells(first, second);
            let _ = writeln!(page, "\n## {second} less {first}, replicate by replicate\n");
            page += &markdown(&head, &pairs.iter().map(row).collect::<Vec<_>>());
            page += "\n95 %: Student's interval of the mean difference. p: how often signs by chance give a difference as large. d: the difference in \
                     standard deviations of the pairs.\n";
        }
        let _ = writeln!(page, "\n*{program}; data: `{}.json`.*", self.name);
        page
    }

    /// What is not as it was, by the data of before.
    pub fn moved(&self, before: &Value, program: &str) -> Vec<Moved> {
        let (old, new) = (means(before), means(&self.data(program)));
        let mut moved = Vec::new();
        for (of, value) in &new {
            let was = old.iter().find(|(name, _)| name == of);
            let was = was.and_then(|(_, value)| *value);
            if was != *value {
                moved.push(Moved {
                    of: of.clone(),
                    old: was,
                    new: *value,
                });
            }
        }
        let gone = old
            .iter()
            .filter(|(of, value)| value.is_some() && !new.iter().any(|(name, _)| name == of));
        moved.extend(gone.map(|(of, value)| Moved {
            of: of.clone(),
            old: *value,
            new: None,
        }));
        moved
    }
}

/// Rounds every number that is no whole one.
fn walk(value: &mut Value) {
    match value {
        Value::Number(n) if n.is_f64() => *value = json!(rounded(n.as_f64().unwrap_or(0.0))),
        Value::Array(list) => list.iter_mut().for_each(walk),
        Value::Object(map) => map.values_mut().for_each(walk),
        _ => {}
    }
}

/// Every mean of a study's data by what it is of.
fn means(data: &Value) -> Vec<(String, Option<f64>)> {
    let mut all = Vec::new();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    for group in list(&data["groups"]) {
        let mut of: Vec<String> = group["variant"]
            .as_str()
            .map(str::to_owned)
            .into_iter()
            .collect();
        let params = group["params"].as_object().cloned().unwrap_or_default();
        of.extend(
            params
                .iter()
                .map(|(k, v)| format!("{k}={}", v.as_str().unwrap_or(""))),
        );
        for metric in list(&group["metrics"]) {
            let name = metric["name"].as_str().unwrap_or("");
            all.push((
                format!("{} {name}", of.join(" ")).trim_start().to_owned(),
                metric["mean"].as_f64(),
            ));
        }
    }
    all
}

/// A table in Markdown.
fn markdown(head: &[String], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|c| c.replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule = vec!["---".to_owned(); head.len()];
    let rows: String = rows.iter().map(|r| line(r)).collect();
    line(head) + &line(&rule) + &rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use system::text::short;

    #[test]
    fn what_moved_is_named_by_what_it_is_of_and_nothing_else() {
        let group = |mean: f64| json!({ "groups": [{ "variant": "rigid", "params": { "sway.sway_mm": "8" }, "metrics": [{ "name": "score.error", "mean": mean }] }] });
        let table = Table {
            name: "s".into(),
            about: "?".into(),
            groups: vec![],
            against: vec![],
        };
        assert_eq!(
            means(&group(1.5)),
            [("rigid sway.sway_mm=8 score.error".to_owned(), Some(1.5))]
        );
        let gone = table.moved(&group(1.5), "toys 1");
        assert_eq!(
            gone[0].to_string(),
            "rigid sway.sway_mm=8 score.error: 1.5 -> none"
        );
        assert_eq!(rounded(2.000_000_04), 2.0);
        assert_eq!(short(rounded(-0.123_456_789)), "-0.1235");
    }
}
