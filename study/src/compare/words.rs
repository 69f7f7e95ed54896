//! A comparison as Markdown and JSON.

use super::Comparison;
use super::cut::short;
use super::girths::GirthRow;
use engine::differ::{Difference, by_name};
use serde_json::{Value, json};
use shape::Unit;
use std::collections::HashSet;
use std::fmt::Write;

/// A table as rows of texts, its head first.
pub(super) type Table = Vec<Vec<String>>;

/// Above the table of girths.
pub(super) const GIRTHS: &str = "Girths by tape";

/// What the head of the table of girths means.
pub(super) const LEGEND: &str = "off: the tape less that of the first. By intervals: the true difference is between these nine times in ten. \
    LSC: least significant change, which measuring the same body twice exceeds one time in twenty; changed: whether the difference exceeds it.";

fn number(x: Option<f64>, digits: usize) -> String {
    x.map_or("-".into(), |x| format!("{x:.digits$}"))
}

fn signed(x: Option<f64>) -> String {
    x.map_or("-".into(), |x| format!("{x:+.1}"))
}

/// Girths: by tape, and how far from the first; of more than two sides a row each, so that the table is no wider.
pub(super) fn girth_table(c: &Comparison) -> Table {
    let first = &c.sides[0].name;
    let against: Vec<&String> = c.sides.iter().skip(1).map(|s| &s.name).collect();
    let unit = c.girths.first().map_or(Unit::Metric, |row| row.unit);
    let (word, digits) = match unit {
        Unit::Metric => ("cm", 2),
        Unit::Relative => ("relative", 5),
    };
    let mut head = vec!["girth".to_owned(), format!("{first} [{word}]")];
    let off = match against[..] {
        [other] => {
            head.push(format!("{other} [{word}]"));
            format!("{other} off [mm]")
        }
        _ => {
            head.extend(["against".to_owned(), format!("[{word}]")]);
            "off [mm]".to_owned()
        }
    };
    let rest = ["by intervals [mm]", "LSC [mm]", "changed", "within"];
    head.push(off);
    head.extend(rest.map(String::from));
    let mut table = vec![head];
    for row in &c.girths {
        for (k, other) in against.iter().enumerate() {
            let mut line = vec![format!("{} ({})", row.name, row.label)];
            line.push(number(row.tape[0], digits));
            line.extend((against.len() > 1).then(|| (*other).clone()));
            line.push(number(row.tape[k + 1], digits));
            line.extend(judged_cells(row, k));
            table.push(line);
        }
    }
    table
}

/// How far the tape of a side is from the first, and what that means.
fn judged_cells(row: &GirthRow, k: usize) -> [String; 5] {
    let judged = &row.judged[k];
    let word = match row.same[k] {
        Some(true) => format!("yes, {} mm", row.tolerance_mm),
        Some(false) => format!("NO, {} mm", row.tolerance_mm),
        None => "-".into(),
    };
    let ends = judged.interval_mm;
    let ends = ends.map_or("-".into(), |[a, b]| format!("{a:+.1} to {b:+.1}"));
    let changed = match judged.changed {
        Some(true) => "YES",
        Some(false) => "no",
        None => "-",
    };
    let least = number(judged.least_change_mm, 1);
    [signed(row.off_mm[k]), ends, least, changed.into(), word]
}

/// Settings that differ.
pub(super) fn change_table(c: &Comparison) -> Table {
    let first = &c.sides[0].name;
    let mut table = vec![vec![
        "node".into(),
        "what".into(),
        first.clone(),
        "other".into(),
        "".into(),
    ]];
    for (side, d) in c.sides.iter().skip(1).zip(&c.differences) {
        for change in &d.changes {
            let (node, what, side) = (&change.node, &change.what, &side.name);
            let [old, new] = short([&change.old, &change.new]);
            table.push([node, what, &old, &new, side].map(String::clone).to_vec());
        }
    }
    table
}

/// How far the surfaces are apart.
pub(super) fn surface_table(c: &Comparison) -> Table {
    let head = [
        "surface",
        "mean [mm]",
        "rms [mm]",
        "95 % within [mm]",
        "farthest [mm]",
        "bias [mm]",
        "volume [l]",
    ];
    let mut table = vec![head.map(String::from).to_vec()];
    let line = |name: String, a: &super::Apart| {
        let mut line = vec![name];
        line.extend([a.mean_mm, a.rms_mm, a.p95_mm, a.max_mm].map(|x| format!("{x:.3}")));
        line.extend([format!("{:+.3}", a.bias_mm), format!("{:+.4}", a.volume_l)]);
        line
    };
    for ((side, apart), laid) in c.sides.iter().skip(1).zip(&c.apart).zip(&c.laid) {
        table.extend(apart.as_ref().map(|a| line(side.name.clone(), a)));
        table.extend(laid.as_ref().map(|l| {
            let how = format!(
                "{}, laid on {} (turned {:.1}°, moved {:.0} mm)",
                side.name, c.sides[0].name, l.turned_deg, l.moved_mm
            );
            line(how, &l.apart)
        }));
    }
    table
}

/// Time and size of every node.
pub(super) fn cost_table(c: &Comparison) -> Table {
    let mut head: Vec<String> = vec!["node".into()];
    for side in &c.sides {
        head.extend([format!("{} [s]", side.name), "[MB]".into()]);
    }
    let (mut names, mut known) = (Vec::<&str>::new(), HashSet::new());
    for node in c.sides.iter().flat_map(|s| &s.nodes) {
        if known.insert(node.node.as_str()) {
            names.push(&node.node);
        }
    }
    let sides: Vec<_> = c.sides.iter().map(|s| by_name(&s.nodes)).collect();
    let mb = |bytes: u64| format!("{:.2}", bytes as f64 / 1e6);
    let mut table = vec![head];
    for name in names {
        let mut line = vec![name.to_owned()];
        for side in &sides {
            let node = side.get(name);
            line.push(number(node.map(|n| n.seconds), 2));
            line.push(node.map_or("-".into(), |n| mb(n.bytes)));
        }
        table.push(line);
    }
    let mut line = vec!["all".to_owned()];
    for side in &c.sides {
        line.extend([format!("{:.2}", side.seconds()), mb(side.bytes())]);
    }
    table.push(line);
    table
}

/// Where the runs part ways, a sentence for each side but the first.
pub(super) fn sentences(c: &Comparison) -> Vec<String> {
    let first = &c.sides[0].name;
    let sentence = |(name, d): (&String, &Difference)| {
        let list = |names: &[String]| {
            names
                .iter()
                .map(|n| format!("`{n}`"))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let mut text = match &d.first {
            None if d.gone.is_empty() && d.new.is_empty() => {
                format!("{name} made the same bytes as {first} in every node.")
            }
            None => format!("{name} made the same bytes as {first} in every node that both have."),
            Some(node) => format!(
                "{name} differs from {first} from `{node}` on ({} of {} results).",
                d.diverged.len(),
                c.sides[0].nodes.len()
            ),
        };
        if !d.gone.is_empty() {
            let _ = write!(text, " Only {first} has {}.", list(&d.gone));
        }
        if !d.new.is_empty() {
            let _ = write!(text, " Only {name} has {}.", list(&d.new));
        }
        if !d.met_again.is_empty() {
            let _ = write!(
                text,
                " Different settings, identical results: {}.",
                list(&d.met_again)
            );
        }
        text
    };
    let names = c.sides.iter().skip(1).map(|s| &s.name);
    names.zip(&c.differences).map(sentence).collect()
}

/// All of it, as Markdown.
pub fn markdown(c: &Comparison) -> String {
    let names: Vec<&str> = c.sides.iter().map(|s| s.name.as_str()).collect();
    let mut text = format!("# {}\n\n", names.join(" against "));
    for sentence in sentences(c) {
        let _ = writeln!(text, "{sentence}\n");
    }
    for (title, table) in [
        ("Settings that differ", change_table(c)),
        (GIRTHS, girth_table(c)),
        ("Surfaces, from the first", surface_table(c)),
        ("Time and size", cost_table(c)),
    ] {
        if table.len() > 1 {
            let _ = write!(text, "## {title}\n\n{}\n", rows(&table));
            if title == GIRTHS {
                let _ = writeln!(text, "{LEGEND}\n");
            }
        }
    }
    text
}

fn rows(table: &Table) -> String {
    let width = |i: usize| {
        table
            .iter()
            .map(|r| r[i].chars().count())
            .max()
            .unwrap_or(0)
            .max(3)
    };
    let widths: Vec<usize> = (0..table[0].len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let cell = |(cell, w): (&String, &usize)| {
            let cell = cell.replace('|', "\\|");
            format!(
                "{cell}{}",
                " ".repeat(w.saturating_sub(cell.chars().count()))
            )
        };
        let cells: Vec<String> = row.iter().zip(&widths).map(cell).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let dashes: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
    let mut text = line(&table[0]);
    let _ = writeln!(text, "| {} |", dashes.join(" | "));
    table.iter().skip(1).for_each(|row| text += &line(row));
    text
}

/// The same for other programs.
pub fn json(c: &Comparison) -> Value {
    let side = |s: &super::Side| {
        let node = |n: &super::NodeRun| json!({ "node": n.node, "stage": n.stage, "content": n.content, "seconds": n.seconds, "bytes": n.bytes });
        json!({
            "name": s.name, "seconds": s.seconds(), "bytes": s.bytes(),
            "nodes": s.nodes.iter().map(node).collect::<Vec<_>>(),
        })
    };
    let surfaces = c.apart.iter().zip(&c.laid);
    let compared = c.sides.iter().skip(1).zip(&c.differences).zip(surfaces);
    type Surfaces<'a> = (&'a Option<super::Apart>, &'a Option<super::Laid>);
    let against = |((side, d), (apart, laid)): ((&super::Side, &Difference), Surfaces<'_>)| {
        let laid = laid.as_ref().map(
            |l| json!({ "turned_deg": l.turned_deg, "moved_mm": l.moved_mm, "surface": l.apart }),
        );
        let change = |c: &super::Change| json!({ "node": c.node, "what": c.what, "old": c.old, "new": c.new });
        json!({
            "name": side.name, "first_diverging": d.first, "diverged": d.diverged,
            "only_first": d.gone, "only_this": d.new, "same_bytes_though_told_otherwise": d.met_again,
            "changes": d.changes.iter().map(change).collect::<Vec<_>>(), "surface": apart, "laid_on_first": laid,
        })
    };
    json!({
        "program": concat!("tailor ", env!("CARGO_PKG_VERSION")),
        "sides": c.sides.iter().map(side).collect::<Vec<_>>(),
        "against_first": compared.map(against).collect::<Vec<_>>(),
        "girths": c.girths.iter().map(super::GirthRow::json).collect::<Vec<_>>(),
    })
}
