//! A comparison as Markdown and JSON.

use super::Comparison;
use super::cut::short;
use super::girths::GirthRow;
use crate::reader::{Reader, number, signed, words};
use crate::table::Table;
use engine::differ::{Difference, by_name};
use serde_json::{Value, json};
use shape::Unit;
use stage::{Message, message};
use std::collections::HashSet;
use std::fmt::Write;

stage::messages! {
    AGAINST = "compare-against": "against";
    ALL = "compare-all": "all";
    BIAS = "compare-bias": "bias [mm]";
    CHANGED = "compare-changed": "changed";
    CHANGED_NOT = "compare-changed-not": "no";
    CHANGED_YES = "compare-changed-yes": "YES";
    COST = "compare-cost": "Time and size";
    DIFFERS = "compare-differs": "{side} differs from {first} from `{node}` on ({count} of {all} results).";
    FARTHEST = "compare-farthest": "farthest [mm]";
    GIRTH = "compare-girth": "girth";
    /// Above the table of girths.
    GIRTHS = "compare-girths": "Girths by tape";
    INTERVALS = "compare-intervals": "by intervals [mm]";
    LAID = "compare-laid": "{side}, aligned to {first} (turned {turned:.1 °}, moved {moved:.0 mm})";
    /// What the head of the table of girths means.
    LEGEND = "compare-legend": "Difference: this tape minus the first one. By intervals: nine times in ten the true difference is within these limits. LSC: least significant change, which measuring the same body twice exceeds one time in twenty; changed: whether the difference exceeds it.";
    LSC = "compare-lsc": "LSC [mm]";
    MEAN = "compare-mean": "mean [mm]";
    MET_AGAIN = "compare-met-again": "Different settings, identical results: {nodes}.";
    NODE = "compare-node": "node";
    OFF = "compare-off": "difference [mm]";
    ONLY = "compare-only": "Only {side} has {nodes}.";
    OTHER = "compare-other": "other";
    P95 = "compare-95": "95 % within [mm]";
    RELATIVE = "compare-relative": "relative";
    RMS = "compare-rms": "rms [mm]";
    SAME = "compare-same": "{side} made the same bytes as {first} in every node.";
    SAME_SHARED = "compare-same-shared": "{side} made the same bytes as {first} in every node that both have.";
    SETTINGS = "compare-settings": "Settings that differ";
    SURFACE = "compare-surface": "surface";
    SURFACES = "compare-surfaces": "Surfaces: distances from the first";
    TO = "compare-to": "{low} to {high}";
    VOLUME = "compare-volume": "volume [l]";
    WHAT = "compare-what": "what";
    WITHIN = "compare-within": "within the limit";
    WITHIN_NOT = "compare-within-not": "NO, {mm} mm";
    WITHIN_YES = "compare-within-yes": "yes, {mm} mm";
}

/// Girths: by tape, and how far from the first; of more than two sides a row each, so that the table is no wider.
pub(super) fn girth_table(c: &Comparison, reader: &dyn Reader) -> Table {
    let first = &c.sides[0].name;
    let against: Vec<&String> = c.sides.iter().skip(1).map(|s| &s.name).collect();
    let unit = c.girths.first().map_or(Unit::Metric, |row| row.unit);
    let (word, digits) = match unit {
        Unit::Metric => ("cm".to_owned(), 2),
        Unit::Relative => (reader.message(&message!(RELATIVE)), 5),
    };
    let [girth, off] = words(reader, [GIRTH, OFF]);
    let mut head = vec![girth, format!("{first} [{word}]")];
    let off = match against[..] {
        [other] => {
            head.push(format!("{other} [{word}]"));
            format!("{other} {off}")
        }
        _ => {
            head.extend([reader.message(&message!(AGAINST)), format!("[{word}]")]);
            off
        }
    };
    head.push(off);
    head.extend(words(reader, [INTERVALS, LSC, CHANGED, WITHIN]));
    let mut table = vec![head];
    for row in &c.girths {
        for (k, other) in against.iter().enumerate() {
            let mut line = vec![format!("{} ({})", row.name, row.label)];
            line.push(number(reader, row.tape[0], digits));
            line.extend((against.len() > 1).then(|| (*other).clone()));
            line.push(number(reader, row.tape[k + 1], digits));
            line.extend(judged_cells(row, k, reader));
            table.push(line);
        }
    }
    table
}

/// How far the tape of a side is from the first, and what that means.
fn judged_cells(row: &GirthRow, k: usize, reader: &dyn Reader) -> [String; 5] {
    let judged = &row.judged[k];
    let word = row.same[k].map(|same| match same {
        true => message!(WITHIN_YES, mm = row.tolerance_mm),
        false => message!(WITHIN_NOT, mm = row.tolerance_mm),
    });
    let end = |x: f64| signed(reader, Some(x), 1);
    let ends = judged.interval_mm;
    let ends = ends.map(|[a, b]| message!(TO, low = end(a), high = end(b)));
    let changed = judged.changed.map(|changed| match changed {
        true => message!(CHANGED_YES),
        false => message!(CHANGED_NOT),
    });
    let read = |word: Option<Message>| word.map_or("–".into(), |word| reader.message(&word));
    let least = number(reader, judged.least_change_mm, 1);
    let off = signed(reader, row.off_mm[k], 1);
    [off, read(ends), least, read(changed), read(word)]
}

/// Settings that differ.
pub(super) fn change_table(c: &Comparison, reader: &dyn Reader) -> Table {
    let first = &c.sides[0].name;
    let [node, what, other] = words(reader, [NODE, WHAT, OTHER]);
    let mut table = vec![vec![node, what, first.clone(), other, String::new()]];
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
pub(super) fn surface_table(c: &Comparison, reader: &dyn Reader) -> Table {
    let head = [SURFACE, MEAN, RMS, P95, FARTHEST, BIAS, VOLUME];
    let mut table = vec![words(reader, head).to_vec()];
    let line = |name: String, a: &super::Apart| {
        let mut line = vec![name];
        let sizes = [a.mean_mm, a.rms_mm, a.p95_mm, a.max_mm];
        line.extend(sizes.map(|x| number(reader, Some(x), 3)));
        line.extend([(a.bias_mm, 3), (a.volume_l, 4)].map(|(x, n)| signed(reader, Some(x), n)));
        line
    };
    for ((side, apart), laid) in c.sides.iter().skip(1).zip(&c.apart).zip(&c.laid) {
        table.extend(apart.as_ref().map(|a| line(side.name.clone(), a)));
        table.extend(laid.as_ref().map(|l| {
            let how = message!(
                LAID,
                side = &side.name,
                first = &c.sides[0].name,
                turned = l.turned_deg,
                moved = l.moved_mm
            );
            line(reader.message(&how), &l.apart)
        }));
    }
    table
}

/// Time and size of every node.
pub(super) fn cost_table(c: &Comparison, reader: &dyn Reader) -> Table {
    let [node, all] = words(reader, [NODE, ALL]);
    let mut head = vec![node];
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
    let two = |x: f64| number(reader, Some(x), 2);
    let mb = |bytes: u64| two(bytes as f64 / 1e6);
    let mut table = vec![head];
    for name in names {
        let mut line = vec![name.to_owned()];
        for side in &sides {
            let node = side.get(name);
            line.push(number(reader, node.map(|n| n.seconds), 2));
            line.push(node.map_or("–".into(), |n| mb(n.bytes)));
        }
        table.push(line);
    }
    let mut line = vec![all];
    for side in &c.sides {
        line.extend([two(side.seconds()), mb(side.bytes())]);
    }
    table.push(line);
    table
}

/// Where the runs part ways, a sentence for each side but the first.
pub(super) fn sentences(c: &Comparison, reader: &dyn Reader) -> Vec<String> {
    let first = &c.sides[0].name;
    let sentence = |(name, d): (&String, &Difference)| {
        let list = |names: &[String]| {
            let names: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
            names.join(", ")
        };
        let both = d.gone.is_empty() && d.new.is_empty();
        let (side, all) = (name, c.sides[0].nodes.len());
        let mut text = vec![match &d.first {
            None if both => message!(SAME, side = side, first = first),
            None => message!(SAME_SHARED, side = side, first = first),
            Some(node) => {
                let count = d.diverged.len();
                message!(
                    DIFFERS,
                    side = side,
                    first = first,
                    node = node,
                    count = count,
                    all = all
                )
            }
        }];
        for (of, nodes) in [(first, &d.gone), (name, &d.new)] {
            if !nodes.is_empty() {
                text.push(message!(ONLY, side = of, nodes = list(nodes)));
            }
        }
        if !d.met_again.is_empty() {
            text.push(message!(MET_AGAIN, nodes = list(&d.met_again)));
        }
        let text: Vec<String> = text.iter().map(|m| reader.message(m)).collect();
        text.join(" ")
    };
    let names = c.sides.iter().skip(1).map(|s| &s.name);
    names.zip(&c.differences).map(sentence).collect()
}

/// All of it, as Markdown.
pub fn markdown(c: &Comparison, reader: &dyn Reader) -> String {
    let names: Vec<&str> = c.sides.iter().map(|s| s.name.as_str()).collect();
    let [against, legend] = words(reader, [AGAINST, LEGEND]);
    let mut text = format!("# {}\n\n", names.join(&format!(" {against} ")));
    for sentence in sentences(c, reader) {
        let _ = writeln!(text, "{sentence}\n");
    }
    for (title, table) in [
        (SETTINGS, change_table(c, reader)),
        (GIRTHS, girth_table(c, reader)),
        (SURFACES, surface_table(c, reader)),
        (COST, cost_table(c, reader)),
    ] {
        if table.len() > 1 {
            let [heading] = words(reader, [title]);
            let _ = write!(text, "## {heading}\n\n{}\n", crate::table::markdown(&table));
            if title == GIRTHS {
                let _ = writeln!(text, "{legend}\n");
            }
        }
    }
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
            "only_first": d.gone, "only_this": d.new, "same_bytes_by_other_settings": d.met_again,
            "changes": d.changes.iter().map(change).collect::<Vec<_>>(), "surface": apart, "aligned_to_first": laid,
        })
    };
    json!({
        "program": concat!("tailor ", env!("CARGO_PKG_VERSION")),
        "sides": c.sides.iter().map(side).collect::<Vec<_>>(),
        "against_first": compared.map(against).collect::<Vec<_>>(),
        "girths": c.girths.iter().map(super::GirthRow::json).collect::<Vec<_>>(),
    })
}
